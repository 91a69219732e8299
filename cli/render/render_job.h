// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods render is asked to do.
#pragma once
#include <string>
#include <string_view>

#include "cli/console/progress.h"
#include "cli/options/camera_options.h"
#include "cli/options/scene_source.h"
#include "cli/options/time_options.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

struct RenderJob {
  SceneSource scene;
  CameraOptions camera;
  TimeOptions time;
  ods::RenderOptions render;
  ods::SaveOptions save;
  bool has_layout = false;  // said by an option
  std::string output;
  std::string rig;  // of slits: its views are rendered, in place of the camera's picture
  ProgressMode progress = ProgressMode::kAuto;
};

// What --quality sets; --width and --samples go before it.
struct Quality {
  std::string_view name;
  int width;
  int samples;
};

// Those that ods video has too, in a group of their own, and what is left to do when they were read.
void add_quality_options(Options& options, RenderJob& job, Quality& quality);
void finish_render_job(const Options& options, const Quality& quality, RenderJob& job);

// False when help was asked for. Throws UsageError and ods::Error.
bool read_render_job(RenderJob& job, int argc, char** argv);
