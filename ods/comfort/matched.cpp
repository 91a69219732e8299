// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/matched.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "ods/base/angles.h"
#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/disparity/alignment.h"
#include "ods/disparity/dense_match.h"
#include "ods/picture/picture.h"

namespace ods {

namespace {

constexpr double kNearHorizon = 30.0;  // degrees
constexpr int kMinMatches = 15;        // of tiles, that two eyes of one picture have

GrayView half_of(const GrayView& view) {
  GrayView half(view.width / 2, view.height / 2, 1);
  for (int y = 0; y < half.height; y++) {
    for (int x = 0; x < half.width; x++) {
      *half.at(x, y) = 0.25f * (*view.at(2 * x, 2 * y) + *view.at(2 * x + 1, 2 * y) + *view.at(2 * x, 2 * y + 1) +
                                *view.at(2 * x + 1, 2 * y + 1));
    }
  }
  return half;
}

// Coarse to fine, as find_alignment() wants them.
std::vector<std::vector<GrayView>> smaller_views(const std::vector<GrayView>& views) {
  std::vector<std::vector<GrayView>> scales = {views};
  while (scales[0][0].width > 256) {
    scales.insert(scales.begin(), {half_of(scales[0][0]), half_of(scales[0][1])});
  }
  if (scales.size() > 1) scales.pop_back();  // half the size is exact enough
  return scales;
}

// Degrees.
double height_apart(const Alignment& alignment) {
  const auto size = [&](AlignmentTerm term) { return std::abs(alignment.terms[term].value); };
  return size(kRaiseTerm) + std::hypot(size(kPitchTerm), size(kRollTerm)) + kNearHorizon * size(kZoomTerm);
}

}  // namespace

// In the plane of the viewing circle, the ray from the eye meets the line from the centre on which both eyes' pictures
// place the point.
float depth_of_parallax(const Camera& camera, int eye, vec2 uv, float around) {
  const ViewDirection look = look_of(camera.projection, uv, uv);
  const Ray ray = camera_ray(camera, eye, uv);
  const vec3 from = ray.origin - camera.center;
  const glm::dvec2 origin(dot(from, camera.right), dot(from, camera.back));
  const glm::dvec2 along(dot(ray.direction, camera.right), dot(ray.direction, camera.back));
  const double azimuth = azimuth_of(look.direction) + 0.5 * double{eye_side(eye)} * double{around};
  const glm::dvec2 line(std::sin(azimuth), -std::cos(azimuth));
  const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
  const double depth = -cross(origin, line) / cross(along, line);
  return depth > 0.0 && depth < 1e4 ? static_cast<float>(depth) : kFarDepth;
}

MatchedEyes match_views_for_depth(std::vector<GrayView> views, const StereoCamera& camera) {
  assert(views.size() == 2);
  DenseMatch match = match_densely(views[0], views[1]);
  MatchedEyes matched;
  matched.share = match.share;
  matched.precision = match.precision / kArcMinute;
  StereoCamera seen_by = camera;
  seen_by.projection = ProjectionSetting();
  const Camera kernel = make_camera(seen_by);
  for (const int eye : {kLeft, kRight}) {
    Image& around = match.around[static_cast<size_t>(eye)];
    tbb::parallel_for(0, around.height, [&](int y) {
      for (int x = 0; x < around.width; x++) {
        const vec2 uv = pixel_middle(x, y, around);
        float& value = *around.at(x, y);
        if (!std::isnan(value)) value = depth_of_parallax(kernel, eye, uv, value);
      }
    });
    matched.seen.push_back({seen_by, eye, std::move(around), {}, {}});
  }
  matched.grey = std::move(views);
  return matched;
}

void check_matchable(const ProjectionSetting& projection, int width, const std::string& name) {
  constexpr double kMinAround = 256.0;  // pixels
  const double around = 2.0 * std::numbers::pi * pixels_per_radian(projection, width);
  if (around >= kMinAround) return;
  throw Error(
      ErrorKind::kInput,
      fmt::format("'{}' has no depth, and its eyes have {:.0f} pixels around: too few to be matched", name, around));
}

AlignedEyes align_eyes(const std::vector<Image>& eyes, const ProjectionSetting& projection, bool is_float, int width) {
  AlignedEyes aligned{make_gray_views(eyes, projection, is_float, width)};
  std::vector<GrayView>& views = aligned.views;
  const Alignment alignment = find_alignment(smaller_views(views), !(seen_around(views[0]) > 0.8));
  if (const EyeCorrection correction = correction_of(alignment); moves_pixels(correction)) {
    views[1] = corrected_view(views[1], correction);
  }
  aligned.apart = 60.0 * height_apart(alignment);
  aligned.are_one_picture = alignment.matches >= kMinMatches;
  return aligned;
}

MatchedEyes match_eyes_for_depth(const std::vector<Image>& eyes, const StereoCamera& camera, bool is_float, int width) {
  AlignedEyes aligned = align_eyes(eyes, camera.projection, is_float, width);
  MatchedEyes matched = match_views_for_depth(std::move(aligned.views), camera);
  matched.apart = aligned.apart;
  if (!aligned.are_one_picture) {
    for (SeenDepth& seen : matched.seen) std::ranges::fill(seen.depth.pixels, std::numeric_limits<float>::quiet_NaN());
    matched.share = matched.apart = 0.0;
  }
  return matched;
}

}  // namespace ods
