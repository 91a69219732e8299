// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/disparity/rim.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ods {

constexpr int kRays = 720;
constexpr float kMinDark = 0.03f;  // video black, and the noise and ringing of codecs
constexpr float kMinShare = 0.2f;  // minimum fraction of the circle
constexpr float kRound = 0.012f;   // relative to the radius: maximum distance of a border from the circle

static float sample(const Image& image, vec2 at) {
  const float x = std::clamp(at.x - 0.5f, 0.0f, static_cast<float>(image.width - 1));
  const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(image.height - 1));
  const int x0 = std::min(static_cast<int>(x), image.width - 2), y0 = std::min(static_cast<int>(y), image.height - 2);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const float top = std::lerp(*image.at(x0, y0), *image.at(x0 + 1, y0), fx);
  return std::lerp(top, std::lerp(*image.at(x0, y0 + 1), *image.at(x0 + 1, y0 + 1), fx), fy);
}

// Maximum brightness of the surround: the darkest corner plus a margin.
static float dark_level(const Image& image) {
  const int side = std::max(1, std::min(image.width, image.height) / 50);
  float darkest = 1.0f;
  for (const int x : {0, image.width - side}) {
    for (const int y : {0, image.height - side}) {
      float maximum = 0.0f;
      for (int i = 0; i < side * side; i++) maximum = std::max(maximum, *image.at(x + i % side, y + i / side));
      darkest = std::min(darkest, maximum);
    }
  }
  return darkest + kMinDark;
}

// The length of a ray from `from` inside the image.
static float length_inside(const Image& image, vec2 from, vec2 way) {
  float length = 1e9f;
  const vec2 size(static_cast<float>(image.width), static_cast<float>(image.height));
  for (int c = 0; c < 2; c++) {
    if (way[c] > 0.0f) length = std::min(length, (size[c] - from[c]) / way[c]);
    if (way[c] < 0.0f) length = std::min(length, -from[c] / way[c]);
  }
  return length;
}

// The point on the way inwards where the image becomes brighter than dark; the steepest point near it. Returns nullopt
// if it is bright at its very edge, or nowhere.
static std::optional<vec2> border_on(const Image& image, vec2 from, vec2 way, float dark) {
  const float length = length_inside(image, from, way), kStep = 0.5f;
  if (sample(image, from + way * (length - 0.5f)) > dark) return std::nullopt;
  float at = length - 0.5f;
  while (at > 0.0f && sample(image, from + way * at) <= dark) at -= kStep;
  if (at <= 0.0f) return std::nullopt;
  float steepest = 0.0f, best = at;
  for (float t = at - 2.0f; t <= at + 2.0f; t += 0.1f) {
    const float slope = sample(image, from + way * (t - 0.5f)) - sample(image, from + way * (t + 0.5f));
    if (slope > steepest) steepest = slope, best = t;
  }
  return from + way * best;
}

// Least squares of x^2 + y^2 + a x + b y + c = 0. Source: I. Kasa, "A Circle Fitting Procedure and Its Error Analysis".
static std::optional<Rim> fit(const std::vector<vec2>& points) {
  glm::dmat3 sums(0.0);
  glm::dvec3 right(0.0);
  glm::dvec2 mean(0.0);
  for (const vec2& p : points) mean += glm::dvec2(p) / static_cast<double>(points.size());
  for (const vec2& p : points) {
    const glm::dvec3 row(glm::dvec2(p) - mean, 1.0);
    sums += glm::outerProduct(row, row);
    right -= row * (row.x * row.x + row.y * row.y);
  }
  if (std::abs(glm::determinant(sums)) < 1e-6) return std::nullopt;
  const glm::dvec3 abc = glm::inverse(sums) * right;
  const glm::dvec2 center(-abc.x / 2.0, -abc.y / 2.0);
  const double square = glm::dot(center, center) - abc.z;
  if (!(square > 0.0)) return std::nullopt;
  return Rim{vec2(center + mean), static_cast<float>(std::sqrt(square)), 0.0f};
}

static float off(const Rim& rim, vec2 point) {
  return length(point - rim.center) - rim.radius;
}

// The circle through three points with the most borders on it, and few outside: dark objects at the rim move borders
// inwards.
static std::optional<Rim> most_supported_circle(const std::vector<vec2>& borders) {
  std::optional<Rim> best;
  int maximum = 0;
  uint32_t state = 1;
  const auto draw = [&] {
    state = state * 1664525u + 1013904223u;
    return borders[(state >> 8) % borders.size()];
  };
  for (int i = 0; i < 400; i++) {
    const std::optional<Rim> rim = fit({draw(), draw(), draw()});
    if (!rim || !(rim->radius < 1e5f)) continue;
    int votes = 0;
    for (const vec2& border : borders) {
      const float away = off(*rim, border) / rim->radius;
      votes += std::abs(away) < kRound ? 1 : away > kRound ? -2 : 0;
    }
    if (votes > maximum) maximum = votes, best = rim;
  }
  return best;
}

// The fraction of the circle inside the image.
static float share_inside(const Image& image, const Rim& rim) {
  int inside = 0;
  for (int i = 0; i < kRays; i++) {
    const float angle = 2.0f * kPi * static_cast<float>(i) / kRays;
    const vec2 at = rim.center + rim.radius * vec2(std::cos(angle), std::sin(angle));
    inside += at.x > 1.0f && at.y > 1.0f && at.x < static_cast<float>(image.width - 1) &&
                      at.y < static_cast<float>(image.height - 1)
                  ? 1
                  : 0;
  }
  return static_cast<float>(inside) / kRays;
}

std::optional<Rim> find_rim(const Image& image) {
  if (image.width < 32 || image.height < 32) return std::nullopt;
  const float dark = dark_level(image);
  if (dark > 0.25f) return std::nullopt;
  const vec2 middle(0.5f * static_cast<float>(image.width), 0.5f * static_cast<float>(image.height));
  std::vector<vec2> borders;
  for (int i = 0; i < kRays; i++) {
    const float angle = 2.0f * kPi * static_cast<float>(i) / kRays;
    if (const auto border = border_on(image, middle, vec2(std::cos(angle), std::sin(angle)), dark)) {
      borders.push_back(*border);
    }
  }
  if (static_cast<float>(borders.size()) < kRays * kMinShare) return std::nullopt;
  std::optional<Rim> rim = most_supported_circle(borders);
  size_t on = 0;
  for (int i = 0; rim && i < 5; i++) {
    std::vector<vec2> near;
    const float width = std::max(0.7f, (i == 0 ? kRound : 0.4f * kRound) * rim->radius);
    for (const vec2& border : borders) {
      if (std::abs(off(*rim, border)) < width) near.push_back(border);
    }
    on = near.size();
    if (static_cast<float>(on) < kRays * kMinShare * 0.5f) return std::nullopt;
    rim = fit(near);
  }
  if (!rim) return std::nullopt;
  const float inside = share_inside(image, *rim);
  const float minimum = 0.3f * static_cast<float>(std::min(image.width, image.height));
  if (rim->radius < minimum || inside < kMinShare) return std::nullopt;
  // The fraction of borders on the circle, out of the circle's part inside the image.
  rim->share = std::min(1.0f, static_cast<float>(on) / (kRays * inside));
  return rim->share > 0.5f ? rim : std::nullopt;
}

}  // namespace ods
