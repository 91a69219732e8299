// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods comfort.
#pragma once
#include <string>

#include "cli/options/camera_options.h"
#include "cli/options/scene_source.h"
#include "ods/comfort/comfort.h"

struct ComfortJob {
  SceneSource scene;  // its name is that of the input, which may be a picture
  CameraOptions camera;
  ods::ComfortOptions comfort;
  int width = 1024;  // of the pictures of a scene that are judged
  std::string heat;  // where to save the levels as a picture; empty: nowhere
  bool json = false;
};

// Whether the input is a picture by its name; else it is a scene.
bool is_picture(const ComfortJob& job);

// False if help was requested. Throws UsageError and ods::Error.
bool read_comfort_job(ComfortJob& job, int argc, char** argv);
