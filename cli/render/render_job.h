// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods render.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "cli/options/camera_options.h"
#include "cli/options/scene_source.h"
#include "cli/options/time_options.h"
#include "cli/render/quality.h"
#include "ods/denoise/denoise.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

struct RenderJob {
  SceneSource scene;
  CameraOptions camera;
  TimeOptions time;
  ods::RenderOptions render;
  ods::SaveOptions save;
  std::optional<ods::Denoiser> denoise;  // none: for all files but those that keep the scene's light
  std::optional<float> exposure;         // stops; none: ods::look_first() chooses
  float brighter = 0.0f;                 // stops, added to what it chooses
  bool has_layout = false;               // given by an option
  bool object_layer = false;             // an .exr gets the names of what its pixels show
  std::string output;
  std::string rig;                // a slit rig: render its views instead of the camera's picture
  std::optional<ods::Part> part;  // of the samples
  int parts = 0;                  // --parts, for ods submit
  bool keep_parts = false;        // likewise: when they are merged
  float wait = 0.0f;              // seconds: for files that other machines have written
  bool raw = false;               // render a video's frames for the denoiser, which another process runs
  bool force = false;             // render a video's frames although the disk cannot hold them
  std::vector<GivenWord> given;   // the command line
  bool restart = false;           // a still picture does not go on from what an interrupted run has kept
  bool save_unfinished = false;   // an interrupted one is saved as it is
  ProgressMode progress = ProgressMode::kAuto;
};

// Whether the command line gave an option.
bool gives(const RenderJob& job, std::string_view option);

// Adds --exposure auto|STOPS and --brighter STOPS.
void add_exposure_option(Options& options, RenderJob& job);

// What a scene of another program says of camera and time: the default of the options.
void take_foreign(RenderJob& job, const ForeignScene& scene);

// What remains to be done after parsing, for ods video, too.
void finish_render_job(const Options& options, const Quality& quality, RenderJob& job);

// Adds --wait SECONDS.
void add_wait_option(Options& options, float& seconds, const char* noun);

// False if help was requested. for_farm: ods submit reads the line, which may have --parts. Throws UsageError and
// ods::Error.
bool read_render_job(RenderJob& job, int argc, char** argv, bool for_farm = false);
