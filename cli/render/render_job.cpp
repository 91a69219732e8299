// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_job.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"

namespace {

constexpr const char* kExamples =
    "  ods render scene.glb -o picture.png\n"
    "  ods render scene.glb -o picture.exr --width 4096 --samples 256 --env sky.hdr\n"
    "  ods render scene.glb -o picture.jpg --position 0,1.6,0 --yaw 90 --quality draft\n"
    "  ods render scene.glb -o eye_%V.png         eye_left.png and eye_right.png\n"
    "  ods render scene.glb -o picture.png --merge cosine,60,90\n"
    "  ods render scene.glb -o shot.####.exr --frames 1-100 --fps 30\n"
    "  ods render scene.glb -o 'views/####.exr' --rig rig.json";

void add_picture_options(Options& options, RenderJob& job) {
  options.group("Picture");
  options.text("-o,--output", "FILE", job.output,
               "output file: .png .jpg .tif .webp .hdr .exr; %V in the name writes one file per eye");
  add_picture_options(options, job.render, job.save);
  options.text("--rig", "FILE", job.rig, "render the views of this rig (made by ods rig), for ods stitch");
  options.flag("--statistics", job.render.statistics,
               "also write each pixel's variance and number of samples, for ods denoise (.exr)");
  options.flag("--transparent", job.render.transparent,
               "leave the background transparent, for ods over; the sky still lights the scene (.exr .png .tif .webp)");
  options.texts(
      "--shadow-catcher", "NAME", job.scene.catchers,
      "make an object or material a shadow catcher: only the shadows on it are visible (needs --transparent)");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f,
                 "exposure in stops; .hdr and .exr stay scene-linear and ignore it");
  options.choice("--tone", job.save.tone, ods::kToneCurveTable, "tone curve; ignored as --exposure is");
}

// A rig has its own cameras and size.
void check_rig(const Options& options, const RenderJob& job) {
  if (job.rig.empty()) return;
  for (const char* own : {"--width", "--height", "--size", "--eyes", "--layout", "--position", "--camera", "--yaw",
                          "--pitch", "--roll", "--ipd", "--projection", "--frames", "--shutter"}) {
    if (options.given(own)) throw UsageError(fmt::format("{} cannot be used with --rig", own));
  }
}

}  // namespace

void finish_render_job(const Options& options, const Quality& quality, RenderJob& job) {
  check_time_options(job.time);
  finish_quality(options, quality, job);
  job.has_layout = options.given("--layout") || options.given("--size");
  finish_picture_options(options, job.camera.stereo.projection, job.render, job.save);
  finish_camera_options(job.camera, job.render.width, job.render.height);
}

bool read_render_job(RenderJob& job, int argc, char** argv) {
  Quality quality;
  Options options("render", "Renders a scene as a stereo 360 picture, or as the frames of a video.", kExamples);
  add_scene_argument(options, job.scene);
  add_light_options(options, job.scene);
  add_picture_options(options, job);
  add_camera_options(options, job.camera);
  add_time_options(options, job.time);
  add_quality_options(options, job, quality);
  options.group("Console");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  if (options.given("--exposure") && keeps_light(job.output))
    note("--exposure does not change .exr and .hdr, which are scene-linear");
  if (job.render.transparent && !ods::has_alpha(job.output)) {
    throw UsageError("--transparent needs a format with alpha: .exr, .png, .tif or .webp");
  }
  if (!job.scene.catchers.empty() && !job.render.transparent) {
    throw UsageError("--shadow-catcher needs --transparent");
  }
  if (job.render.statistics && !ods::keeps_layers(job.output)) throw UsageError("--statistics needs an .exr");
  job.render.layers = ods::keeps_layers(job.output);
  check_rig(options, job);
  finish_render_job(options, quality, job);
  return true;
}
