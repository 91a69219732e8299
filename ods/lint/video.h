// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the faults of a stereo 360 video: every frame is decoded, for cuts, duplicate frames and a time offset between
// the eyes; some are judged as pictures. A fault of the pictures counts if it is in most of the judged frames of a
// shot, from one cut to the next. Memory is bounded: one frame at a time, and some numbers for each.
#pragma once
#include "ods/base/progress.h"
#include "ods/lint/lint.h"

namespace ods {

struct VideoLintOptions {
  LintOptions picture;
  int every = 0;  // judge one of this many frames as a picture; 0 for about 24 in total, and one of every shot
};

// Reports on the whole video: a finding has the times of the frames that show it. Throws Error(kInput), like
// open_video() and VideoDecoder, and Error(kCancelled).
LintReport lint_video(const std::string& path, const VideoLintOptions& options = {}, const Progress& progress = {});

}  // namespace ods
