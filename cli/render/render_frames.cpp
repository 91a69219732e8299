// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/frames/disk_room.h"
#include "cli/frames/shared_frames.h"
#include "cli/options/picture_options.h"
#include "cli/render/denoised_frames.h"
#include "cli/render/forecast.h"
#include "ods/camera/layout.h"
#include "ods/files/frames.h"
#include "ods/stage/comfortable_merge.h"

using ods::FrameNames;

namespace {

// All frames of a video, or the one picture, whether or not they exist.
std::vector<Frame> all_frames(const RenderJob& job, const TimeOptions& time) {
  if (!asks_for_video(time)) return {{0, static_cast<double>(time.time.value_or(0.0f)), job.output, job.render.seed}};
  const FrameNames names = video_names(job.output);
  std::vector<Frame> frames;
  for (const int number : video_frames(time)) frames.push_back(make_frame(job.render.seed, time, names, number));
  return frames;
}

// Those that are to be rendered.
std::vector<Frame> choose_frames(const TimeOptions& time, const std::vector<Frame>& all) {
  std::vector<int> numbers;
  for (const Frame& frame : all) numbers.push_back(frame.number);
  const std::vector<int> chosen = own_frames(time.only, numbers);
  const std::set<int> own(chosen.begin(), chosen.end());
  std::vector<Frame> frames;
  for (const Frame& frame : all) {
    if (!own.contains(frame.number)) continue;
    if (time.skip_existing && ods::is_saved(frame.path)) {
      remove_dead_claim(frame.path);
    } else {
      frames.push_back(frame);
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

using Saved = std::function<void(const Rendered& frame)>;

std::vector<SharedFrame> files_of(const std::vector<Frame>& frames) {
  std::vector<SharedFrame> files;
  for (const Frame& frame : frames) files.push_back({frame.number, frame.path});
  return files;
}

// Renders and saves the frames; `shared`: except those claimed by other processes. Returns how many it rendered.
size_t render_all(FrameRenderer& renderer, const TimeOptions& time, const std::vector<Frame>& frames, bool shared,
                  const StepReport& report, const Saved& saved) {
  size_t rendered = 0;
  const auto render = [&](size_t i) {
    const int number = static_cast<int>(i) + 1, count = static_cast<int>(frames.size());
    const ProgressStep step{"render", number, asks_for_video(time) ? count : 0, frames[i].path};
    saved(renderer.render(frames[i], [&](double done) { report((static_cast<double>(i) + done) / count, step); }));
    rendered++;
  };
  if (!shared) {
    for (size_t i = 0; i < frames.size(); i++) render(i);
    return rendered;
  }
  make_shared_frames(files_of(frames), asks_for_video(time) ? "frame" : "part", render);
  return rendered;
}

// Renders and saves those of a video's frames that are missing, each denoised together with those beside it; `shared`:
// as in render_all().
void render_denoised(const RenderJob& job, FrameRenderer& renderer, const std::vector<Frame>& all,
                     const std::vector<Frame>& missing, bool shared, const StepReport& report, const Saved& saved) {
  std::map<int, size_t> places;  // in `all`, of the missing ones
  for (const Frame& frame : missing) places[frame.number] = 0;
  std::set<size_t> wanted;
  for (size_t i = 0; i < all.size(); i++) {
    const auto found = places.find(all[i].number);
    if (found == places.end()) continue;
    found->second = i;
    wanted.insert(i);
  }
  DenoisedFrames frames(job, renderer, all, wanted);
  int made = 0;
  const auto make = [&](size_t index) {
    const ProgressStep step{"render", ++made, static_cast<int>(wanted.size()), all[index].path};
    saved(frames.make(index, [&](double done) { report(done, step); }));
  };
  if (shared) {
    make_shared_frames(files_of(missing), "frame", [&](size_t i) { make(places.at(missing[i].number)); });
  } else {
    for (const size_t index : wanted) make(index);
  }
}

// Leaves the frames as rendered to whoever denoises them.
void render_raw(FrameRenderer& renderer, const std::vector<Frame>& frames, const StepReport& report) {
  std::vector<SharedFrame> files;
  for (const Frame& frame : frames) files.push_back({frame.number, raw_path(frame)});
  const int count = static_cast<int>(frames.size());
  make_shared_frames(files, "frame", [&](size_t i) {
    const ProgressStep step{"render", static_cast<int>(i) + 1, count, files[i].path};
    renderer.keep_raw(frames[i], [&](double done) { report((static_cast<double>(i) + done) / count, step); });
    announce_file(files[i].path);
  });
}

// --merge auto: the merge that the scene's depth allows. The renderer reads the job.
void settle_merge(RenderJob& job, FrameRenderer& renderer, const std::vector<Frame>& all) {
  if (job.camera.merge_limit) ods::use_merge_map(job.camera.stereo, renderer.find_merge(all));
}

void say_room(const RenderJob& job, const std::vector<Frame>& frames) {
  if (!asks_for_video(job.time) || frames.empty()) return;
  say_disk_room(job.output, frames.size(), largest_frame(job.output, job.render, job.save));
}

}  // namespace

void render_job(const RenderJob& wanted, ProgressLines& lines) {
  RenderJob job = wanted;
  check_outputs(job);
  ods::Scene scene = open_lit_scene(job.scene, job.render.transparent);
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  const std::vector<Frame> all = all_frames(job, time), frames = choose_frames(time, all);
  if (frames.empty()) return;
  say_room(job, frames);
  FrameRenderer renderer(job, time, scene, all.front());
  settle_merge(job, renderer, all);
  renderer.warn_of_strain(all);
  job.save.exposure = renderer.find_exposure(all);
  if (scene.as_painted && !gives(job, "--tone")) job.save.tone = ods::ToneCurve::kLinear;
  const auto start = std::chrono::steady_clock::now();
  std::string first;
  double samples = 0.0;
  const auto saved = [&](const Rendered& frame) {
    lines.clear();
    first = frame.files.front();
    samples += frame.samples;
    for (const std::string& file : frame.files) announce_file(file);
  };
  const bool shared = time.skip_existing;
  const auto report = [&](double done, const ProgressStep& step) { lines.report(done, seconds_since(start), step); };
  const size_t rendered = render_all(renderer, time, frames, shared, report, saved);
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
  const std::vector<Frame> all = all_frames(job, time);
  wait_for_frames(files_of(all), "frame", job.wait);
  const std::vector<Frame> frames = choose_frames(time, all);
  const bool shared = !time.only.empty();
  FrameRenderer renderer(job, time, scene, all.front());
  if (!frames.empty()) settle_merge(job, renderer, all);
  if (!frames.empty() && !shared) renderer.warn_of_strain(all);
  const float exposure = renderer.find_exposure(all);
  if (!frames.empty()) {
    note(fmt::format("to render: {} frame{}, {}x{} per eye, at most {} samples per pixel", frames.size(),
                     frames.size() == 1 ? "" : "s", job.render.width, job.render.height, job.render.samples));
    shared ? say_room(job, frames) : say_forecast(job, renderer, frames);
    if (job.raw) return render_raw(renderer, frames, report), RenderedFrames{numbers, exposure};
    const auto saved = [&](const Rendered& frame) {
      if (shared) std::ranges::for_each(frame.files, announce_file);
    };
    if (draws_on_neighbours(job)) {
      render_denoised(job, renderer, all, frames, shared, report, saved);
    } else {
      render_all(renderer, time, frames, shared, report, saved);
    }
  }
  return {numbers, exposure, scene.as_painted};
}
