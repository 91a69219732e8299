// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods over.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/options/picture_options.h"
#include "cli/options/share_options.h"
#include "cli/options/video_options.h"
#include "ods/compose/over.h"
#include "ods/picture/save.h"

struct OverJob {
  std::string foreground, background, output;
  ods::FormatHint known;  // of the background
  std::optional<std::vector<int>> frames;
  FrameShare share;
  ods::OverOptions over;
  ods::SaveOptions save;
  std::optional<ods::Layout> layout;
  DisplayOptions display;
  VideoChoices video;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

OverJob parse_over(Options& options);

// Throws UsageError if the two cannot be composited. `first` is the foreground's first picture,
// or a template of a video's.
void check_over(const OverJob& job, const ods::StoredPicture& first, const ods::StoredPicture& background);
