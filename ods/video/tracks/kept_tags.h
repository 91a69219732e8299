// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Copies tags and chapters of an old video to a new one. Tags that apply only to the old file (its brands, its encoder,
// the statistics of its streams) are not copied.
#pragma once
#include <string>
#include <vector>

#include "ods/video/tracks/keep_options.h"

struct AVDictionary;
struct AVFormatContext;

namespace ods {

namespace av {
void copy_tags(const AVDictionary* from, AVDictionary** to, bool is_pictures);
// For a part, copies the chapters that overlap it, with its own times.
void copy_chapters(const AVFormatContext& from, const TimeCut& cut, AVFormatContext& to);
}  // namespace av

// The old file's tags that are missing in the new one: "tag DIRECTOR (Ada)". Throws Error(kInput).
std::vector<std::string> lost_tags(const KeepOptions& keep, const std::string& made);

}  // namespace ods
