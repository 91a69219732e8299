// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods inject takes a file for, and ods probe advises, if nothing but its shape would tell: a square film may be
// anything, and must not become a sphere by its shape alone.
#pragma once
#include <optional>
#include <string>

#include "ods/identify/identify.h"
#include "ods/video/container/complete_metadata.h"

struct Wordless {
  std::optional<ods::Reading> reading;  // what its pixels surely show and its metadata can say
  ods::Identity identity;
  std::string text;  // why they do, or what they may show and which options decide
};

// Nothing if a word tells what it shows, or its pixels show nothing at all; then its shape counts.
std::optional<Wordless> look_at_frames(const ods::SphericalMetadata& known, const ods::VideoTrack& track,
                                       const std::string& path);
std::optional<Wordless> judged_picture(const std::optional<ods::Identity>& identity);  // what identify_if_open() saw
std::optional<Wordless> look_at_pixels(const ods::FormatHint& known, const std::string& path);
