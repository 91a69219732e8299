// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video: renders a scene as a video.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/options/video_options.h"
#include "cli/render/render_frames.h"
#include "cli/slits/stitch_frames.h"
#include "cli/video/video_journal.h"

namespace {

constexpr const char* kExamples =
    "  ods video scene.glb -o video_360_TB.mp4\n"
    "  ods video scene.glb -o video_360_TB.mp4 --target quest --width 4096 --fps 60 --audio sound.wav\n"
    "  ods video room -o room_360_TB.mp4 --quality draft --turntable 1 --duration 20\n"
    "  ods video scene.glb -o master.mov --target master --frames 1-250 --keep-frames\n"
    "  ods video 'views/####/####.exr' --rig rig.json -o video_360_TB.mp4 --frames 1-250   as ods stitch";

constexpr const char* kSummary =
    "Renders a scene frame by frame, encodes the frames and writes the 360 metadata that players need. The frames are\n"
    "kept in VIDEO.frames until the video is complete: after an interruption, give the same command again to continue.";

struct VideoJob {
  RenderJob render;
  ods::DisplayTransform display;
  VideoWishes video;
  std::string rig;  // a slit rig: stitch its views instead of rendering
  bool keep_frames = false, restart = false;
};

bool read_options(VideoJob& job, int argc, char** argv) {
  RenderJob& render = job.render;
  Quality quality;
  Options options("video", kSummary, kExamples);
  add_scene_argument(options, render.scene);
  add_light_options(options, render.scene.light);
  add_video_options(options, job.video);
  options.text("--rig", "FILE", job.rig,
               "stitch the views of this rig (made by ods rig); SCENE is then the views' file names");
  options.flag("--keep-frames", job.keep_frames, "keep VIDEO.frames, which ods encode can read");
  options.flag("--restart", job.restart, "discard frames rendered with other options and start over");
  options.group("Picture");
  add_picture_options(options, render.render, render.save);
  add_exposure_option(options, render);
  options.choice("--tone", job.display.tone, ods::kToneCurveTable, "tone curve");
  add_camera_options(options, render.camera);
  add_time_options(options, render.time);
  add_quality_options(options, render, quality);
  options.group("Console");
  add_progress_options(options, render.progress);
  if (!options.parse(argc, argv)) return false;
  if (render.time.time) throw UsageError("--time is for single pictures; choose a video's frames with --frames");
  if (render.save.sidecar) throw UsageError("--sidecar is for pictures; a video carries its own metadata");
  finish_render_job(options, quality, render);
  render.render.layers = false;
  render.time.is_video = render.time.skip_existing = true;
  job.video.rate = parse_rate(fmt::format("{}", render.time.fps));
  render.time.fps = static_cast<float>(job.video.rate.value());
  return true;
}

// Stitches frames from the views of a rig.
RenderedFrames stitch_views(const VideoJob& job, const ods::SlitRig& rig, VideoJournal& journal,
                            const StepReport& report) {
  StitchJob stitch;
  stitch.views.names = job.render.scene.name;
  stitch.output = job.render.output;
  stitch.frames = job.render.time.frames;
  stitch.save = job.render.save;
  stitch.layout = job.render.save.layout;
  stitch.skip_existing = true, stitch.claims = false, stitch.says_files = false;
  if (stitch.frames.empty()) throw UsageError("--rig needs --frames: the numbers of the views' folders");
  journal.plan(ods::parse_frames(stitch.frames));
  return {stitch_frames(stitch, rig, report), job.render.exposure.value_or(0.0f)};
}

void make_video(VideoJob job, ProgressLines& lines) {
  const double kRendering = 0.95;  // share of the total time
  const auto start = std::chrono::steady_clock::now();
  const RenderJob& render = job.render;
  const std::optional<ods::SlitRig> rig = job.rig.empty() ? std::nullopt : std::optional(open_rig(job.rig));
  if (rig && !render.has_layout) job.render.save.layout = rig->layout;
  const ods::VideoPlan expected =
      rig ? expect_video(render.save.layout, rig->eyes.size(), rig->eye, rig->camera.projection)
          : expect_video(render.save.layout, ods::eye_list(render.render.eyes).size(),
                         {render.render.width, render.render.height}, render.camera.stereo.projection);
  const ods::EncodeOptions options = encode_options(job.video, expected.size, job.render.render.threads);
  ods::check_packing(expected, options.packing);
  say_what_players_need(job.video, expected, options);
  VideoJournal journal(job.video.output,
                       rig ? stitch_settings(job.rig, render.scene.name, render.save) : frame_settings(render),
                       job.restart);
  job.render.output = journal.pattern();
  const auto rendered = [&](double done, const ProgressStep& step) {
    journal.check();
    lines.report(kRendering * done, seconds_since(start), step);
  };
  const auto planned = [&](const std::vector<int>& numbers) { journal.plan(numbers); };
  const RenderedFrames made =
      rig ? stitch_views(job, *rig, journal, rendered) : render_frames(render, rendered, planned);
  const std::vector<int>& frames = made.numbers;
  job.display.exposure = made.exposure;

  const ods::FrameFiles files = ods::find_frames(journal.pattern(), frames);
  const ods::VideoPlan plan = ods::plan_video(files, {}, {});
  say_length_of_sound(options, frames.size());
  ods::Progress progress;
  progress.report = [&](double done) {
    lines.report(kRendering + (1.0 - kRendering) * done, seconds_since(start),
                 video_step("encode", done, frames.size(), job.video.output));
  };
  ods::make_video(files, plan, job.display, options, job.video.output, progress);
  lines.clear();
  announce_file(job.video.output);
  note(fmt::format("{}: {}, in {}", job.video.output, video_text(plan, options, frames.size()),
                   duration_text(seconds_since(start))));
  if (job.keep_frames) return note(fmt::format("the frames are in {}", journal.folder()));
  journal.remove();
}

void video(int argc, char** argv) {
  VideoJob job;
  if (!read_options(job, argc, argv)) return;
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make_video(job, lines); });
}

}  // namespace

int ods_video(int argc, char** argv) {
  return run_command([=] { video(argc, argv); });
}
