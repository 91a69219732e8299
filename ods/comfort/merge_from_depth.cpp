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
#include "ods/picture/picture.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr int kReach = 5;         // rows over which the curve is smoothed, to either side
constexpr int kBetween = 2;       // rows more, for what lies between rows and between the pixels that were looked at
constexpr float kSafety = 0.98f;  // eyes beside the middle see a little past the edges of what the middle sees
constexpr int kColumns = 4;       // of the map, all alike

int row_of(double elevation) {
  const double row = (0.5 - elevation / pi) * kMergeRows;
  return std::clamp(static_cast<int>(row), 0, kMergeRows - 1);
}

// The share of the radius with which a point is within the limit, and the elevation at which it is then shown.
struct Allowed {
  double share = 1.0, elevation = 0.0;
};

Allowed allowed(double across, double height, double radius, double gaze, double limit) {
  Allowed result;
  for (int i = 0; i < 8; i++) {
    const double circle = std::min(result.share * radius, 0.999 * across);
    const CircleView view = seen_from_circle(circle, across, height);
    result.elevation = view.elevation;
    const double worst = worst_vertical_disparity(view.half_parallax, view.elevation, gaze);
    result.share = std::min({1.0, result.share, worst > 0.0 ? circle / radius * limit / worst : 1.0});
  }
  return result;
}

}  // namespace

std::vector<float> comfortable_shares(const SeenDepth& seen, const Viewer& viewer, float limit) {
  assert(seen.eye == kMono);
  const Camera camera = make_camera(seen.camera);
  const double radius = 0.5 * double{camera.ipd}, gaze = double{viewer.gaze_degrees} * pi / 180.0;
  std::vector<float> shares(kMergeRows, 1.0f);
  for (int y = 0; y < seen.depth.height; y++) {
    for (int x = 0; x < seen.depth.width; x++) {
      const float depth = seen.depth.at(x, y)[0];
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(seen.depth.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(seen.depth.height));
      const ViewDirection look = look_of(camera.projection, uv, uv);
      if (!look.seen || !is_surface(depth) || radius == 0.0) continue;
      const glm::dvec3 point = glm::dvec3(look.direction) * double{depth};
      const double across = std::max(std::hypot(point.x, point.z), 1e-6);
      const Allowed own = allowed(across, point.y, radius, gaze, double{limit} * kArcMinute);
      float& least = shares[static_cast<size_t>(row_of(own.elevation))];
      least = std::min(least, static_cast<float>(own.share));
    }
  }
  return shares;
}

void take_least(std::vector<float>& shares, const std::vector<float>& others) {
  for (size_t i = 0; i < shares.size(); i++) shares[i] = std::min(shares[i], others[i]);
}

void use_merge_map(StereoCamera& camera, Image map) {
  camera.merge_map = std::make_shared<const Image>(std::move(map));
  camera.top.mode = camera.bottom.mode = kMergeMap;
}

// The least within reach of each row, and then the mean of these, which is no more than what the row itself allows.
Image merge_map_of(std::vector<float> shares) {
  const int middle = kMergeRows / 2;
  const auto at = [&](int row) -> float& { return shares[static_cast<size_t>(std::clamp(row, 0, kMergeRows - 1))]; };
  for (int row = middle - 2; row >= 0; row--) at(row) = std::min(at(row), at(row + 1));
  for (int row = middle + 1; row < kMergeRows; row++) at(row) = std::min(at(row), at(row - 1));
  std::vector<float> least;
  for (int row = 0; row < kMergeRows; row++) {
    float value = at(row);
    for (int i = -kReach - kBetween; i <= kReach + kBetween; i++) value = std::min(value, at(row + i));
    least.push_back(value < 1.0f ? kSafety * value : 1.0f);
  }
  Image map(kColumns, kMergeRows, 1);
  for (int row = 0; row < kMergeRows; row++) {
    float sum = 0.0f;
    for (int i = -kReach; i <= kReach; i++) sum += least[static_cast<size_t>(std::clamp(row + i, 0, kMergeRows - 1))];
    const float value = sum / (2 * kReach + 1);
    for (int x = 0; x < kColumns; x++) map.at(x, row)[0] = value;
  }
  return map;
}

}  // namespace ods
