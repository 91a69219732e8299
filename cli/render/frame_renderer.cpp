// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "cli/comfort/first_look.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/camera_options.h"
#include "cli/options/picture_options.h"
#include "cli/render/finish_picture.h"
#include "ods/kernel/random.h"
#include "ods/render/light_cache.h"
#include "ods/render/render_target.h"
#include "ods/render/unfinished.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/sheet_glass.h"
#include "ods/scene/shutter.h"
#include "ods/stage/comfortable_merge.h"
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
constexpr size_t kMergeLooks = 16;
constexpr double kLongSamples = 2e7;  // in all pixels: rendering takes more than a few seconds

// Indices of so many frames, spread evenly; of fewer if there are fewer.
std::set<size_t> looks_at(const std::vector<Frame>& frames, size_t count) {
  std::set<size_t> chosen;
  for (size_t i = 0; i < count; i++) chosen.insert((2 * i + 1) * frames.size() / (2 * count));
  return chosen;
}

bool is_looked_at(const RenderJob& job) {
  return job.time.is_video || job.part || !keeps_light(job.output);
}

bool is_made_for_it(const RenderJob& job) {
  const auto& [environment, lamp, background, unlit, lamp_unit] = job.scene.light;
  return ods::find_builtin(job.scene.name) && environment.empty() && lamp.empty() && background.empty() && !unlit;
}

constexpr double kShareOfRendering = 0.97;  // of the time; denoising takes the rest

}  // namespace

Frame make_frame(uint32_t seed, const TimeOptions& time, const ods::FrameNames& names, int number) {
  const auto bits = static_cast<ods::uint>(number);
  const bool changing = time.grain == Grain::kChanging;
  return {number, number / static_cast<double>(time.fps), names.path(number),
          changing ? ods::hash_pair(seed, bits) : seed};
}

FrameRenderer::FrameRenderer(const RenderJob& job, const TimeOptions& time, ods::Scene& scene, Frame first)
    : job_(job), time_(time), scene_(scene), first_(std::move(first)) {}

void FrameRenderer::say_where() const {
  ods::set_time(scene_, first_.time);
  const ods::StereoCamera camera = ods::moved(place_camera_again(job_.camera, scene_), time_.move, first_.time);
  note_camera(job_.camera, scene_, camera);
  check_view(job_, scene_, camera.position);
  note_straight_light(job_, scene_);
}

// Returns the cameras during the shutter.
std::vector<ods::StereoCamera> FrameRenderer::set_time(const Frame& frame) {
  if (!renderer_) say_where();
  Shot shot = make_shot(job_, time_, scene_, frame);
  add_change(change_, shot.change);
  if (renderer_) {
    renderer_->update(change_);
  } else {
    renderer_.emplace(scene_, job_.render.threads);
  }
  change_ = {};
  return std::move(shot.cameras);
}

ods::RenderOptions FrameRenderer::options_for(const Frame& frame, const ods::StereoCamera& camera) const {
  ods::RenderOptions options = ods::with_height(options_to_finish(job_), camera);
  options.seed = frame.seed;
  options.noise_exposure = noise_exposure_;
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
  if (!asks_for_video(time_)) return render_still(job_, *renderer_, scene_, cameras, options, progress);
  ods::Picture picture = renderer_->render(cameras, options, progress);
  const double samples = picture.samples_taken;
  return {finish_picture(job_, camera, std::move(picture), frame.path), samples};
}

ods::Picture FrameRenderer::first_look(const Frame& frame) {
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  return renderer_->render(ods::first_look_camera(cameras[cameras.size() / 2]), ods::first_look(job_.render));
}

float FrameRenderer::find_exposure(const std::vector<Frame>& frames) {
  const float exposure = choose_exposure(frames);
  noise_exposure_ = exposure;
  return exposure_ = is_looked_at(job_) || job_.exposure ? exposure : job_.brighter;
}

// Also for a scene-linear file whose noise is judged: somebody will look at it, too.
float FrameRenderer::choose_exposure(const std::vector<Frame>& frames) {
  const bool shown = is_looked_at(job_);
  if (job_.exposure || !(shown || job_.render.noise > 0.0f) || is_made_for_it(job_) || frames.empty()) {
    return job_.exposure.value_or(job_.brighter);
  }
  if (scene_.as_painted) {
    if (shown)
      note("exposure 0 and no tone curve, since the colours are shown as they are painted (--exposure, --tone)");
    return 0.0f;
  }
  std::vector<ods::Picture> looks;
  for (const size_t i : looks_at(frames, kLooks)) looks.push_back(first_look(frames[i]));
  const std::optional<float> stops = ods::suitable_exposure(looks);
  if (!stops) {
    warn("there is nothing to see: no light reaches the camera (--env 1 lights the scene, --position X,Y,Z moves it)");
    return job_.brighter;
  }
  const float exposure = brightened(*stops, job_.brighter);
  if (!shown) {
    note(fmt::format("noise is judged at {:+} stops, as the picture will be looked at", exposure));
    return exposure;
  }
  const std::string more = job_.brighter == 0.0f ? "" : fmt::format(" and --brighter {}", job_.brighter);
  note(fmt::format("exposure {:+} stops, from a first look at the light{} (--exposure {})", exposure, more, exposure));
  return exposure;
}

ods::Image FrameRenderer::find_merge(const std::vector<Frame>& frames) {
  std::vector<float> shares(ods::kMergeRows, 1.0f);
  for (const size_t i : looks_at(frames, kMergeLooks)) {
    const std::vector<ods::StereoCamera> cameras = set_time(frames[i]);
    ods::take_least(shares, ods::shares_seen(*renderer_, cameras[cameras.size() / 2], *job_.camera.merge_limit));
  }
  ods::Image map = ods::merge_map_of(std::move(shares));
  const auto full = [&](int from, int step) {
    int row = from;
    while (row > 0 && row + 1 < map.height && map.at(0, row)[0] == 1.0f) row += step;
    return std::abs(90 - row);
  };
  note(fmt::format(
      "merge by depth: full stereo up to {} degrees up and {} down, {:.0f} % straight up, {:.0f} % straight "
      "down",
      full(89, -1), full(90, 1), 100.0f * map.at(0, 0)[0], 100.0f * map.at(0, map.height - 1)[0]));
  return map;
}

// One line for all frames, and none where the job is a part of one: the others would say it again.
void FrameRenderer::warn_of_strain(const std::vector<Frame>& frames) {
  const double samples = 2.0 * job_.render.width * job_.render.width / 2.0 * job_.render.samples;
  const bool is_long = samples * static_cast<double>(frames.size()) >= kLongSamples;
  if (!is_long || job_.part || ods::eye_list(job_.render.eyes).size() < 2) return;
  for (const size_t i : looks_at(frames, kLooks)) {
    const std::vector<ods::StereoCamera> cameras = set_time(frames[i]);
    const std::string line =
        strain_line(*renderer_, scene_, cameras[cameras.size() / 2], ods::ComfortLevel::kError);
    if (line.empty()) continue;
    return warn(line + (job_.camera.merge_limit ? "" : ", or --merge auto or a smaller --ipd") + "; ods comfort has more");
  }
}

// Options for a picture of the same kind that takes a 64th of the time; more where few pixels would tell little, and
// where few paths would not fill the light cache.
static ods::RenderOptions small_picture(const ods::RenderOptions& whole, const ods::StereoCamera& camera) {
  constexpr double kLeast = 1.0 / 64.0, kFewestPixels = 16384.0, kPathsThatFill = 65536.0, kMostForPaths = 0.25;
  const auto paths = static_cast<double>(ods::light_cache_paths(whole));
  const double for_paths = paths == 0.0 ? 0.0 : std::min(kPathsThatFill / paths, kMostForPaths);
  const double for_pixels = std::min(kFewestPixels / (1.0 * whole.width * whole.height), 1.0);
  const double share = std::max({kLeast, for_paths, for_pixels});
  const int step = ods::width_step(camera.projection);
  ods::RenderOptions small = whole;
  small.width = std::max(static_cast<int>(whole.width * std::sqrt(share)) / step * step, step);
  small.height = 0;
  small.cache_paths = static_cast<int>(paths * share);
  return ods::with_height(small, camera);
}

SmallFrame FrameRenderer::try_small(const Frame& frame, const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  const ods::StereoCamera& camera = cameras[cameras.size() / 2];
  const ods::RenderOptions whole = options_for(frame, camera), small = small_picture(whole, camera);
  const double set = seconds_since(start);
  ods::Picture picture = renderer_->render(cameras, small);
  const double rendered = seconds_since(start) - set;
  const double times = 1.0 * whole.width * whole.height / (1.0 * small.width * small.height);
  double bytes = 0.0;
  for (const std::string& file : finish_picture(job_, camera, std::move(picture), path)) {
    bytes += static_cast<double>(std::filesystem::file_size(file));
  }
  const double finished = seconds_since(start) - set - rendered;
  const double limit = whole.time_limit > 0.0 ? whole.time_limit : std::numeric_limits<double>::infinity();
  return {set + std::min(times * rendered, limit) + times * finished, times * bytes};
}

void FrameRenderer::keep_raw(const Frame& frame, const std::function<void(double done)>& report) {
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  const ods::RenderOptions options = options_for(frame, cameras[cameras.size() / 2]);
  ods::check_picture_memory(options);
  ods::PictureSamples samples = ods::no_samples(options);
  ods::Progress progress;
  progress.report = report;
  renderer_->sample(cameras, options, samples, progress);
  ods::write_unfinished(raw_path(frame), {{}, {}, exposure_, {}, options}, samples);
}

// What keep_raw() has written; none: there is nothing of use.
static std::optional<ods::Picture> read_raw(const std::string& path, const ods::RenderOptions& options) {
  if (!ods::is_saved(path)) return std::nullopt;
  try {
    ods::PictureSamples samples;
    ods::read_unfinished(path, samples);
    if (ods::fit(samples, options)) return ods::develop(std::move(samples), options);
    warn(fmt::format("'{}' is of another picture: the frame is rendered again", path));
  } catch (const ods::Error& error) {
    if (error.kind() != ods::ErrorKind::kInput) throw;
    warn(fmt::format("{}: the frame is rendered again", error.what()));
  }
  return std::nullopt;
}

RawFrame FrameRenderer::render_raw(const Frame& frame, const std::function<void(double done)>& report) {
  const std::vector<ods::StereoCamera> cameras = set_time(frame);
  const ods::StereoCamera& camera = cameras[cameras.size() / 2];
  const ods::RenderOptions options = options_for(frame, camera);
  ods::Progress progress;
  progress.report = report;
  std::optional<ods::Picture> kept = read_raw(raw_path(frame), options);
  RawFrame raw{frame.time, camera, kept ? std::move(*kept) : renderer_->render(cameras, options, progress), {}};
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
