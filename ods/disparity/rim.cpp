// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/disparity/rim.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ods/base/median.h"
#include "ods/image/block_means.h"

namespace ods {

constexpr int kRays = 720;
constexpr float kMinShare = 0.2f;   // minimum fraction of the circle
constexpr float kMinFound = 0.4f;   // minimum fraction of that where a border is found
constexpr float kRound = 0.012f;    // relative to the radius: maximum distance of a border from the circle
constexpr float kMinRadius = 0.3f;  // relative to the shorter side
constexpr float kMinDrop = 0.025f;  // from the picture to its surround, as displayed

static float sample(const Image& image, vec2 at) {
  const float x = std::clamp(at.x - 0.5f, 0.0f, static_cast<float>(image.width - 1));
  const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(image.height - 1));
  const int x0 = std::min(static_cast<int>(x), image.width - 2), y0 = std::min(static_cast<int>(y), image.height - 2);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const float top = std::lerp(*image.at(x0, y0), *image.at(x0 + 1, y0), fx);
  return std::lerp(top, std::lerp(*image.at(x0, y0 + 1), *image.at(x0 + 1, y0 + 1), fx), fy);
}

static bool is_in(const Image& image, vec2 at) {
  return at.x > 0.5f && at.y > 0.5f && at.x < static_cast<float>(image.width) - 0.5f &&
         at.y < static_cast<float>(image.height) - 0.5f;
}

// --- a first circle --------------------------------------------------------------------------------------------------

// The mean drop of brightness across a circle, outwards, and more the longer its part in the image. A bright light
// counts no more than any other drop, and a glow around the circle, which fades slowly, hardly at all.
// Source: J. Daugman, "How Iris Recognition Works", the integro-differential operator.
static float drop_across(const Image& image, const Rim& rim) {
  constexpr int kPlaces = 96;
  constexpr float kMaxDrop = 0.08f;
  const float step = std::max(1.5f, 0.02f * rim.radius);
  float sum = 0.0f;
  int inside = 0;
  for (int i = 0; i < kPlaces; i++) {
    const float angle = 2.0f * kPi * static_cast<float>(i) / kPlaces;
    const vec2 way(std::cos(angle), std::sin(angle));
    const vec2 out = rim.center + (rim.radius + step) * way;
    if (!is_in(image, out)) continue;
    inside++;
    sum += std::clamp(sample(image, rim.center + (rim.radius - step) * way) - sample(image, out), -kMaxDrop, kMaxDrop);
  }
  if (static_cast<float>(inside) < kMinShare * kPlaces) return 0.0f;
  return sum / std::sqrt(static_cast<float>(kPlaces * inside));
}

// The circle of the largest drop: all centres near the middle and all radii in a small image, then smaller steps.
static Rim rough_rim(const Image& image) {
  const vec2 size(static_cast<float>(image.width), static_cast<float>(image.height));
  const float min_radius = kMinRadius * std::min(size.x, size.y), max_radius = 0.6f * length(size), far = 0.25f;
  Rim best;
  float largest = 0.0f;
  const auto attempt = [&](const Rim& rim) {
    const float drop = drop_across(image, rim);
    if (drop > largest) largest = drop, best = rim;
  };
  for (float y = (0.5f - far) * size.y; y <= (0.5f + far) * size.y; y += 2.0f) {
    for (float x = (0.5f - far) * size.x; x <= (0.5f + far) * size.x; x += 2.0f) {
      for (float radius = min_radius; radius <= max_radius; radius += 1.0f) attempt({vec2(x, y), radius});
    }
  }
  for (float step = 1.0f; step > 0.1f; step *= 0.5f) {
    for (int round = 0; round < 3; round++) {
      const Rim from = best;
      for (int i = 0; i < 27; i++) {
        const vec3 by = step * vec3(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                                    static_cast<float>(i / 9 - 1));
        attempt({from.center + vec2(by.x, by.y), from.radius + by.z});
      }
    }
  }
  return best;
}

// --- its exact place -------------------------------------------------------------------------------------------------

// The mean of a stretch of a ray.
static float mean_on(const Image& image, vec2 from, vec2 way, float start, float end) {
  constexpr int kSteps = 6;
  float sum = 0.0f;
  for (int i = 0; i < kSteps; i++) {
    sum += sample(image, from + way * std::lerp(start, end, (static_cast<float>(i) + 0.5f) / kSteps));
  }
  return sum / kSteps;
}

// The point on a ray near the circle where the image drops most: first over a stretch that averages noise out, then
// over a pixel. Returns nullopt if it does not drop there, or leaves the image.
static std::optional<vec2> border_on(const Image& image, const Rim& rim, vec2 way, float reach) {
  const float wide = std::max(1.0f, 0.015f * rim.radius);
  if (!is_in(image, rim.center + way * (rim.radius + 0.5f))) return std::nullopt;
  float largest = kMinDrop, at = 0.0f;
  for (float t = rim.radius - reach; t <= rim.radius + reach; t += 0.5f) {
    if (!is_in(image, rim.center + way * (t + 0.5f))) break;
    const float drop = mean_on(image, rim.center, way, t - wide, t) - mean_on(image, rim.center, way, t, t + wide);
    if (drop > largest) largest = drop, at = t;
  }
  if (at <= 0.0f) return std::nullopt;
  float steepest = 0.0f, best = at;
  for (float t = at - 0.5f * wide - 1.0f; t <= at + 0.5f * wide + 1.0f; t += 0.1f) {
    const float slope =
        std::abs(sample(image, rim.center + way * (t - 0.5f)) - sample(image, rim.center + way * (t + 0.5f)));
    if (slope > steepest) steepest = slope, best = t;
  }
  return rim.center + way * best;
}

static std::vector<vec2> borders_near(const Image& image, const Rim& rim, float reach) {
  std::vector<vec2> borders;
  for (int i = 0; i < kRays; i++) {
    const float angle = 2.0f * kPi * static_cast<float>(i) / kRays;
    if (const auto border = border_on(image, rim, vec2(std::cos(angle), std::sin(angle)), reach))
      borders.push_back(*border);
  }
  return borders;
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
  return Rim{vec2(center + mean), static_cast<float>(std::sqrt(square))};
}

static float off(const Rim& rim, vec2 point) {
  return length(point - rim.center) - rim.radius;
}

// The fraction of the circle inside the image.
static float share_inside(const Image& image, const Rim& rim) {
  int inside = 0;
  for (int i = 0; i < kRays; i++) {
    const float angle = 2.0f * kPi * static_cast<float>(i) / kRays;
    const vec2 at = rim.center + rim.radius * vec2(std::cos(angle), std::sin(angle));
    inside += is_in(image, at) ? 1 : 0;
  }
  return static_cast<float>(inside) / kRays;
}

// The brightness around the circle, if that is a sensor without light, or with a glow: darker than the picture, and
// smooth but for noise and a few flares.
static std::optional<float> dark_level_around(const Image& image, const Rim& rim) {
  constexpr int kBands = 12;
  constexpr float kClear = 1.03f, kBandWidth = 0.04f;  // of the radius
  constexpr float kMaxLevel = 0.35f, kEven = 0.07f, kMostly = 0.8f;
  std::vector<float> levels[kBands], within;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const float r =
          length(vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) - rim.center) / rim.radius;
      if (r > 0.8f && r < 0.95f) within.push_back(*image.at(x, y));
      if (r < kClear) continue;
      const int band = std::min(static_cast<int>((r - kClear) / kBandWidth), kBands - 1);
      levels[band].push_back(*image.at(x, y));
    }
  }
  size_t count = 0, even = 0;
  double sum = 0.0;
  for (const std::vector<float>& band : levels) {
    if (band.empty()) continue;
    const float middle = median(band);
    for (const float level : band) even += std::abs(level - middle) < kEven ? 1 : 0;
    count += band.size(), sum += static_cast<double>(middle) * static_cast<double>(band.size());
  }
  if (count == 0) return std::nullopt;
  const float around = static_cast<float>(sum / static_cast<double>(count));
  const bool is_dark = around < kMaxLevel && around + kMinDrop < median(within);
  const bool is_even = static_cast<double>(even) > static_cast<double>(kMostly) * static_cast<double>(count);
  return is_dark && is_even ? std::optional(around) : std::nullopt;
}

std::optional<Rim> find_rim(const Image& image) {
  constexpr int kSmall = 96;  // pixels
  const int shorter = std::min(image.width, image.height);
  if (shorter < 32) return std::nullopt;
  const int by = std::max(1, shorter / kSmall);
  Rim rim = rough_rim(block_means(image, by));
  if (rim.radius <= 0.0f) return std::nullopt;
  rim.center *= static_cast<float>(by), rim.radius *= static_cast<float>(by);
  size_t on = 0;
  for (int i = 0; i < 8; i++) {
    const float reach = std::max(2.0f, (i < 2 ? 5.0f : i < 4 ? 2.0f : 1.0f) * kRound * rim.radius);
    const float width = i < 4 ? 0.8f * reach : std::max(0.7f, 0.4f * reach);
    std::vector<vec2> near;
    for (const vec2& border : borders_near(image, rim, reach)) {
      if (std::abs(off(rim, border)) < width) near.push_back(border);
    }
    on = near.size();
    if (static_cast<float>(on) < kRays * kMinShare * 0.5f) return std::nullopt;
    const std::optional<Rim> fitted = fit(near);
    if (!fitted) return std::nullopt;
    rim = *fitted;
  }
  const float inside = share_inside(image, rim);
  if (rim.radius < kMinRadius * static_cast<float>(shorter) || inside < kMinShare) return std::nullopt;
  // The fraction of borders on the circle, out of the circle's part inside the image.
  rim.share = std::min(1.0f, static_cast<float>(on) / (kRays * inside));
  const std::optional<float> around = dark_level_around(image, rim);
  if (rim.share <= kMinFound || !around) return std::nullopt;
  rim.around = *around;
  return rim;
}

}  // namespace ods
