// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cli/console/console.h"
#include "cli/options/camera_options.h"
#include "cli/options/picture_options.h"
#include "cli/render/finish_picture.h"
#include "ods/kernel/random.h"
#include "ods/render/render_target.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/sheet_glass.h"
#include "ods/scene/shutter.h"
#include "ods/stage/exposure.h"
#include "ods/stage/place.h"

namespace {

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

// Warns about a camera that the user or the file has placed where there is nothing to see. Where it stands by our own
// choice it is in free space.
void check_view(const RenderJob& job, const ods::Scene& scene, ods::vec3 eye) {
  const bool own_choice = !job.camera.position &&
                          ods::camera_choice(job.camera.view_point) != ods::CameraChoice::kNamed &&
                          !uses_own_camera(scene);
  const bool made_for_it = !job.camera.position && ods::find_builtin(job.scene.name);
  if (own_choice || made_for_it) return;
  const std::string fault = ods::view_fault(ods::SceneRays(scene), eye);
  if (fault.empty()) return;
  std::string cure = "--position X,Y,Z moves it";
  if (job.camera.position && scene.viewing) {
    const ods::vec3 better = scene.viewing->view.position;
    cure = fmt::format("without --position it would be at {:.4g},{:.4g},{:.4g}", better.x, better.y, better.z);
  } else if (scene.viewing) {
    const ods::vec3 better = scene.viewing->view.position;
    cure = fmt::format("--position {:.4g},{:.4g},{:.4g} is in free space", better.x, better.y, better.z);
  }
  warn(fmt::format("the camera {}; {}, or the scene has another unit (--unit cm)", fault, cure));
}

// Says once what --caustics straight simplifies.
void note_straight_light(const RenderJob& job, const ods::Scene& scene) {
  if (job.render.caustics != ods::Caustics::kStraight) return;
  const std::vector<std::string> solids = ods::smooth_solids(scene);
  if (solids.empty()) return;
  const std::string others = solids.size() == 1 ? "" : fmt::format(" and {} more", solids.size() - 1);
  note(fmt::format("light passes solid glass ('{}'{}) unbent; --caustics path refracts it", solids.front(), others));
}

constexpr size_t kLooks = 5;  // at a video, spread evenly

bool is_looked_at(const RenderJob& job) {
  return job.time.is_video || job.part || !keeps_light(job.output);
}

bool is_made_for_it(const RenderJob& job) {
  const auto& [environment, lamp, background, unlit, lamp_unit] = job.scene.light;
  return ods::find_builtin(job.scene.name) && environment.empty() && lamp.empty() && background.empty() && !unlit;
}

constexpr double kShareOfRendering = 0.97;  // of the time; denoising takes the rest

}  // namespace

Frame make_frame(const RenderJob& job, const ods::FrameNames& names, int number) {
  const auto bits = static_cast<ods::uint>(number);
  const bool changing = grain_of(job.time) == Grain::kChanging;
  return {number, number / static_cast<double>(job.time.fps), names.path(number),
          changing ? ods::hash_pair(job.render.seed, bits) : job.render.seed};
}

FrameRenderer::FrameRenderer(const RenderJob& job, const TimeOptions& time, ods::Scene& scene)
    : job_(job), time_(time), scene_(scene) {}

// Returns the cameras during the shutter.
std::vector<ods::StereoCamera> FrameRenderer::set_time(const Frame& frame) {
  Shot shot = make_shot(job_, time_, scene_, frame);
  add_change(change_, shot.change);
  if (renderer_) {
    renderer_->update(change_);
  } else {
    place_camera(job_.camera, scene_);  // prints a note with the position
    check_view(job_, scene_, shot.cameras.front().position);
    note_straight_light(job_, scene_);
    renderer_.emplace(scene_, job_.render.threads);
  }
  change_ = {};
  return std::move(shot.cameras);
}

ods::RenderOptions FrameRenderer::options_for(const Frame& frame, const ods::StereoCamera& camera) const {
  ods::RenderOptions options = ods::with_height(options_to_finish(job_), camera);
  options.seed = frame.seed;
  options.noise_exposure = exposure_;
  return options;
}

Rendered FrameRenderer::render(const Frame& frame, const std::function<void(double done)>& report) {
  const double share = denoiser_of(job_) == ods::Denoiser::kNone ? 1.0 : kShareOfRendering;
  const auto part = [&](double done) {
    if (report) report(share * done);
  };
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  const ods::StereoCamera& camera = cameras[cameras.size() / 2];
  const ods::RenderOptions options = options_for(frame, camera);
  ods::Progress progress;
  progress.report = part;
  if (!asks_for_video(time_)) return render_still(job_, *renderer_, cameras, options, progress);
  ods::Picture picture = renderer_->render(cameras, options, progress);
  const double samples = picture.samples_taken;
  return {finish_picture(job_, camera, std::move(picture), frame.path), samples};
}

ods::Picture FrameRenderer::first_look(const Frame& frame) {
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  return renderer_->render(ods::first_look_camera(cameras[cameras.size() / 2]), ods::first_look(job_.render));
}

float FrameRenderer::find_exposure(const std::vector<Frame>& frames) {
  if (job_.exposure || !is_looked_at(job_) || is_made_for_it(job_) || frames.empty()) {
    return exposure_ = job_.exposure.value_or(0.0f);
  }
  if (scene_.as_painted) {
    note("exposure 0 and no tone curve, since the colours are shown as they are painted (--exposure, --tone)");
    return exposure_ = 0.0f;
  }
  std::set<size_t> chosen;
  for (size_t i = 0; i < kLooks; i++) chosen.insert((2 * i + 1) * frames.size() / (2 * kLooks));
  std::vector<ods::Picture> looks;
  for (const size_t i : chosen) looks.push_back(first_look(frames[i]));
  const std::optional<float> stops = ods::suitable_exposure(looks);
  if (!stops) {
    warn("there is nothing to see: no light reaches the camera (--env 1 lights the scene, --position X,Y,Z moves it)");
    return 0.0f;
  }
  note(fmt::format("exposure {:+.1f} stops, from a first look at the light (--exposure {:.1f})", *stops, *stops));
  return exposure_ = *stops;
}

RawFrame FrameRenderer::render_raw(const Frame& frame, const std::function<void(double done)>& report) {
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  const ods::StereoCamera& camera = cameras[cameras.size() / 2];
  const ods::RenderOptions options = options_for(frame, camera);
  ods::Progress progress;
  progress.report = report;
  RawFrame raw{frame.time, camera, renderer_->render(cameras, options, progress), {}};
  if (!scene_.animation.playing.empty()) raw.hits = renderer_->center_hits(camera, options);
  return raw;
}

std::vector<std::vector<ods::vec3>> FrameRenderer::places(const RawFrame& frame, double seconds) {
  std::vector<std::vector<ods::vec3>> places;
  if (frame.hits.empty()) return places;
  add_change(change_, ods::set_time(scene_, seconds));
  for (const std::vector<ods::Hit>& hits : frame.hits) {
    std::vector<ods::vec3>& eye = places.emplace_back();
    for (const ods::Hit& hit : hits) eye.push_back(hit.t < 0.0f ? ods::vec3(0.0f) : ods::point_of(scene_, hit));
  }
  return places;
}
