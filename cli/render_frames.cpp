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

}  // namespace

void render_job(const RenderJob& job, ProgressLines& lines) {
  check_outputs(job);
  ods::Scene scene = open_scene(job.scene);
  add_environment(scene, job.scene);
  TimeOptions time = job.time;
  start_clock(time, scene);
  const std::vector<Frame> frames = choose_frames(job, time);
  if (frames.empty()) return;
  ods::set_time(scene, frames.front().time);
  place_camera(job.camera, scene);

  const auto start = std::chrono::steady_clock::now();
  ods::CpuRenderer renderer(scene, job.render.threads);
  std::vector<std::string> files;
  for (size_t i = 0; i < frames.size(); i++) {
    const Frame& frame = frames[i];
    if (i > 0) renderer.update(ods::set_time(scene, frame.time));
    const ods::CameraRig rig = ods::moved(place_camera_again(job.camera, scene), time.move, frame.time);
    ods::RenderOptions options = job.render;
    options.seed = frame.seed;
    ods::Progress progress;
    progress.report = [&](double done) {
      lines.report((static_cast<double>(i) + done) / static_cast<double>(frames.size()), seconds_since(start));
    };
    const ods::Picture picture = renderer.render(rig, options, progress);
    lines.clear();
    files = ods::save_picture(picture, rig, job.save, frame.path);
    for (const std::string& file : files) std::cout << file << std::endl;
  }
  tell_speed(job, frames, files.front(), seconds_since(start));
}
