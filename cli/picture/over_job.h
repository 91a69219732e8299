// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods over is asked to do.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/options/video_options.h"
#include "ods/compose/over.h"
#include "ods/picture/save.h"

struct OverJob {
  std::string foreground, background, output;
  ods::FormatHint known;  // of the background
  std::optional<std::vector<int>> frames;
  ods::OverOptions over;
  ods::SaveOptions save;
  std::optional<ods::Layout> layout;
  bool has_tone = false, has_exposure = false;
  VideoWishes video;
  bool has_target = false;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// False when help was asked for. Throws UsageError and ods::Error.
bool read_over_job(OverJob& job, int argc, char** argv);

// Throws UsageError where this cannot be laid over that. `first` is its first picture, or what a video's are like.
void check_over(const OverJob& job, const ods::StoredPicture& first, const ods::StoredPicture& background);
