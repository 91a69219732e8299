// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/frames/disk_room.h"
#include "cli/frames/shared_frames.h"
#include "cli/options/picture_options.h"
#include "cli/render/finish_picture.h"
#include "cli/render/render_still.h"
#include "ods/camera/layout.h"
#include "ods/files/frames.h"
#include "ods/kernel/random.h"
#include "ods/render/cpu/render.h"
#include "ods/render/render_target.h"
#include "ods/scene/shutter.h"

using ods::FrameNames;

namespace {

struct Frame {
  int number;
  double time;  // seconds
  std::string path;
  uint32_t seed;
};

Frame make_frame(const RenderJob& job, const FrameNames& names, int number) {
  const auto bits = static_cast<ods::uint>(number);
  const bool changing = job.time.grain == Grain::kChanging;
  return {number, number / static_cast<double>(job.time.fps), names.path(number),
          changing ? ods::hash_pair(job.render.seed, bits) : job.render.seed};
}

std::vector<Frame> choose_frames(const RenderJob& job, const TimeOptions& time) {
  if (!asks_for_video(time)) return {{0, static_cast<double>(time.time.value_or(0.0f)), job.output, job.render.seed}};
  const FrameNames names = video_names(job.output);
  std::vector<Frame> frames;
  size_t skipped = 0;
  for (const int number : video_frames(time)) {
    Frame frame = make_frame(job, names, number);
    if (time.skip_existing && ods::is_saved(frame.path)) {
      remove_dead_claim(frame.path);
      skipped++;
    } else {
      frames.push_back(std::move(frame));
    }
  }
  if (skipped > 0) note(fmt::format("{} of {} frames exist already", skipped, skipped + frames.size()));
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

// The scene at a frame's time, and the camera's motion during the shutter.
struct Shot {
  ods::SceneChange change;
  std::vector<ods::StereoCamera> cameras;
};

Shot make_shot(const RenderJob& job, const TimeOptions& time, ods::Scene& scene, const Frame& frame) {
  Shot shot;
  const auto camera_at = [&](double seconds) {
    return ods::moved(place_camera_again(job.camera, scene), time.move, seconds);
  };
  const double open = static_cast<double>(time.shutter) / 360.0 / static_cast<double>(time.fps);
  if (open == 0.0 || !(asks_for_video(time) || time.time)) {
    shot.change = ods::set_time(scene, frame.time);
    shot.cameras = {camera_at(frame.time)};
    return shot;
  }
  for (int key = 0; key < ods::kShutterKeys; key++) {
    const double seconds = frame.time + open * (static_cast<double>(key) / (ods::kShutterKeys - 1) - 0.5);
    if (!scene.animation.views.empty()) ods::set_time(scene, seconds);
    shot.cameras.push_back(camera_at(seconds));
  }
  const auto same = [&](const ods::StereoCamera& a) {
    const ods::StereoCamera& b = shot.cameras.front();
    return a.position == b.position && a.yaw == b.yaw && a.pitch == b.pitch && a.roll == b.roll;
  };
  if (std::all_of(shot.cameras.begin(), shot.cameras.end(), same)) shot.cameras.resize(1);
  shot.change = ods::open_shutter(scene, frame.time - 0.5 * open, frame.time + 0.5 * open);
  return shot;
}

using Saved = std::function<void(const Rendered& frame)>;

constexpr double kShareOfRendering = 0.97;  // of the time; denoising takes the rest

// Renders frames one after the other. Acceleration structures of static meshes are kept between frames.
class FrameRenderer {
 public:
  FrameRenderer(const RenderJob& job, const TimeOptions& time, ods::Scene& scene)
      : job_(job), time_(time), scene_(scene) {}

  Rendered render(const Frame& frame, const std::function<void(double done)>& report) {
    const Shot shot = make_shot(job_, time_, scene_, frame);
    if (renderer_) {
      renderer_->update(shot.change);
    } else {
      place_camera(job_.camera, scene_);  // prints a note with the position
      renderer_.emplace(scene_, job_.render.threads);
    }
    const ods::StereoCamera& camera = shot.cameras[shot.cameras.size() / 2];
    ods::RenderOptions options = ods::with_height(options_to_finish(job_), camera);
    options.seed = frame.seed;
    ods::Progress progress;
    const double share = denoiser_of(job_) == ods::Denoiser::kNone ? 1.0 : kShareOfRendering;
    if (report) progress.report = [&, share](double done) { report(share * done); };
    if (!asks_for_video(time_)) return render_still(job_, *renderer_, shot.cameras, options, progress);
    ods::Picture picture = renderer_->render(shot.cameras, options, progress);
    const double samples = picture.samples_taken;
    return {finish_picture(job_, camera, std::move(picture), frame.path), samples};
  }

 private:
  const RenderJob& job_;
  const TimeOptions& time_;
  ods::Scene& scene_;
  std::optional<ods::CpuRenderer> renderer_;
};

// Renders and saves the frames; `shared`: except those claimed by other processes. Returns how many it rendered.
size_t render_all(const RenderJob& job, ods::Scene& scene, const TimeOptions& time, const std::vector<Frame>& frames,
                  bool shared, const StepReport& report, const Saved& saved) {
  FrameRenderer renderer(job, time, scene);
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
  std::vector<SharedFrame> files;
  for (const Frame& frame : frames) files.push_back({frame.number, frame.path});
  make_shared_frames(files, "frame", render);
  return rendered;
}

void say_room(const RenderJob& job, const std::vector<Frame>& frames) {
  if (!asks_for_video(job.time) || frames.empty()) return;
  say_disk_room(job.output, frames.size(), largest_frame(job.output, job.render, job.save));
}

}  // namespace

void render_job(const RenderJob& job, ProgressLines& lines) {
  check_outputs(job);
  ods::Scene scene = open_lit_scene(job.scene);
  TimeOptions time = job.time;
  start_clock(time, scene);
  const std::vector<Frame> frames = choose_frames(job, time);
  if (frames.empty()) return;
  say_room(job, frames);
  const auto start = std::chrono::steady_clock::now();
  std::string first;
  double samples = 0.0;
  const auto saved = [&](const Rendered& frame) {
    lines.clear();
    first = frame.files.front();
    samples += frame.samples;
    for (const std::string& file : frame.files) announce_file(file);
  };
  const bool shared = asks_for_video(time) && time.skip_existing;
  const auto report = [&](double done, const ProgressStep& step) { lines.report(done, seconds_since(start), step); };
  const size_t rendered = render_all(job, scene, time, frames, shared, report, saved);
  if (rendered > 0) tell_speed(job, rendered, first, samples, seconds_since(start));
}

std::vector<int> render_frames(const RenderJob& job, const StepReport& report,
                               const std::function<void(const std::vector<int>& frames)>& planned) {
  check_outputs(job);
  ods::Scene scene = open_lit_scene(job.scene);
  TimeOptions time = job.time;
  start_clock(time, scene);
  const bool is_still = ods::length_of(scene.animation) == 0.0 && !ods::moves(time.move);
  if (is_still && time.frames.empty() && !time.duration) {
    throw UsageError(
        "the scene has no animation: add --duration SECONDS, or move the camera with --turntable or --fly-to");
  }
  const std::vector<int> numbers = video_frames(time);
  planned(numbers);
  const std::vector<Frame> frames = choose_frames(job, time);
  if (!frames.empty()) {
    note(fmt::format("to render: {} frame{}, {}x{} per eye, at most {} samples per pixel", frames.size(),
                     frames.size() == 1 ? "" : "s", job.render.width, job.render.height, job.render.samples));
    say_room(job, frames);
    render_all(job, scene, time, frames, false, report, [](const Rendered&) {});
  }
  return numbers;
}
