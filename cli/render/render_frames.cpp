// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/frames/disk_room.h"
#include "cli/frames/waiting.h"
#include "cli/options/picture_options.h"
#include "cli/render/first_look.h"
#include "cli/render/forecast.h"
#include "cli/render/library_options.h"
#include "cli/render/render_still.h"
#include "ods/camera/layout.h"
#include "ods/files/frames.h"
#include "ods/sequence/render_video.h"

using Frame = ods::SequenceFrame;

namespace {

// All frames of a video, or the one picture, whether or not they exist.
std::vector<Frame> all_frames(const RenderJob& job, const TimeOptions& time, const ods::SequenceOptions& sequence) {
  if (!asks_for_video(time)) return {{0, static_cast<double>(time.time.value_or(0.0f)), job.output, job.render.seed}};
  video_names(job.output);  // throws
  return ods::make_frames(sequence, video_frames(time), job.output, time.grain == Grain::kChanging);
}

// Indices of those that are to be rendered.
std::vector<size_t> choose_frames(const TimeOptions& time, const std::vector<Frame>& all) {
  std::vector<int> numbers;
  for (const Frame& frame : all) numbers.push_back(frame.number);
  const std::vector<int> chosen = own_frames(time.only, numbers);
  const std::set<int> own(chosen.begin(), chosen.end());
  std::vector<size_t> frames;
  for (size_t i = 0; i < all.size(); i++) {
    if (!own.contains(all[i].number)) continue;
    if (time.skip_existing && ods::is_saved(all[i].path)) {
      ods::remove_dead_claim(all[i].path);
    } else {
      frames.push_back(i);
    }
  }
  const size_t skipped = own.size() - frames.size();
  if (skipped > 0 && asks_for_video(time)) note(fmt::format("{} of {} frames exist already", skipped, own.size()));
  if (skipped > 0 && !asks_for_video(time)) note(fmt::format("'{}' exists already", all.front().path));
  return frames;
}

void check_outputs(const RenderJob& job) {
  const std::string path = asks_for_video(job.time) ? video_names(job.output).path(0) : job.output;
  const std::vector<int> eyes = ods::eye_list(job.render.eyes);
  ods::check_output(path, job.save, eyes, {job.render.width, job.render.height}, &job.camera.stereo.projection);
  note_misleading_name(path, job.save, eyes.size(), job.camera.stereo.projection);
}

void tell_speed(const RenderJob& job, size_t frames, const std::string& file, double samples, double seconds) {
  const double eyes = static_cast<double>(ods::eye_list(job.render.eyes).size());
  const double pixels = 1.0 * job.render.width * job.render.height * eyes * static_cast<double>(frames);
  const std::string what = frames == 1 ? file : fmt::format("{} frames", frames);
  note(fmt::format("{} in {}, {:.0f} samples per pixel, {:.3g} million per second", what, duration_text(seconds),
                   samples / pixels, samples / seconds * 1e-6));
  if (job.render.time_limit > 0.0 && samples / pixels < 8.0)
    warn("few samples fit into --time-limit: expect specks; more time or a smaller --width makes a cleaner picture");
}

std::vector<ods::SharedFrame> files_of(const std::vector<Frame>& frames) {
  std::vector<ods::SharedFrame> files;
  for (const Frame& frame : frames) files.push_back({frame.number, frame.path});
  return files;
}

// report: gets the frames' place in the order of work. The frames must outlive the result.
ods::SequenceProgress progress_of(const std::vector<Frame>& all, const std::vector<size_t>& missing,
                                  const StepReport& report) {
  ods::SequenceProgress progress;
  progress.report = [&all, &missing, report](double done, size_t index) {
    const auto place = std::ranges::find(missing, index) - missing.begin() + 1;
    report(done, {"render", static_cast<int>(place), static_cast<int>(missing.size()), all[index].path});
  };
  progress.waiting = say_waiting("frame");
  return progress;
}

// Renders the one picture; `shared`: unless another process does. Returns how many were made here.
size_t render_picture(const RenderJob& job, ods::FrameRenderer& renderer, const Frame& frame, bool shared,
                      const StepReport& report, const std::function<void(const ods::Rendered&)>& saved) {
  size_t made = 0;
  const auto render = [&](size_t) {
    saved(render_still(job, renderer, frame, [&](double done) { report(done, {"render", 1, 0, frame.path}); }));
    made++;
  };
  if (shared) {
    ods::make_shared_frames(files_of({frame}), render, say_waiting("part"));
  } else {
    render(0);
  }
  return made;
}

void say_room(const RenderJob& job, size_t frames) {
  if (asks_for_video(job.time)) say_disk_room(job.output, frames, largest_frame(job.output, job.render, job.save));
}

// What the scene decides before its first picture: what the renderer reads from then on.
void look_first(RenderJob& job, const TimeOptions& time, ods::Scene& scene, ods::SequenceOptions& sequence,
                ods::FrameRenderer& renderer, const std::vector<Frame>& all) {
  say_where(job, time, scene, all.front());
  settle_merge(job, renderer, all);
  warn_of_strain(job, renderer, all);
  const auto [saved, judged] = choose_exposure(job, scene, renderer, all);
  job.save.exposure = saved;
  if (scene.as_painted && !gives(job, "--tone")) job.save.tone = ods::ToneCurve::kLinear;
  sequence.finish.save = job.save;
  sequence.render.noise_exposure = judged;
}

}  // namespace

void render_job(const RenderJob& wanted, ProgressLines& lines) {
  RenderJob job = wanted;
  check_outputs(job);
  ods::Scene scene = open_lit_scene(job.scene, job.render.transparent);
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  ods::SequenceOptions sequence = sequence_of(job, time);
  const std::vector<Frame> all = all_frames(job, time, sequence);
  const std::vector<size_t> missing = choose_frames(time, all);
  if (missing.empty()) return;
  say_room(job, missing.size());
  ods::FrameRenderer renderer(sequence, scene);
  look_first(job, time, scene, sequence, renderer, all);
  const auto start = std::chrono::steady_clock::now();
  std::string first;
  double samples = 0.0;
  const auto saved = [&](const ods::Rendered& frame) {
    lines.clear();
    first = frame.files.front();
    samples += frame.samples;
    for (const std::string& file : frame.files) announce_file(file);
  };
  const auto report = [&](double done, const ProgressStep& step) { lines.report(done, seconds_since(start), step); };
  size_t rendered = 0;
  if (asks_for_video(time)) {
    ods::SequenceProgress progress = progress_of(all, missing, report);
    progress.saved = saved;
    rendered = render_sequence(renderer, all, missing, time.skip_existing, progress);
  } else {
    rendered = render_picture(job, renderer, all.front(), time.skip_existing, report, saved);
  }
  if (rendered > 0) tell_speed(job, rendered, first, samples, seconds_since(start));
}

// A video of what does not move needs a length.
static void check_length(const ods::Scene& scene, const TimeOptions& time) {
  const bool is_still = ods::length_of(scene.animation) == 0.0 && !ods::moves(time.move);
  if (!is_still || !time.frames.empty() || time.duration) return;
  throw UsageError(
      "the scene has no animation: add --duration SECONDS, or move the camera with --turntable or --fly-to");
}

std::vector<int> frames_of(const RenderJob& job) {
  TimeOptions time = job.time;
  if (!time.frames.empty() && time.frames != "all") return video_frames(time);
  ods::Scene scene = open_lit_scene(job.scene, job.render.transparent);
  start_clock(time, job.camera, scene);
  check_length(scene, time);
  return video_frames(time);
}

RenderedFrames render_frames(const RenderJob& wanted, const StepReport& report,
                             const std::function<void(const std::vector<int>& frames)>& planned) {
  RenderJob job = wanted;
  check_outputs(job);
  ods::Scene scene = open_lit_scene(job.scene, job.render.transparent);
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  check_length(scene, time);
  const std::vector<int> numbers = video_frames(time);
  planned(numbers);
  ods::SequenceOptions sequence = sequence_of(job, time);
  const std::vector<Frame> all = all_frames(job, time, sequence);
  wait_for_frames(files_of(all), "frame", job.wait);
  const std::vector<size_t> missing = choose_frames(time, all);
  ods::FrameRenderer renderer(sequence, scene);
  if (!missing.empty()) say_where(job, time, scene, all.front()), settle_merge(job, renderer, all);
  if (!missing.empty() && time.only.empty()) warn_of_strain(job, renderer, all);
  const float exposure = choose_exposure(job, scene, renderer, all).judged;
  sequence.render.noise_exposure = exposure;
  if (missing.empty()) return {numbers, exposure, scene.as_painted};
  const bool shared = !time.only.empty();
  note(fmt::format("to render: {} frame{}, {}x{} per eye, at most {} samples per pixel", missing.size(),
                   missing.size() == 1 ? "" : "s", job.render.width, job.render.height, job.render.samples));
  if (shared) {
    say_room(job, missing.size());
  } else {
    std::vector<Frame> frames;
    for (const size_t index : missing) frames.push_back(all[index]);
    say_forecast(job, renderer, frames);
  }
  ods::SequenceProgress progress = progress_of(all, missing, report);
  progress.saved = [&](const ods::Rendered& frame) {
    if (shared) std::ranges::for_each(frame.files, announce_file);
  };
  if (job.raw) {
    render_raw_sequence(renderer, all, missing, progress);
  } else {
    render_sequence(renderer, all, missing, shared, progress);
  }
  return {numbers, exposure, scene.as_painted};
}
