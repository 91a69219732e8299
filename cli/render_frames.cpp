// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render_frames.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iostream>

#include "cli/console.h"
#include "cli/long_job.h"
#include "ods/base/frames.h"
#include "ods/cpu/render.h"
#include "ods/image/layout.h"
#include "ods/kernel/random.h"

using ods::FrameNames;

namespace {

struct Frame {
  double time;  // seconds
  std::string path;
  uint32_t seed;
};

Frame make_frame(const RenderJob& job, const FrameNames& names, int number) {
  const auto bits = static_cast<ods::uint>(number);
  const bool changing = job.time.noise == FilmNoise::kChanging;
  return {number / static_cast<double>(job.time.fps), names.path(number),
          changing ? ods::hash_pair(job.render.seed, bits) : job.render.seed};
}

// Whether all files of a frame are there; some farms make empty ones beforehand.
bool exists(const std::string& path) {
  std::error_code error;
  for (const int eye : {ods::kLeft, ods::kRight}) {
    const auto size = std::filesystem::file_size(ods::path_for_eye(path, eye), error);
    if (error || size == 0) return false;
  }
  return true;
}

FrameNames name_frames(const RenderJob& job) {
  if (const auto names = ods::frame_names(job.output)) return *names;
  throw UsageError("a film needs a place for the number of the frame in its files' names: -o shot.####.png");
}

std::vector<Frame> choose_frames(const RenderJob& job, const TimeOptions& time) {
  if (!asks_for_film(time)) return {{static_cast<double>(time.time.value_or(0.0f)), job.output, job.render.seed}};
  const FrameNames names = name_frames(job);
  std::vector<Frame> frames;
  size_t skipped = 0;
  for (const int number : film_frames(time)) {
    Frame frame = make_frame(job, names, number);
    time.skip_existing&& exists(frame.path) ? skipped++ : (frames.push_back(std::move(frame)), 0);
  }
  if (skipped > 0) note(fmt::format("{} of {} frames are there already", skipped, skipped + frames.size()));
  return frames;
}

void check_outputs(const RenderJob& job) {
  const bool film = asks_for_film(job.time);
  ods::check_output(film ? name_frames(job).path(0) : job.output, job.save, ods::eye_list(job.render.eyes),
                    {job.render.width, job.render.height});
}

void tell_speed(const RenderJob& job, const std::vector<Frame>& frames, const std::string& file, double seconds) {
  double samples = 1.0 * job.render.width * job.render.height * job.render.samples;
  samples *= static_cast<double>(ods::eye_list(job.render.eyes).size() * frames.size());
  const std::string what = frames.size() == 1 ? file : fmt::format("{} frames", frames.size());
  note(fmt::format("{} in {}, {:.3g} Msamples/s", what, duration_text(seconds), samples / seconds * 1e-6));
}

using Report = std::function<void(double done)>;
using Saved = std::function<void(const std::vector<std::string>& files)>;

// Renders the frames and saves each.
void render_all(const RenderJob& job, ods::Scene& scene, const TimeOptions& time, const std::vector<Frame>& frames,
                const Report& report, const Saved& saved) {
  ods::set_time(scene, frames.front().time);
  place_camera(job.camera, scene);
  ods::CpuRenderer renderer(scene, job.render.threads);
  for (size_t i = 0; i < frames.size(); i++) {
    const Frame& frame = frames[i];
    if (i > 0) renderer.update(ods::set_time(scene, frame.time));
    const ods::CameraRig rig = ods::moved(place_camera_again(job.camera, scene), time.move, frame.time);
    ods::RenderOptions options = job.render;
    options.seed = frame.seed;
    ods::Progress progress;
    progress.report = [&](double done) {
      report((static_cast<double>(i) + done) / static_cast<double>(frames.size()));
    };
    const ods::Picture picture = renderer.render(rig, options, progress);
    saved(ods::save_picture(picture, rig, job.save, frame.path));
  }
}

ods::Scene open_lit_scene(const RenderJob& job) {
  check_outputs(job);
  ods::Scene scene = open_scene(job.scene);
  add_environment(scene, job.scene);
  return scene;
}

}  // namespace

void render_job(const RenderJob& job, ProgressLines& lines) {
  ods::Scene scene = open_lit_scene(job);
  TimeOptions time = job.time;
  start_clock(time, scene);
  const std::vector<Frame> frames = choose_frames(job, time);
  if (frames.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  std::string first;
  const auto saved = [&](const std::vector<std::string>& files) {
    lines.clear();
    first = files.front();
    for (const std::string& file : files) std::cout << file << std::endl;
  };
  render_all(
      job, scene, time, frames, [&](double done) { lines.report(done, seconds_since(start)); }, saved);
  tell_speed(job, frames, first, seconds_since(start));
}

std::vector<int> render_frames(const RenderJob& job, const std::function<void(double done)>& report) {
  ods::Scene scene = open_lit_scene(job);
  TimeOptions time = job.time;
  start_clock(time, scene);
  const bool is_still = ods::length_of(scene.animation) == 0.0 && !ods::moves(time.move);
  if (is_still && time.frames.empty() && !time.duration) {
    throw UsageError(
        "nothing moves in it: --duration says how long the film is; --turntable or --fly-to move the camera");
  }
  const std::vector<Frame> frames = choose_frames(job, time);
  if (!frames.empty()) render_all(job, scene, time, frames, report, [](const std::vector<std::string>&) {});
  return film_frames(time);
}
