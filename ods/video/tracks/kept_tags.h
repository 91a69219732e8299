// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tags and chapters of an old video in a new one. What is true of the old file alone (its brands, its encoder, the
// statistics of its streams) stays behind.
#pragma once
#include <string>
#include <vector>

#include "ods/video/tracks/keep_options.h"

struct AVDictionary;
struct AVFormatContext;

namespace ods {

namespace av {
void copy_tags(const AVDictionary* from, AVDictionary** to, bool is_pictures);
// Of a part: those that it has any of, with its own times.
void copy_chapters(const AVFormatContext& from, const TimeCut& cut, AVFormatContext& to);
}  // namespace av

// The old file's tags that the new one lacks: "tag DIRECTOR (Ada)". Throws Error(kInput).
std::vector<std::string> lost_tags(const KeepOptions& keep, const std::string& made);

}  // namespace ods
