// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The option --apple of the commands that write videos.
#pragma once
#include "cli/console/console.h"
#include "cli/console/options.h"
#include "ods/video/container/video_file.h"

inline void add_apple_option(Options& options, bool& for_apple) {
  options.flag("--apple", for_apple,
               "also write a vexu box for Apple's players; FFmpeg 7.1 and later then misread the layout");
}

// Throws UsageError.
inline void check_apple(bool for_apple, ods::Container container) {
  if (for_apple && !has_boxes(container))
    throw UsageError("--apple is for mp4 and mov: Apple's players read no others");
}
