// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video: renders a scene as a video, or some of its frames.
#include <fmt/format.h>

#include <chrono>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/render/frame_settings.h"
#include "cli/render/render_frames.h"
#include "cli/slits/stitch_frames.h"
#include "cli/video/video_job.h"
#include "ods/sequence/render_video.h"

namespace {

// Stitches frames from the views of a rig.
RenderedFrames stitch_views(const VideoJob& job, const ods::SlitRig& rig, ods::VideoJournal& journal,
                            const StepReport& report) {
  StitchJob stitch;
  stitch.views.names = job.render.scene.name;
  stitch.output = job.render.output;
  stitch.save = job.render.save;
  stitch.layout = job.render.save.layout;
  stitch.skip_existing = true;
  stitch.claims = stitch.says_files = !job.render.time.only.empty();  // else the video has the claim
  if (job.render.time.frames.empty()) throw UsageError("--rig needs --frames: the numbers of the views' folders");
  const std::vector<int> frames = ods::parse_frames(job.render.time.frames);
  journal.plan(frames, own_frames(job.render.time.only, frames));
  stitch.frames = job.render.time.frames;
  stitch.only = job.render.time.only;
  return {stitch_frames(stitch, rig, report), job.render.exposure.value_or(job.render.brighter)};
}

void make_video(VideoJob job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  const RenderJob& render = job.render;
  const std::optional<ods::SlitRig> rig = job.rig.empty() ? std::nullopt : std::optional(open_rig(job.rig));
  const ods::VideoPlan expected =
      rig ? expect_video(render.save.layout, rig->eyes.size(), rig->eye, rig->camera.projection)
          : expect_video(render.save.layout, ods::eye_list(render.render.eyes).size(),
                         {render.render.width, render.render.height}, render.camera.stereo.projection);
  const ods::EncodeOptions options = encode_options(job.video, expected.size, job.render.render.threads);
  ods::check_packing(expected, options.packing);
  say_what_players_need(job.video, expected, options);
  ods::VideoJournal journal(job.video.output,
                            rig ? stitch_settings(job.rig, render.scene.name, render.save) : frame_settings(render),
                            job.restart, render.time.only.empty() ? ods::JournalUse::kAlone : ods::JournalUse::kShared,
                            std::chrono::seconds(static_cast<int>(render.wait)));
  job.render.output = journal.pattern();
  const auto rendered = [&](double done, const ProgressStep& step) {
    journal.check();
    lines.report(ods::kRenderingShare * done, seconds_since(start), step);
  };
  const auto planned = [&](const std::vector<int>& numbers) {
    journal.plan(numbers, own_frames(render.time.only, numbers));
  };
  const RenderedFrames made =
      rig ? stitch_views(job, *rig, journal, rendered) : render_frames(render, rendered, planned);
  if (!render.time.only.empty()) return lines.clear();
  const std::vector<int>& frames = made.numbers;
  job.display.exposure = made.exposure;
  if (made.as_painted && !gives(render, "--tone")) job.display.tone = ods::ToneCurve::kLinear;

  say_length_of_sound(options, frames.size());
  ods::Progress progress;
  progress.report = [&](double done) {
    lines.report(ods::kRenderingShare + (1.0 - ods::kRenderingShare) * done, seconds_since(start),
                 video_step("encode", done, frames.size(), job.video.output));
  };
  const ods::VideoPlan plan =
      ods::encode_frames(journal, frames, job.display, options, job.video.output, job.keep_frames, progress);
  lines.clear();
  announce_file(job.video.output);
  note(fmt::format("{}: {}, in {}", job.video.output, video_text(plan, options, frames.size()),
                   duration_text(seconds_since(start))));
  if (job.keep_frames) note(fmt::format("the frames are in {}", journal.folder()));
}

void video(const VideoJob& given) {
  const VideoJob job = settled(given);
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { make_video(job, lines); });
}

}  // namespace

extern const Command kVideo = make_command<parse_video, video>("video", "render a scene as a stereo 360 video");
