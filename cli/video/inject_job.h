// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods inject was asked for: what videos and pictures share, and what only one of them knows.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "ods/camera/layout.h"

struct InjectJob {
  std::string file, output;
  bool is_mono = false;
  std::optional<ods::Layout> layout;
  std::string projection;  // by its name; empty: nobody said
  std::optional<float> yaw, pitch, roll;
  bool remove = false;
  std::optional<int> track;  // of a video
  bool ambisonics = false;   // likewise
  bool for_apple = false;    // likewise
};

// Each throws UsageError, and what the library throws.
void inject_video(const InjectJob& job, ProgressLines& lines);
void inject_picture(const InjectJob& job);
