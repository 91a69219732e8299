// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods rig: plans perspective cameras from which any renderer's pictures can be stitched to ODS, and reports the error.
#include <fmt/format.h>

#include <algorithm>

#include "cli/camera/rig_report.h"
#include "cli/camera/rig_scripts.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/options/camera_source.h"
#include "cli/options/eye_options.h"
#include "cli/options/scene_source.h"
#include "ods/render/cpu/render.h"
#include "ods/stage/judge_scene.h"
#include "ods/stitch/slit_error.h"

namespace {

constexpr const char* kRigExamples =
    "  ods rig --width 4096 --nearest 0.8 -o rig.json\n"
    "  ods rig --scene room --max-error 0.25 -o rig.json --for blender,povray   scripts for these, beside it\n"
    "  ods rig --camera-file picture.camera.json --slits 360      reports its error";

constexpr float kMaxError = 0.5f;

struct RigJob {
  CameraSource source;
  SceneSource scene;
  ods::SlitOptions slits;
  std::optional<int> count;
  std::optional<float> nearest;
  std::optional<float> max_error;  // pixels; by default kMaxError
  std::string output;
  std::vector<ods::RigTarget> targets;
};

void add_slit_options(Options& options, RigJob& job) {
  options.group("Slits");
  options.number("--max-error", job.max_error, 0.001f, 1000.0f,
                 "largest error of the nearest object, pixels; sets the number of slits", fmt::format("{}", kMaxError));
  options.number("--nearest", job.nearest, 0.01f, 1e6f,
                 "distance to the nearest object, metres; by default 1, or measured in --scene");
  add_scene_option(options, job.scene, "measure --nearest in this scene, from its camera");
  options.number("--slits", job.count, 3, 32768, "number of slits per eye, instead of --max-error");
  options.number("--pitches", job.slits.pitches, 1, 64, "number of views above each other per slit");
  options.flag("--caps", job.slits.caps, "point the top view straight up and the bottom view straight down");
  options.number("--blend", job.slits.blend, 0.0f, 1.0f, "share of a slit that blends into the next one");
  options.number("--padding", job.slits.padding, 0, 4096, "extra pixels around each view, for effects such as bloom");
  options.number("--scale", job.slits.scale, 0.01f, 16.0f, "resolution of the views relative to the picture");
  options.choice("--depth", job.slits.depth, ods::kViewDepthTable,
                 "depth that the views will have: along the ray, or of a depth buffer (plane); with depth, a tenth of "
                 "the slits is enough");
}

RigJob parse_rig(Options& options) {
  RigJob job;
  job.source.camera.may_follow_depth = true;
  job.source.camera.stereo = {};  // no merge: each step from one pitch of the views to the next would show it
  options.describe(
      "Plans perspective cameras for other renderers; ods stitch combines their views into an ODS picture.",
      kRigExamples);
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "the rig as JSON, for ods stitch; by default only prints the plan");
  add_script_option(options, job.targets);
  add_slit_options(options, job);
  add_camera_source(options, job.source);
  options.group("Console");
  add_console_options(options);
  options.parse();
  if (job.count && job.max_error) throw UsageError("--slits and --max-error exclude each other");
  if (!job.targets.empty() && job.output.empty()) throw UsageError("--for writes next to the rig: add -o rig.json");
  if (job.nearest && !job.scene.name.empty()) throw UsageError("--nearest and --scene exclude each other");
  if (job.source.camera.changes.merge_limit && job.scene.name.empty()) {
    throw UsageError(
        "--merge auto follows from depth, and a rig has none: add --scene SCENE, or stitch views with depth "
        "by ods stitch --merge auto");
  }
  return job;
}

// The nearest depth, as the eyes see it.
float measure(const ods::Scene& scene, ods::StereoCamera camera) {
  ods::RenderOptions options;
  options.width = 1024, options.height = 512, options.samples = 1, options.bounces = 0;
  camera.projection = {};
  float nearest = ods::kFarDepth;
  for (const ods::EyeImage& eye : render_cpu(scene, camera, options).eyes) {
    for (const float depth : eye.depth.pixels) nearest = std::min(nearest, depth > 0.0f ? depth : nearest);
  }
  if (nearest >= ods::kFarDepth) throw UsageError("--scene: the camera sees nothing there; give --nearest M");
  return nearest;
}

// The camera and the nearest distance.
std::pair<ods::Sidecar, float> survey(RigJob& job) {
  ods::Sidecar file = read_camera_source(job.source);
  if (job.scene.name.empty()) return {file, job.nearest.value_or(1.0f)};
  job.scene.has_places = true;  // the rig is for programs that have the scene in its own size
  job.scene.camera = job.source.camera.view_point;
  ods::Scene scene = open_scene(job.scene);
  expect_content(scene, job.scene.name);
  file.camera = place_camera(job.source.camera, scene);
  if (const std::optional<float> limit = job.source.camera.changes.merge_limit) {
    ods::Image map = ods::merge_map_of(ods::shares_seen(ods::CpuRenderer(scene), file.camera, *limit));
    note(merge_by_depth_text(map));
    ods::use_merge_map(file.camera, std::move(map));
  }
  return {file, measure(scene, file.camera)};
}

void rig(RigJob job) {
  const auto [file, nearest] = survey(job);
  if (!job.scene.name.empty()) note(fmt::format("the nearest surface is {:.3g} m away", nearest));
  job.slits.slits = job.count
                        ? *job.count
                        : ods::slits_for(file.camera, file.eye, job.slits, nearest, job.max_error.value_or(kMaxError));
  const std::string fault = slit_fault(file.camera, file.eye, job.slits);
  if (!fault.empty()) throw UsageError(fault);
  ods::SlitRig made = make_slit_rig(file.camera, file.eye, file.eyes, job.slits);
  made.layout = file.layout;
  if (job.output.empty() || !console.quiet) print_plan(made, nearest);
  if (!job.output.empty()) write_rig(made, job.targets, job.output);
}

}  // namespace

extern const Command kRig = make_command<parse_rig, rig>("rig", "plan perspective cameras for other renderers");
