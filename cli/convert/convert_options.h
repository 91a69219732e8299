// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods convert. Settings that are absent stay as in the input.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/convert/depth_input.h"
#include "cli/options/camera_options.h"
#include "cli/options/picture_options.h"
#include "cli/options/share_options.h"
#include "cli/options/video_options.h"
#include "ods/convert/convert.h"
#include "ods/convert/video/convert_video.h"

struct ConvertOptions {
  std::vector<std::string> words;  // the command line
  std::vector<std::string> files;  // of the input
  std::string input;               // joined_input() of them
  std::string output;
  ods::FormatHint known;  // about the input
  std::optional<float> input_fov;
  DepthInput depth;
  std::optional<std::vector<int>> frames;
  CameraOptions camera;  // its file is the input's camera
  PictureForm form;
  bool mono = false;
  bool sidecar = false;
  DisplayOptions display;
  ods::Holes holes = ods::Holes::kFilled;
  ods::EyeCorrection right;

  // Frames and videos.
  FrameShare share;
  bool restart = false;  // discard the parts of a video that an interrupted run has left
  std::optional<ods::TimeSpan> trim;
  ods::TimeSpan span() const { return trim.value_or(ods::TimeSpan()); }
  std::string turns;  // --stabilize: a file of turn keys
  std::optional<ods::FrameRate> rate;
  VideoChoices video;  // its rate is `rate`, if given

  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

ConvertOptions parse_convert(Options& options);
