// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/cycles_camera.h"

#include <algorithm>

#include "ods/kernel/camera/camera.h"

namespace ods {
namespace {

constexpr float kBandPixels = 0.25f;  // of a point 1 m away

bool has_cycles_merge(const StereoCamera& camera) {
  const auto is_cosine = [](const PoleMergeSetting& merge) {
    return merge.mode == kMergeNone || (merge.mode == kMergeCosine && merge.exponent == 1.0f && merge.start >= 0.0f);
  };
  return is_cosine(camera.top) && is_cosine(camera.bottom) && same_merge(camera.top, camera.bottom);
}

// The share of the eye distance in each row.
std::vector<float> shares_of(const StereoCamera& stereo, int height) {
  const Camera camera = make_camera(stereo);
  std::vector<float> shares;
  for (int y = 0; y < height; y++) {
    const Ray ray = camera_ray(camera, kLeft, vec2(0.5f, (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
    shares.push_back(length(ray.origin - camera.center) / (0.5f * stereo.ipd));
  }
  return shares;
}

// The first rows of bands within which the shares differ by so much at most, but for bands of kLeastBand rows.
std::vector<int> starts_of(const std::vector<float>& shares, float most) {
  std::vector<int> starts = {0};
  float low = shares[0], high = low;
  for (int row = 1; row < static_cast<int>(shares.size()); row++) {
    const float share = shares[static_cast<size_t>(row)];
    low = std::min(low, share), high = std::max(high, share);
    if (high - low <= most || row - starts.back() < kLeastBand) continue;
    starts.push_back(row);
    low = high = share;
  }
  return starts;
}

CyclesBand band_of(const StereoCamera& whole, int height, int first, int rows, float share) {
  CyclesBand band{first, rows, whole};
  band.camera.top = band.camera.bottom = PoleMergeSetting();
  band.camera.merge_map.reset();
  band.camera.ipd = whole.ipd * share;
  const vec2 range = whole.projection.latitude;
  const auto latitude = [&](int row) {
    return range.y - (range.y - range.x) * static_cast<float>(row) / static_cast<float>(height);
  };
  band.camera.projection.latitude = {latitude(first + rows), latitude(first)};
  return band;
}

}  // namespace

std::string cycles_lacks(const StereoCamera& camera) {
  const bool has_map = camera.top.mode == kMergeMap || camera.bottom.mode == kMergeMap;
  if (has_map && camera.merge_map && !is_same_around(*camera.merge_map)) return "a `merge-map` that is the same around";
  if (camera.neck != 0.0f) return "eyes on the neck's axis (no `eye-to-neck`)";
  if (camera.axis) return "a viewing circle square to the camera's up (no `axis`)";
  if (camera.head_tilt_map) return "a level head (no `head-tilt-map`)";
  if (camera.mirrored) return "a right-handed world";
  if (camera.convergence == kShift) return "eyes that look ahead or toe in (`convergence`)";
  return "";
}

std::vector<CyclesBand> cycles_bands(const StereoCamera& camera, int height) {
  if (camera.ipd == 0.0f || has_cycles_merge(camera) || height < 2 * kLeastBand) return {{0, height, camera}};
  const std::vector<float> shares = shares_of(camera, height);
  const float range = glm::radians(camera.projection.latitude.y - camera.projection.latitude.x);
  const float most = 2.0f * kBandPixels * range / static_cast<float>(height) / (0.5f * camera.ipd);  // from end to end
  std::vector<int> starts = starts_of(shares, most);
  // The last rows may be too few.
  if (starts.size() > 1 && height - starts.back() < kLeastBand) starts.back() = height - kLeastBand;
  if (starts.size() > 1 && starts.back() - starts[starts.size() - 2] < kLeastBand) starts.pop_back();
  std::vector<CyclesBand> bands;
  for (size_t i = 0; i < starts.size(); i++) {
    const int first = starts[i], end = i + 1 < starts.size() ? starts[i + 1] : height;
    const auto [low, high] = std::minmax_element(shares.begin() + first, shares.begin() + end);
    bands.push_back(band_of(camera, height, first, end - first, 0.5f * (*low + *high)));
  }
  return bands;
}

bool cycles_projects(const ProjectionSetting& projection) {
  return projection.kind == kLatLong && projection.pan == 0.0f && projection.tilt == 0.0f;
}

StereoCamera lat_long_of(StereoCamera camera) {
  camera.projection = ProjectionSetting();
  return camera;
}

}  // namespace ods
