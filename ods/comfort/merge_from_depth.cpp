// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/merge_from_depth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "ods/base/angles.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/areas.h"
#include "ods/convert/reproject.h"
#include "ods/picture/picture.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr int kReach = 5;         // rows over which the curve is smoothed, to either side
constexpr int kBetween = 2;       // more rows, for points between rows and between the sampled pixels
constexpr int kLookReach = 8;     // looks of a video, for the same reason
constexpr float kSafety = 0.98f;  // eyes beside the middle see a little past the edges that the middle sees
constexpr int kColumns = 4;       // of the map, all alike

int row_of(double elevation) {
  const double row = (0.5 - elevation / pi) * kMergeRows;
  return std::clamp(static_cast<int>(row), 0, kMergeRows - 1);
}

// The share of the radius with which a point is within the limit, and the elevation at which it is then shown.
struct Allowed {
  double share = 1.0, elevation = 0.0;
};

Allowed allowed(double across, double height, double radius, const HeadReach& reach, double limit) {
  Allowed result;
  for (int i = 0; i < 8; i++) {
    const double circle = std::min(result.share * radius, 0.999 * across);
    const CircleView view = seen_from_circle(circle, across, height);
    result.elevation = view.elevation;
    const double worst = worst_vertical_disparity(view.half_parallax, view.elevation, reach);
    const double share = worst > 0.0 ? circle / radius * limit / worst : 1.0;
    if (share >= result.share) break;
    result.share = share;
  }
  return result;
}

// The mean over `reach` values to either side of the least within reach of each and `between` more: no more than the
// value itself, and even.
std::vector<float> eased(const std::vector<float>& values, int reach, int between) {
  const int count = static_cast<int>(values.size());
  const auto at = [count](const std::vector<float>& row, int i) {
    return row[static_cast<size_t>(std::clamp(i, 0, count - 1))];
  };
  std::vector<float> minimum, even;
  for (int i = 0; i < count; i++) {
    float value = at(values, i);
    for (int k = -reach - between; k <= reach + between; k++) value = std::min(value, at(values, i + k));
    minimum.push_back(value);
  }
  for (int i = 0; i < count; i++) {
    float sum = 0.0f;
    for (int k = -reach; k <= reach; k++) sum += at(minimum, i + k);
    even.push_back(sum / static_cast<float>(2 * reach + 1));
  }
  return even;
}

// Returns the nearest depth in each direction, as seen from the middle between the target's eyes.
SeenDepth seen_from_middle(const std::vector<SeenDepth>& eyes, const StereoCamera& target) {
  constexpr int kWidth = 512;
  SeenDepth middle;
  middle.camera.ipd = target.ipd;
  middle.eye = kMono;
  middle.depth = Image(kWidth, kWidth / 2, 1);
  std::ranges::fill(middle.depth.pixels, kFarDepth);
  const Camera to = make_camera(target);
  for (const SeenDepth& seen : eyes) {
    const Camera from = make_camera(seen.camera);
    for (int i = 0; i < seen.depth.width * seen.depth.height; i++) {
      const float distance = seen.depth.pixels[static_cast<size_t>(i)];
      if (!is_surface(distance)) continue;
      const vec2 uv = pixel_middle(i % seen.depth.width, i / seen.depth.width, seen.depth);
      const Ray ray = camera_ray(from, seen.eye, uv);
      if (ray.direction == vec3(0.0f)) continue;
      const vec3 point = ray.origin - from.center + ray.direction * distance;
      const vec3 own(dot(point, to.right), dot(point, to.up), dot(point, to.back));
      const vec2 at = direction_to_lat_long(normalize(own));
      const glm::ivec2 pixel = pixel_at(at, middle.depth);
      float& nearest = *middle.depth.at(pixel.x, pixel.y);
      nearest = std::min(nearest, length(own));
    }
  }
  return middle;
}

}  // namespace

std::vector<float> comfortable_shares(const SeenDepth& seen, const Viewer& viewer, float limit) {
  assert(seen.eye == kMono);
  const Camera camera = make_camera(seen.camera);
  const double radius = 0.5 * double{camera.ipd};
  const HeadReach reach = reach_of(viewer);
  std::vector<float> shares(kMergeRows, 1.0f);
  for (int y = 0; y < seen.depth.height; y++) {
    for (int x = 0; x < seen.depth.width; x++) {
      const float depth = seen.depth.at(x, y)[0];
      const vec2 uv = pixel_middle(x, y, seen.depth);
      const ViewDirection look = look_of(camera.projection, uv, uv);
      if (!look.seen || !is_surface(depth) || radius == 0.0) continue;
      const glm::dvec3 point = glm::dvec3(look.direction) * double{depth};
      const double across = std::max(std::hypot(point.x, point.z), 1e-6);
      const Allowed own = allowed(across, point.y, radius, reach, double{kSafety * limit} * kArcMinute);
      float& minimum = shares[static_cast<size_t>(row_of(own.elevation))];
      minimum = std::min(minimum, static_cast<float>(own.share));
    }
  }
  return shares;
}

std::vector<SeenDepth> seen_by_eyes(const StoredPicture& picture) {
  constexpr int kMaxWidth = 2048;
  std::vector<SeenDepth> eyes;
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    Image depth = nearest_of_blocks(depth_of_eye(picture, i), kMaxWidth);
    eyes.push_back({picture.camera, picture.eyes[i].eye, std::move(depth), {}, {}});
  }
  return eyes;
}

std::vector<float> comfortable_shares(const std::vector<SeenDepth>& eyes, const StereoCamera& target, float limit) {
  return comfortable_shares(seen_from_middle(eyes, target), {}, limit);
}

void min_in_place(std::vector<float>& shares, const std::vector<float>& others) {
  for (size_t i = 0; i < shares.size(); i++) shares[i] = std::min(shares[i], others[i]);
}

void use_merge_map(StereoCamera& camera, Image map) {
  camera.merge_map = std::make_shared<const Image>(std::move(map));
  camera.top.mode = camera.bottom.mode = kMergeMap;
}

Image merge_map_of(std::vector<float> shares) {
  const int middle = kMergeRows / 2;
  const auto at = [&](int row) -> float& { return shares[static_cast<size_t>(std::clamp(row, 0, kMergeRows - 1))]; };
  for (int row = middle - 2; row >= 0; row--) at(row) = std::min(at(row), at(row + 1));
  for (int row = middle + 1; row < kMergeRows; row++) at(row) = std::min(at(row), at(row - 1));
  shares = eased(shares, kReach, kBetween);
  Image map(kColumns, kMergeRows, 1);
  for (int row = 0; row < kMergeRows; row++) std::fill_n(map.at(0, row), kColumns, at(row));
  return map;
}

// --- videos ----------------------------------------------------------------------------------------------------------

// Between two looks the limit is what both allow: the minimum extends one look farther.
SteadyMerge::SteadyMerge(const std::vector<std::vector<float>>& looks, int step) : step_(step) {
  assert(!looks.empty() && step > 0);
  std::vector<std::vector<float>> shares = looks;
  for (size_t row = 0; row < kMergeRows; row++) {
    std::vector<float> over_time;
    for (const std::vector<float>& look : looks) over_time.push_back(look[row]);
    over_time = eased(over_time, kLookReach, 1);
    for (size_t i = 0; i < shares.size(); i++) shares[i][row] = over_time[i];
  }
  for (std::vector<float>& each : shares) maps_.push_back(merge_map_of(std::move(each)));
}

std::shared_ptr<const Image> SteadyMerge::at(int picture) const {
  const size_t last = maps_.size() - 1, before = std::min(static_cast<size_t>(picture / step_), last);
  const Image &from = maps_[before], &to = maps_[std::min(before + 1, last)];
  const float beyond = static_cast<float>(picture % step_) / static_cast<float>(step_);
  auto map = std::make_shared<Image>(from);
  for (size_t i = 0; i < map->pixels.size(); i++) map->pixels[i] += beyond * (to.pixels[i] - from.pixels[i]);
  return map;
}

Image SteadyMerge::minimum() const {
  Image minimum = maps_[0];
  for (const Image& map : maps_) min_in_place(minimum.pixels, map.pixels);
  return minimum;
}

bool SteadyMerge::varies() const {
  return std::ranges::any_of(maps_, [&](const Image& map) { return map.pixels != maps_[0].pixels; });
}

}  // namespace ods
