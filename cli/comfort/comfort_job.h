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
  std::string heat;        // file for the levels as a picture; empty: none
  std::string html;        // file for the report as a page; empty: none
  bool json = false;
  ProgressMode progress = ProgressMode::kAuto;  // of a video
};

// False if help was requested. Throws UsageError and ods::Error.
bool read_comfort_job(ComfortJob& job, int argc, char** argv);
