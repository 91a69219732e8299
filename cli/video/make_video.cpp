// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/make_video.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>

#include "cli/camera/stitch_frames.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/disk_room.h"
#include "cli/options/waiting.h"
#include "cli/render/device.h"
#include "cli/render/first_look.h"
#include "cli/render/forecast.h"
#include "cli/render/plan.h"
#include "cli/render/render_frames.h"
#include "cli/render/render_with_cycles.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/render_video.h"
#include "ods/sequence/shared_frames.h"

using Clock = std::chrono::steady_clock;

namespace {

ods::EncodeOptions check_encoding(const VideoJob& job, const ods::VideoPlan& expected) {
  const ods::EncodeOptions options = encode_options(job.video, expected.size, job.render.render.threads);
  ods::check_packing(expected, options.packing);
  note_player_limits(job.video, expected, options);
  return options;
}

ods::VideoJournal open_journal(const VideoJob& job, const ods::Settings& identity) {
  const RenderJob& render = job.render;
  return {job.video.output, identity, job.restart,
          render.time.only.empty() ? ods::JournalUse::kAlone : ods::JournalUse::kShared,
          std::chrono::seconds(static_cast<int>(render.wait))};
}

void announce_video(const VideoJob& job, const ods::VideoPlan& plan, const ods::EncodeOptions& options, size_t frames,
                    Clock::time_point start) {
  announce_file(job.video.output);
  note(fmt::format("{}: {}, in {}", job.video.output, video_text(plan, options, frames),
                   duration_text(seconds_since(start))));
  if (job.keep_frames) note(fmt::format("the frames are in {}.frames", job.video.output));
}

void report_rendering(ProgressLines& lines, Clock::time_point begin, double done, const ProgressStep& step) {
  lines.report(ods::kRenderingShare * done, seconds_since(begin), step);
}

std::function<void(double done)> report_encoding(const VideoJob& job, ProgressLines& lines, Clock::time_point begin,
                                                 size_t frames) {
  return [&job, &lines, begin, frames](double done) {
    lines.report(ods::kRenderingShare + (1.0 - ods::kRenderingShare) * done, seconds_since(begin),
                 video_step("encode", done, frames, job.video.output));
  };
}

// Notes what is known before the first frame. Throws ods::Error(kOutput) if the disk cannot hold the frames.
void report_start(const RenderJob& job, const ods::VideoStart& start, size_t own) {
  const std::vector<size_t>& missing = start.missing;
  const bool shared = !job.time.only.empty();
  note_existing_frames(own - missing.size(), own);
  if (!missing.empty()) report_viewpoint(job, start.renderer, start.all.front());
  report_look(job, start.renderer.options(), start.look);
  if (missing.empty()) return;
  if (!shared) warn_of_strain(job, start.renderer, start.all);
  note(fmt::format("to render: {} frame{}, {}x{} per eye, at most {} samples per pixel", missing.size(),
                   missing.size() == 1 ? "" : "s", job.render.width, job.render.height, job.render.samples));
  if (shared) return note_disk_space(job.output, missing.size(), largest_frame(job.output, job.render, job.save));
  std::vector<ods::SequenceFrame> frames;
  for (const size_t index : missing) frames.push_back(start.all[index]);
  report_forecast(job, start.renderer, frames);
}

void render_scene(const VideoJob& job, ProgressLines& lines) {
  const auto begin = Clock::now();
  const RenderJob& given = job.render;
  ods::VideoOptions video;
  video.encode =
      check_encoding(job, expect_video(given.save.layout, ods::eye_list(given.render.eyes).size(),
                                       {given.render.width, given.render.height}, given.camera.stereo.projection));
  // The choice of a card depends on the scene. For the CPU, the frames of an earlier run are checked before the scene is
  // opened.
  std::optional<ods::Scene> opened;
  if (given.device != kCpu) opened = open_lit_scene(given.scene, given.render.transparent);
  RenderJob render = opened ? on_device(given, *opened) : given;
  ods::VideoJournal journal = open_journal(job, frame_identity(identified(render)));
  render.output = journal.pattern();
  check_outputs(render);
  if (!opened) opened = open_lit_scene(given.scene, given.render.transparent);
  ods::Scene& scene = *opened;
  const TimeOptions time = video_time(render, scene);
  video.frames = video_frames(time);
  const std::vector<int> own = job.early.empty() ? own_frames(time.only, video.frames) : job.early;
  if (!time.only.empty() || !job.early.empty()) video.only = own;
  video.raw = render.raw;
  video.tone = render.tone;
  video.keep_frames = job.keep_frames;
  video.wait = render.wait;
  ods::VideoProgress progress;
  progress.late = note_late("frame", render.wait);
  progress.start = [&](const ods::VideoStart& start) {
    report_start(render, start, own.size());
    if (!video.only) note_sound_length(video.encode, video.frames.size());
  };
  progress.frames.report = [&](double done, const ods::FrameAtWork& at) {
    const double share = static_cast<double>(own.size()) / static_cast<double>(video.frames.size());
    report_rendering(lines, begin, job.early.empty() ? done : share * done, {"render", at.place, at.count, at.path});
  };
  progress.frames.saved = [&](const ods::Rendered& frame) {
    if (!time.only.empty()) std::ranges::for_each(frame.files, announce_file);
  };
  progress.frames.waiting = note_waiting("frame");
  progress.encoding = report_encoding(job, lines, begin, video.frames.size());
  const auto made = ods::render_video(journal, scene, plan(render, time).sequence, video, progress);
  lines.clear();
  if (made) announce_video(job, *made, video.encode, video.frames.size(), begin);
}

struct EncodingJob {
  const VideoJob& video;
  const RenderJob& render;  // its exposure and tone curve
  ods::ToneCurve usual_tone;
  const ods::EncodeOptions& options;
  Clock::time_point begin;  // of the whole command
};

// Makes the video of the frames that the journal keeps.
void encode_all(const EncodingJob& job, ods::VideoJournal& journal, const std::vector<int>& frames,
                ProgressLines& lines) {
  const ods::DisplayTransform display{unmeasured_exposure(job.render), job.render.tone.value_or(job.usual_tone)};
  const ods::VideoPlan plan = ods::encode_frames(journal, frames, display, job.options, job.video.keep_frames,
                                                 {report_encoding(job.video, lines, job.begin, frames.size()), {}});
  lines.clear();
  announce_video(job.video, plan, job.options, frames.size(), job.begin);
}

// Renders the frames with Cycles.
void render_in_cycles(const VideoJob& job, ProgressLines& lines) {
  const auto begin = Clock::now();
  RenderJob render = job.render;
  const ods::EncodeOptions options =
      check_encoding(job, expect_video(render.save.layout, ods::eye_list(render.render.eyes).size(),
                                       {render.render.width, render.render.height}, render.camera.stereo.projection));
  const TimeOptions time = cycles_time(render);
  const std::vector<int> numbers = video_frames(time), own = own_frames(time.only, numbers);
  ods::VideoJournal journal = open_journal(job, cycles_identity(render));
  render.output = journal.pattern();
  check_outputs(render);
  journal.plan(numbers, own);
  CyclesFrames frames;
  frames.all = ods::make_frames(plan(render, time).sequence, numbers, render.output);
  frames.missing = ods::choose_frames(frames.all, own);
  frames.shared = !time.only.empty();
  frames.move = time.move;
  frames.report = [&](double done, const ods::FrameAtWork& at) {
    journal.check();
    report_rendering(lines, begin, done, {"render", at.place, at.count, at.path});
  };
  frames.saved = [&](const std::vector<std::string>& files) {
    lines.clear();
    if (frames.shared) std::ranges::for_each(files, announce_file);
  };
  std::vector<ods::SharedFrame> files;
  for (const ods::SequenceFrame& frame : frames.all) files.push_back({frame.number, frame.path});
  ods::wait_for_frames(files, render.wait, note_late("frame", render.wait));
  note_existing_frames(own.size() - frames.missing.size(), own.size());
  check_disk_room(render.output, frames.missing.size(), largest_frame(render.output, render.render, render.save),
                  render.force || frames.shared);
  render_cycles_frames(render, frames);
  if (frames.shared) return lines.clear();
  note_sound_length(options, numbers.size());
  encode_all({job, render, ods::DisplayTransform().tone, options, begin}, journal, numbers, lines);
}

// Stitches the frames from the views of a rig.
void stitch_views(const VideoJob& job, ProgressLines& lines) {
  const auto begin = Clock::now();
  const RenderJob& render = job.render;
  const ods::SlitRig rig = open_rig(job.rig);
  StitchJob stitch;
  const ods::Layout layout = render.form.given_layout().value_or(rig.layout);
  const ods::EncodeOptions options =
      check_encoding(job, expect_video(layout, rig.eyes.size(), rig.eye, rig.camera.projection));
  ods::VideoJournal journal = open_journal(job, stitch_identity(job.rig, render.scene.name, layout));
  stitch.views.names = render.scene.name;
  stitch.output = journal.pattern();
  stitch.save = render.save;
  stitch.save.layout = layout;
  stitch.layout = layout;
  stitch.skip_existing = true;
  stitch.claims = stitch.notes_files = !render.time.only.empty();  // else the video has the claim
  if (render.time.frames.empty()) throw UsageError("--rig needs --frames: the numbers of the views' folders");
  stitch.frames = render.time.frames;
  stitch.only = render.time.only;
  const std::vector<int> numbers = ods::parse_frames(stitch.frames);
  journal.plan(numbers, own_frames(stitch.only, numbers));
  const std::vector<int> frames = stitch_frames(stitch, rig, [&](double done, const ProgressStep& step) {
    journal.check();
    report_rendering(lines, begin, done, step);
  });
  if (!stitch.only.empty()) return lines.clear();
  note_sound_length(options, frames.size());
  note_unmeasured_light(render);
  const ods::ToneCurve usual_tone =
      are_scene_linear(stitch, rig) ? ods::DisplayTransform().tone : ods::ToneCurve::kLinear;
  encode_all({job, render, usual_tone, options, begin}, journal, frames, lines);
}

}  // namespace

void make_video(const VideoJob& job, ProgressLines& lines) {
  if (job.render.cycles) return render_in_cycles(job, lines);
  job.rig.empty() ? render_scene(job, lines) : stitch_views(job, lines);
}
