// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/title.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "ods/convert/resample.h"

namespace ods {

// Lettering pixels per picture pixel: its edges must be no wider than the picture's.
constexpr float kPixelsPerPixel = 2.0f;

float lettering_em(const StereoCamera& stereo, Extent eye, const TitleSetting& setting) {
  const double angle = static_cast<double>(setting.height / setting.distance);
  const double pixels = angle * pixels_per_radian(stereo.projection, eye.width) * static_cast<double>(kPixelsPerPixel);
  return static_cast<float>(std::clamp(pixels, 8.0, 2048.0));
}

Title make_title(const StereoCamera& stereo, Extent eye, const TitleSetting& setting, const Lettering& lettering) {
  assert(eye.width > 0 && eye.height > 0 && setting.distance > 0.0f && setting.height > 0.0f);
  Title title;
  StereoCamera centred = stereo;
  centred.position = vec3(0.0f);
  title.camera = make_camera(centred);
  title.eye = eye;
  title.coverage = lettering.coverage;
  title.setting = setting;
  const auto [right, up, back] =
      orientation(glm::radians(double{setting.yaw}), glm::radians(double{setting.pitch}), 0.0);
  title.right = vec3(right), title.up = vec3(up), title.middle = -vec3(back);
  title.pixels = lettering.em / setting.height;
  // Covers the corner, the eye's offset from the centre, and some pixels of margin.
  const vec2 half = vec2(title.coverage.width, title.coverage.height) * (0.5f / title.pixels / setting.distance);
  const float across = setting.curved ? half.x : std::atan(half.x);
  const float away = std::hypot(0.5f * stereo.ipd, stereo.neck) / setting.distance;
  const float step = 4.0f / static_cast<float>(std::max(1.0, pixels_per_radian(stereo.projection, eye.width)));
  const float slack = std::asin(std::min(1.0f, away)) + step, up_or_down = std::atan(half.y);
  const float angle = std::hypot(across, up_or_down) + slack;
  title.reach = angle < kPi ? std::cos(angle) : -1.0f;
  title.rise = up_or_down + slack < 0.5f * kPi ? std::sin(up_or_down + slack) : 1.0f;
  return title;
}

namespace {

struct TitlePoint {
  vec2 at;      // pixels of the coverage, from its top left corner
  float depth;  // along the ray
};

}  // namespace

// Intersects a ray with the card, from its concave or front side.
static std::optional<TitlePoint> meet(const Title& title, const Ray& ray) {
  const auto local = [&](vec3 v) { return vec3(dot(v, title.right), dot(v, title.up), dot(v, title.middle)); };
  const vec3 o = local(ray.origin), d = local(ray.direction);
  const float distance = title.setting.distance;
  float t = 0.0f;
  vec2 metres;
  if (title.setting.curved) {
    const float a = d.x * d.x + d.z * d.z, b = o.x * d.x + o.z * d.z;
    const float c = o.x * o.x + o.z * o.z - distance * distance;
    if (!(a > 0.0f) || c > 0.0f) return std::nullopt;  // the eye is behind the letters
    t = (-b + std::sqrt(b * b - a * c)) / a;
    metres = vec2(distance * std::atan2(o.x + t * d.x, o.z + t * d.z), o.y + t * d.y);
  } else {
    if (!(d.z > 0.0f)) return std::nullopt;
    t = (distance - o.z) / d.z;
    metres = vec2(o.x + t * d.x, o.y + t * d.y);
  }
  if (!(t > 0.0f)) return std::nullopt;
  const vec2 size(title.coverage.width, title.coverage.height);
  return TitlePoint{vec2(metres.x, -metres.y) * title.pixels + 0.5f * size, t};
}

static float coverage_at(const Image& image, vec2 at) {
  const vec2 from = at - 0.5f, base = floor(from), beyond = from - base;
  const auto texel = [&](float x, float y) {
    const bool inside =
        x >= 0.0f && y >= 0.0f && x < static_cast<float>(image.width) && y < static_cast<float>(image.height);
    return inside ? *image.at(static_cast<int>(x), static_cast<int>(y)) : 0.0f;
  };
  return mix(mix(texel(base.x, base.y), texel(base.x + 1.0f, base.y), beyond.x),
             mix(texel(base.x, base.y + 1.0f), texel(base.x + 1.0f, base.y + 1.0f), beyond.x), beyond.y);
}

static float coverage_of_pixel(const Title& title, const TitlePoint& spot, const Footprint& footprint,
                               std::vector<FilterPoint>& points) {
  filter_points(footprint, points);
  float sum = 0.0f;
  for (const FilterPoint& point : points) sum += point.weight * coverage_at(title.coverage, spot.at + point.texels);
  return sum;
}

void fill_title_row(const Title& title, int eye, int y, std::span<float> row) {
  const vec2 pixel(1.0f / static_cast<float>(title.eye.width), 1.0f / static_cast<float>(title.eye.height));
  std::vector<FilterPoint> points;
  for (int x = 0; x < title.eye.width; x++) {
    float* out = &row[static_cast<size_t>(x) * 5];
    std::fill_n(out, 4, 0.0f);
    out[4] = kFarDepth;
    const vec2 uv = (vec2(x, y) + 0.5f) * pixel;
    const Ray ray = camera_ray(title.camera, eye, uv);
    if (ray.direction == vec3(0.0f) || dot(ray.direction, title.middle) < title.reach) continue;
    if (std::abs(dot(ray.direction, title.up)) > title.rise) continue;  // a long line of text covers a narrow band
    const auto beside = [&](vec2 step) {
      return meet(title, camera_ray(title.camera, eye, uv, uv + step, vec2(0.0f)));
    };
    const auto spot = meet(title, ray), right = beside({pixel.x, 0.0f}), below = beside({0.0f, pixel.y});
    if (!spot || !right || !below) continue;
    const float coverage = coverage_of_pixel(title, *spot, {right->at - spot->at, below->at - spot->at}, points);
    const float alpha = std::min(coverage, 1.0f) * title.setting.opacity;
    if (!(alpha > 0.0f)) continue;
    for (int c = 0; c < 3; c++) out[c] = title.setting.color[c] * alpha;
    out[3] = alpha;
    out[4] = spot->depth;
  }
}

// Half the text's width over its distance: the angle on a curved card, its tangent on a flat one.
static float half_width(const Title& title) {
  return static_cast<float>(title.coverage.width) * 0.5f / title.pixels / title.setting.distance;
}

float title_width(const Title& title) {
  const float half = half_width(title);
  return 2.0f * glm::degrees(title.setting.curved ? half : std::atan(half));
}

float comfortable_height(const Title& title) {
  const float angle = glm::radians(0.5f * kComfortableWidth);
  const float maximum = title.setting.curved ? angle : std::tan(angle);
  return title.setting.height * std::min(1.0f, maximum / half_width(title));
}

float nearest_comfortable(const StereoCamera& stereo, float pitch) {
  const float kAlongHorizon = 0.6f, kOverhead = 3.5f, kSourcesIpd = 0.065f;
  const float kSteep = 58.6f;  // degrees: the pitch at which both rules allow the same vertical disparity
  const Camera camera = make_camera(stereo);
  const float phi = glm::radians(pitch);
  const float merged = merge_at(camera, vec3(0.0f, std::sin(phi), -std::cos(phi)), phi);
  return (std::abs(pitch) < kSteep ? kAlongHorizon : kOverhead) * stereo.ipd * merged / kSourcesIpd;
}

}  // namespace ods
