// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods render.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "cli/bridge/cycles_session.h"
#include "cli/console/progress.h"
#include "cli/cycles/renderer.h"
#include "cli/options/camera_options.h"
#include "cli/options/picture_options.h"
#include "cli/options/scene_source.h"
#include "cli/options/time_options.h"
#include "cli/render/quality.h"
#include "ods/denoise/denoise.h"
#include "ods/picture/save.h"
#include "ods/render/render_options.h"

// The word for the processor in RenderJob::device.
inline constexpr const char* kCpu = "cpu";

struct RenderJob {
  SceneSource scene;
  CameraOptions camera;
  TimeOptions time;
  Quality quality;
  PictureForm form;
  ods::RenderOptions render;  // its size and eyes after settled()
  Renderer renderer = Renderer::kOds;
  std::shared_ptr<CyclesSession> cycles;  // that renders, after settled(); null: our renderer does
  std::string device = kCpu;              // on_device() sets the card in `render`
  ods::SaveOptions save;                  // its layout after settled()
  std::optional<ods::Denoiser> denoise;   // absent: the default for all files but those that keep the scene's light
  std::optional<float> exposure;          // stops, without `brighter`; none: known for the scene (plan()), or chosen
  float brighter = 0.0f;                  // stops, added to the exposure, given or chosen
  std::optional<ods::ToneCurve> tone;     // none: the usual curve, or none for a scene shown as painted
  bool object_layer = false;              // an .exr gets the names of the objects that its pixels show
  std::string output;
  std::string rig;                // a slit rig: render its views instead of the camera's picture
  std::optional<ods::Part> part;  // of the samples
  int parts = 0;                  // --parts, for ods submit
  bool keep_parts = false;        // the parts stay after they are merged
  float wait = 0.0f;              // seconds: for files that other machines have written
  bool raw = false;               // render a video's frames for the denoiser, which another process runs
  bool force = false;             // render a video's frames although the disk cannot hold them
  std::vector<GivenWord> given;   // the command line
  bool restart = false;           // a still picture does not resume from the samples of an interrupted run
  bool save_unfinished = false;   // an interrupted one is saved as it is
  ProgressMode progress = ProgressMode::kAuto;
};

// Adds --exposure auto|STOPS and --brighter STOPS.
void add_exposure_option(Options& options, RenderJob& job);

// The part of parsing that ods video shares.
void finish_render_options(Options& options, RenderJob& job);

// Adds --wait SECONDS.
void add_wait_option(Options& options, float& seconds, const char* noun);

RenderJob parse_render(Options& options);

// Returns the job with the settings that depend on files: has a scene of another program converted, whose camera and
// frame rate are the defaults, reads the camera's file and maps, and finds size and layout. Throws UsageError and
// ods::Error.
RenderJob settled(RenderJob job);
