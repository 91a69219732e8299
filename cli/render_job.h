// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods render is asked to do.
#pragma once
#include <string>

#include "cli/camera_options.h"
#include "cli/progress.h"
#include "cli/scene_source.h"
#include "cli/time_options.h"
#include "ods/image/save.h"
#include "ods/scene/render_options.h"

struct RenderJob {
  SceneSource scene;
  CameraOptions camera;
  TimeOptions time;
  ods::RenderOptions render;
  ods::SaveOptions save;
  std::string output;
  ProgressMode progress = ProgressMode::kAuto;
};

// False when help was asked for. Throws UsageError and ods::Error.
bool read_render_job(RenderJob& job, int argc, char** argv);
