// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The format of a file without metadata, by its pixels, for ods inject and the advice of ods probe: a square video may
// be anything, and must not become a sphere by its shape alone.
#pragma once
#include <optional>
#include <string>

#include "ods/identify/open_media.h"

struct Wordless {
  std::optional<ods::Reading> reading;  // the sure reading of the pixels, if the file's metadata can express it
  std::string text;                     // the reason, or the possible readings and the options that decide
};

// Returns nullopt if metadata or name identify the file, or its pixels show nothing at all; then its shape counts.
std::optional<Wordless> judge_wordless(const ods::MediaFile& media);

// Throws Error(kInput) if the pixels are needed and do not give a reading that can be written.
std::optional<Wordless> wordless_to_tag(const ods::MediaFile& media);
