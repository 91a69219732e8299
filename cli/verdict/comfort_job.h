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
  SceneSource scene;  // its name is the input's, which may be a picture
  CameraOptions camera;
  ods::ComfortOptions comfort;
  std::string right;       // the right eye's file; empty if there is one input
  ods::FormatHint format;  // of a picture or a video
  int width = 1024;        // of the pictures of a scene that are judged
  std::string heat;        // file for the levels as a picture; empty: none
  std::string html;        // file for the report as a page; empty: none
  bool json = false;
  std::vector<GivenWord> given;                 // the command line
  ProgressMode progress = ProgressMode::kAuto;  // of a video
};

ComfortJob parse_comfort(Options& options);

// Determines the kind of the input, and applies the options for it. Throws UsageError and ods::Error.
void settle_input(ComfortJob& job);
