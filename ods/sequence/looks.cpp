// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/looks.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "ods/render/light_cache.h"
#include "ods/render/render_target.h"
#include "ods/stage/exposure.h"
#include "ods/stage/judge_scene.h"

namespace ods {

std::set<size_t> sampled_frames(const std::vector<SequenceFrame>& frames, size_t count) {
  assert(!frames.empty());
  std::set<size_t> chosen;
  for (size_t i = 0; i < count; i++) chosen.insert((2 * i + 1) * frames.size() / (2 * count));
  return chosen;
}

static std::optional<float> exposure_for(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames) {
  std::vector<Picture> looks;
  for (const size_t i : sampled_frames(frames, kLooks)) {
    const Shot shot = renderer.set(frames[i]);
    looks.push_back(
        renderer.renderer().render(metering_camera(shot.camera()), metering_options(renderer.options().render)));
  }
  return suitable_exposure(looks);
}

static Image merge_for(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames, float limit) {
  constexpr size_t kMergeLooks = 16;
  std::vector<float> shares(kMergeRows, 1.0f);
  for (const size_t i : sampled_frames(frames, kMergeLooks)) {
    const Shot shot = renderer.set(frames[i]);
    min_in_place(shares, shares_seen(renderer.renderer(), shot.camera(), limit));
  }
  return merge_map_of(std::move(shares));
}

FirstLook look_first(FrameRenderer& renderer, const std::vector<SequenceFrame>& frames) {
  SequenceOptions options = renderer.options();
  if (options.merge_limit) {
    use_merge_map(options.camera.stereo, merge_for(renderer, frames, *options.merge_limit));
  }
  FirstLook look;
  if (options.exposure) {
    look.chosen = *options.exposure;
  } else if (renderer.scene().as_painted) {
    look.reason = ExposureReason::kPainted;
  } else {
    const std::optional<float> stops = exposure_for(renderer, frames);
    look.chosen = stops.value_or(0.0f);
    look.reason = stops ? ExposureReason::kLight : ExposureReason::kDark;
  }
  look.exposure = brightened(look.chosen, options.brighter);
  options.render.noise_exposure = look.exposure;
  renderer.set_options(std::move(options));
  return look;
}

// Options for a picture of the same kind that takes a 64th of the time; more if so few pixels would not be
// representative, or so few paths would not fill the light cache.
static RenderOptions small_picture(const RenderOptions& whole, const StereoCamera& camera) {
  constexpr double kMinShare = 1.0 / 64.0, kMinPixels = 16384.0, kPathsThatFill = 65536.0, kMaxForPaths = 0.25;
  const auto paths = static_cast<double>(light_cache_paths(whole));
  const double for_paths = paths == 0.0 ? 0.0 : std::min(kPathsThatFill / paths, kMaxForPaths);
  const double for_pixels = std::min(kMinPixels / (1.0 * whole.width * whole.height), 1.0);
  const double share = std::max({kMinShare, for_paths, for_pixels});
  const int step = width_step(camera.projection);
  RenderOptions small = whole;
  small.width = std::max(static_cast<int>(whole.width * std::sqrt(share)) / step * step, step);
  small.height = 0;
  small.cache_paths = static_cast<int>(paths * share);
  return with_height(small, camera);
}

SmallFrame try_small(FrameRenderer& renderer, const SequenceFrame& frame, const std::string& path) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  };
  const Clock::time_point start = Clock::now();
  const Shot shot = renderer.set(frame);
  const RenderOptions &whole = shot.options, small = small_picture(whole, shot.camera());
  const Clock::time_point set = Clock::now();
  Picture picture = renderer.renderer().render(shot.cameras, small);
  const Clock::time_point rendered = Clock::now();
  const double times = 1.0 * whole.width * whole.height / (1.0 * small.width * small.height);
  const SequenceOptions& options = renderer.options();
  double bytes = 0.0;
  for (const std::string& file :
       finish_picture(options.finish, options.render, shot.camera(), std::move(picture), path)) {
    bytes += static_cast<double>(std::filesystem::file_size(file));
  }
  const double limit = whole.time_limit > 0.0 ? whole.time_limit : std::numeric_limits<double>::infinity();
  const double rendering = std::min(times * seconds(set, rendered), limit);
  return {seconds(start, set) + rendering + times * seconds(rendered, Clock::now()), times * bytes};
}

}  // namespace ods
