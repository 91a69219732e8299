// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Identifies a file for ods inject, and for the advice of ods probe, if it has only a shape: a square video may be
// anything, and must not become a sphere by its shape alone.
#pragma once
#include <optional>
#include <string>

#include "ods/identify/identify.h"
#include "ods/video/container/complete_metadata.h"

struct Wordless {
  std::optional<ods::Reading> reading;  // the sure reading of its pixels, if its metadata can express it
  ods::Identity identity;
  std::string text;  // the reason, or the possible readings and the options that decide
};

// Returns nullopt if its metadata or its name identify it, or its pixels show nothing at all; then its shape counts.
std::optional<Wordless> look_at_frames(const ods::SphericalMetadata& known, const ods::VideoTrack& track,
                                       const std::string& path);
std::optional<Wordless> judged_picture(const std::optional<ods::Identity>& identity);  // from identify_if_open()
std::optional<Wordless> look_at_pixels(const ods::FormatHint& known, const std::string& path);
