// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/video_job.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/render/device.h"
#include "cli/render/plan.h"

namespace {

constexpr const char* kVideoExamples =
    "  ods video scene.glb -o video_360_TB.mp4\n"
    "  ods video scene.glb -o video_360_TB.mp4 --target quest --width 4096 --fps 60 --audio sound.wav\n"
    "  ods video room -o room_360_TB.mp4 --quality draft --turntable 1 --duration 20\n"
    "  ods video scene.glb -o master.mov --target master --frames 1-250 --keep-frames\n"
    "  ods video 'views/####/####.exr' --rig rig.json -o video_360_TB.mp4 --frames 1-250   as ods stitch";

constexpr const char* kVideoSummary =
    "Renders a scene frame by frame, encodes the frames and writes the 360 metadata that players need. The frames are\n"
    "kept in VIDEO.frames until the video is complete: after an interruption, give the same command again to continue.";

}  // namespace

VideoJob parse_video(Options& options) {
  VideoJob job;
  RenderJob& render = job.render;
  options.describe(kVideoSummary, kVideoExamples);
  add_scene_argument(options, render.scene);
  add_light_options(options, render.scene.light);
  add_video_options(options, job.video);
  options.text("--rig", ValueKind::input_file(), job.rig,
               "stitch the views of this rig (made by ods rig); SCENE is then the views' file names");
  options.flag("--keep-frames", job.keep_frames, "keep VIDEO.frames, which ods encode can read");
  add_restart_option(options, job.restart);
  options.flag("--raw", render.raw,
               "with --only: only render the frames, and keep them noisy beside the final ones; the same command "
               "without --raw denoises them");
  options.flag("--force", render.force, "render the frames even if the disk cannot hold them");
  add_wait_option(options, render.wait, "frames");
  options.group("Picture");
  add_picture_options(options, render.form, render.save.sidecar);
  add_object_options(options, render.scene.objects, "the scene");
  add_exposure_option(options, render);
  options.choice("--tone", job.render.tone, ods::kToneCurveTable, "tone curve",
                 std::string(ods::tone_curve_name(ods::DisplayTransform().tone)));
  add_camera_options(options, render.camera);
  add_time_options(options, render.time);
  add_quality_options(options, render);
  add_device_option(options, render);
  options.group("Console");
  add_progress_options(options, render.progress);
  options.parse();
  if (render.time.time) throw UsageError("--time is for single pictures; choose a video's frames with --frames");
  if (render.save.sidecar) throw UsageError("--sidecar is for pictures; a video carries its own metadata");
  if (!job.rig.empty()) options.refuse({"--device"}, "cannot be used with --rig");
  render.time.is_video = render.time.skip_existing = true;
  finish_render_options(options, render);
  if (!render.time.only.empty() && job.restart) {
    throw UsageError("--restart and --only exclude each other: other processes may be making frames");
  }
  render.render.layers = false;
  if (render.raw && (render.time.only.empty() || !job.rig.empty() || !plan(render).sequence.draws_on_neighbours)) {
    throw UsageError("--raw needs --only, and frames that ods denoises");
  }
  return job;
}

VideoJob settled(VideoJob job) {
  if (job.rig.empty()) job.render = settled(job.render);  // else the scene is the names of the views
  job.video.rate = parse_rate(fmt::format("{}", job.render.time.fps));
  job.render.time.fps = static_cast<float>(job.video.rate.value());
  return job;
}
