// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_frames.h"

#include <fmt/format.h>

#include <chrono>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/disk_room.h"
#include "cli/options/picture_options.h"
#include "cli/options/waiting.h"
#include "cli/render/device.h"
#include "cli/render/first_look.h"
#include "cli/render/plan.h"
#include "cli/render/render_still.h"
#include "cli/render/render_with_cycles.h"
#include "ods/camera/layout.h"
#include "ods/files/frames.h"
#include "ods/sequence/shared_frames.h"
#include "ods/stage/exposure.h"

using Frame = ods::SequenceFrame;

namespace {

// All frames of a video, or the one picture, whether or not they exist.
std::vector<Frame> all_frames(const RenderJob& job, const TimeOptions& time, const ods::SequenceOptions& sequence) {
  if (!makes_video(time)) return {{0, double{time.time.value_or(0.0f)}, job.output, job.render.seed}};
  video_names(job.output);  // throws
  return ods::make_frames(sequence, video_frames(time), job.output);
}

// Indices of the frames to render.
std::vector<size_t> choose_frames(const TimeOptions& time, const std::vector<Frame>& all) {
  std::vector<int> numbers;
  for (const Frame& frame : all) numbers.push_back(frame.number);
  const std::vector<int> chosen = own_frames(time.only, numbers);
  std::vector<size_t> frames = ods::choose_frames(all, chosen, time.skip_existing);
  if (makes_video(time)) {
    note_existing_frames(chosen.size() - frames.size(), chosen.size());
  } else if (frames.empty()) {
    note(fmt::format("'{}' exists already", all.front().path));
  }
  return frames;
}

void report_speed(const RenderJob& job, size_t frames, const std::string& file, double samples, double seconds) {
  const double eyes = static_cast<double>(ods::eye_list(job.render.eyes).size());
  const double pixels = 1.0 * job.render.width * job.render.height * eyes * static_cast<double>(frames);
  const std::string what = frames == 1 ? file : fmt::format("{} frames", frames);
  note(fmt::format("{} in {}, {:.0f} samples per pixel, {:.3g} million per second", what, duration_text(seconds),
                   samples / pixels, samples / seconds * 1e-6));
  if (job.render.time_limit > 0.0 && samples / pixels < 8.0)
    warn("few samples fit into --time-limit: expect specks; more time or a smaller --width makes a cleaner picture");
}

// Finds, prints and sets what the scene determines before its first picture: the merge, the exposure, the tone curve.
void set_by_first_look(const RenderJob& job, ods::FrameRenderer& renderer, const std::vector<Frame>& all,
                       bool has_existing) {
  report_viewpoint(job, renderer, all.front());
  const ods::FirstLook look = ods::look_first(renderer, all);
  ods::SequenceOptions options = renderer.options();
  report_look(job, options, look);
  if (has_existing && look.reason == ods::ExposureReason::kLight && is_shown_to_viewers(job))
    note("the existing frames keep theirs, which may differ if they were chosen from other frames: see docs/place.md");
  warn_of_strain(job, renderer, all);
  ods::SaveOptions& save = options.finish.save;
  save.exposure = look.exposure;
  save.tone = job.tone.value_or(ods::usual_tone(renderer.scene()));
  renderer.set_options(std::move(options));
}

// Renders the one picture, unless a process that shares it does. Returns how many were made here.
size_t render_picture(const RenderJob& job, ods::FrameRenderer& renderer, const Frame& frame,
                      const ods::SequenceProgress& progress) {
  size_t made = 0;
  const auto render = [&](size_t) {
    progress.saved(render_still(job, renderer, frame, [&](double done) { progress.report(done, {1, 1, frame.path}); }));
    made++;
  };
  if (job.time.skip_existing) {
    ods::make_shared_frames({{frame.number, frame.path}}, render, progress.waiting);
  } else {
    render(0);
  }
  return made;
}

// A video of a still scene needs a length.
void check_length(const ods::Scene& scene, const TimeOptions& time) {
  const bool is_still = ods::length_of(scene.animation) == 0.0 && !ods::moves(time.move);
  if (!is_still || !time.frames.empty() || time.duration) return;
  throw UsageError(
      "the scene has no animation: add --duration SECONDS, or move the camera with --turntable or --fly-to");
}

// Renders the picture, or the frames, of a scene whose clock is set.
void render_frames(const RenderJob& job, const TimeOptions& time, ods::Scene& scene, ProgressLines& lines) {
  const bool is_video = makes_video(time);
  ods::FrameRenderer renderer(plan(job, time).sequence, scene);
  const std::vector<Frame> all = all_frames(job, time, renderer.options());
  const std::vector<size_t> missing = choose_frames(time, all);
  if (missing.empty()) return;
  if (is_video) note_disk_space(job.output, missing.size(), largest_frame(job.output, job.render, job.save));
  set_by_first_look(job, renderer, all, missing.size() < all.size() && time.only.empty());
  const auto start = std::chrono::steady_clock::now();
  std::string first;
  double samples = 0.0;
  ods::SequenceProgress progress;
  progress.saved = [&](const ods::Rendered& frame) {
    lines.clear();
    first = frame.files.front();
    samples += frame.samples;
    for (const std::string& file : frame.files) announce_file(file);
  };
  progress.report = [&](double done, const ods::FrameAtWork& at) {
    lines.report(done, seconds_since(start), {"render", at.place, is_video ? at.count : 0, at.path});
  };
  progress.waiting = note_waiting(is_video ? "frame" : "part");
  const ods::Sink sink = time.skip_existing ? ods::Sink::kShared : ods::Sink::kFiles;
  const size_t rendered = is_video ? ods::render_sequence(renderer, all, missing, sink, progress)
                                   : render_picture(job, renderer, all.front(), progress);
  if (rendered > 0) report_speed(job, rendered, first, samples, seconds_since(start));
}

}  // namespace

void check_outputs(const RenderJob& job) {
  const std::string path = makes_video(job.time) ? video_names(job.output).path(0) : job.output;
  const std::vector<int> eyes = ods::eye_list(job.render.eyes);
  ods::check_output(path, job.save, eyes, {job.render.width, job.render.height}, &job.camera.stereo.projection);
  note_misleading_name(path, job.save, eyes.size(), job.camera.stereo.projection);
}

void note_existing_frames(size_t existing, size_t chosen) {
  if (existing > 0) note(fmt::format("{} of {} frames exist already", existing, chosen));
}

TimeOptions video_time(const RenderJob& job, ods::Scene& scene) {
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  check_length(scene, time);
  return time;
}

std::vector<int> frames_of(const RenderJob& job) {
  if (job.cycles) return video_frames(cycles_time(job));
  if (!job.time.frames.empty() && job.time.frames != "all") return video_frames(job.time);
  ods::Scene scene = open_lit_scene(job.scene, job.render.transparent);
  return video_frames(video_time(job, scene));
}

void render_job(const RenderJob& given, ProgressLines& lines) {
  check_outputs(given);
  ods::Scene scene = open_lit_scene(given.scene, given.render.transparent);
  const RenderJob job = on_device(given, scene);
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  try {
    render_frames(job, time, scene, lines);
  } catch (const ods::Error& failure) {
    if (!continues_on_cpu(job, failure)) throw;
    render_frames(on_cpu(job, failure), time, scene, lines);
  }
}
