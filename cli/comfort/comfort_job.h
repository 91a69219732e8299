// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods comfort.
#pragma once
#include <string>

#include "cli/console/progress.h"
#include "cli/options/camera_options.h"
#include "cli/options/scene_source.h"
#include "ods/comfort/comfort.h"
#include "ods/picture/metadata/stereo_format.h"

enum class ComfortInput { kScene, kPicture, kVideo };

struct ComfortJob {
  ComfortInput input = ComfortInput::kScene;
  SceneSource scene;  // its name is that of the input, which may be a picture
  CameraOptions camera;
  ods::ComfortOptions comfort;
  ods::FormatHint format;  // of a picture or a video
  int width = 1024;        // of the pictures of a scene that are judged
  std::string heat;        // where to save the levels as a picture; empty: nowhere
  std::string html;        // likewise the report as a page
  bool json = false;
  std::vector<GivenWord> given;  // the command line
  ProgressMode progress = ProgressMode::kAuto;  // of a video
};

ComfortJob parse_comfort(Options& options);

// Looks at what the input is, and applies the options that it has. Throws UsageError and ods::Error.
void settle_input(ComfortJob& job);
