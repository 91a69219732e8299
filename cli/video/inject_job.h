// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods inject, common to videos and pictures or specific to one.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "ods/camera/layout.h"

struct InjectJob {
  std::string file, output;
  bool is_mono = false;
  std::optional<ods::Layout> layout;
  std::string projection;  // by name; empty: not given
  std::optional<float> yaw, pitch, roll;
  bool remove = false;
  std::optional<int> track;  // of a video
  bool ambisonics = false;   // videos only
  bool for_apple = false;    // videos only
  ProgressMode progress = ProgressMode::kAuto;
};

// Both throw UsageError and ods::Error.
void inject_video(const InjectJob& job, ProgressLines& lines);
void inject_picture(const InjectJob& job);
