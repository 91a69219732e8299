// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods testcard as a video.
#pragma once
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/options/video_options.h"
#include "ods/compose/testcard.h"

struct TestcardVideoChoices {
  bool is_video = false;
  VideoChoices video;
  float duration = 10.0f;  // seconds
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// Adds the options in groups of their own; --progress and related ones go to the current group.
void add_testcard_video_options(Options& options, TestcardVideoChoices& choices);

// Makes the video of a card for eyes of this layout. Throws UsageError and ods::Error.
void make_video_of_card(const ods::StereoCamera& camera, ods::Extent eye, const std::vector<int>& eyes,
                        ods::Layout layout, const std::vector<std::string>& lines, const TestcardVideoChoices& choices,
                        ProgressLines& progress_lines);
