// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/frame_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ods/base/error.h"
#include "ods/render/devices/devices.h"
#include "ods/render/render_target.h"
#include "ods/render/unfinished.h"
#include "ods/scene/shutter.h"

namespace ods {
namespace {

// Sets the scene to the frame's time, and moves the camera during the shutter.
std::vector<StereoCamera> open_camera(const SequenceOptions& options, Scene& scene, double time, SceneChange& change) {
  const double open = options.shutter / 360.0 / options.fps;
  if (open == 0.0) {
    change = set_time(scene, time);
    return {camera_at(options.camera, scene, time)};
  }
  std::vector<StereoCamera> cameras;
  for (int key = 0; key < kShutterKeys; key++) {
    const double seconds = time + open * (static_cast<double>(key) / (kShutterKeys - 1) - 0.5);
    if (!scene.animation.views.empty()) set_time(scene, seconds);
    cameras.push_back(camera_at(options.camera, scene, seconds));
  }
  const auto same = [&](const StereoCamera& a) {
    const StereoCamera& b = cameras.front();
    return a.position == b.position && a.yaw == b.yaw && a.pitch == b.pitch && a.roll == b.roll;
  };
  if (std::ranges::all_of(cameras, same)) cameras.resize(1);
  change = open_shutter(scene, time - 0.5 * open, time + 0.5 * open);
  return cameras;
}

}  // namespace

bool FrameRenderer::draws_on_neighbours() const {
  return options_.draws_on_neighbours && options_.finish.denoiser == Denoiser::kOwn;
}

Shot FrameRenderer::set(const SequenceFrame& frame) {
  SceneChange change;
  Shot shot{open_camera(options_, scene_, frame.time, change), {}};
  add_change(change_, change);
  if (renderer_) {
    renderer_->update(change_);
  } else {
    renderer_ = make_renderer(scene_, options_.render);
  }
  change_ = {};
  shot.options = with_height(options_to_finish(options_.render, options_.finish.denoiser), shot.camera());
  shot.options.seed = frame.seed;
  return shot;
}

Rendered FrameRenderer::render(const SequenceFrame& frame, const Report& report) {
  const double share = options_.finish.denoiser == Denoiser::kNone ? 1.0 : kShareOfRendering;
  Progress progress;
  progress.report = [&](double done) {
    if (report) report(share * done);
  };
  const Shot shot = set(frame);
  Picture picture = renderer_->render(shot.cameras, shot.options, progress);
  const double samples = picture.samples_taken;
  return {finish_picture(options_.finish, options_.render, shot.camera(), std::move(picture), frame.path), samples};
}

Rendered FrameRenderer::keep_raw(const SequenceFrame& frame, const Report& report) {
  const Shot shot = set(frame);
  check_picture_memory(shot.options);
  PictureSamples samples = no_samples(shot.options);
  Progress progress;
  progress.report = report;
  renderer_->sample(shot.cameras, shot.options, samples, progress);
  write_unfinished(raw_path(frame), {{}, {}, shot.options.noise_exposure, {}, shot.options}, samples);
  return {{raw_path(frame)}, static_cast<double>(count_samples(samples))};
}

// The picture that keep_raw() has written; nullopt if there is no usable one.
std::optional<Picture> FrameRenderer::read_raw(const std::string& path, const RenderOptions& options) const {
  if (!is_saved(path)) return std::nullopt;
  std::string fault = fmt::format("'{}' belongs to another picture", path);
  try {
    PictureSamples samples;
    read_unfinished(path, samples);
    if (fit(samples, options)) return develop(std::move(samples), options);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    fault = error.what();
  }
  if (options_.warn) options_.warn(fault + ": the frame is rendered again");
  return std::nullopt;
}

RawFrame FrameRenderer::render_raw(const SequenceFrame& frame, const Report& report) {
  const Shot shot = set(frame);
  Progress progress;
  progress.report = report;
  std::optional<Picture> kept = read_raw(raw_path(frame), shot.options);
  RawFrame raw{
      frame.time, shot.camera(), kept ? std::move(*kept) : renderer_->render(shot.cameras, shot.options, progress), {}};
  if (!scene_.animation.playing.empty()) raw.hits = renderer_->center_hits(raw.camera, shot.options);
  return raw;
}

std::vector<std::vector<vec3>> FrameRenderer::places(const RawFrame& frame, double seconds) {
  std::vector<std::vector<vec3>> places;
  if (frame.hits.empty()) return places;
  add_change(change_, set_time(scene_, seconds));
  for (const std::vector<Hit>& hits : frame.hits) {
    std::vector<vec3>& eye = places.emplace_back();
    for (const Hit& hit : hits) eye.push_back(hit.t < 0.0f ? vec3(0.0f) : point_of(scene_, hit));
  }
  return places;
}

}  // namespace ods
