// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/others.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ods/base/median.h"
#include "ods/camera/pixel.h"
#include "ods/camera/projection.h"
#include "ods/identify/pairs.h"

namespace ods {

// --- anaglyphs -------------------------------------------------------------------------------------------------------

// Fraction of the places of one part that are shifted sideways in the other, all by the same height: cameras need not
// be level.
static double aside(const Image& one, const Image& other) {
  constexpr size_t kMin = 16;                                 // places
  constexpr float kAside = 0.9f, kLevel = 0.6f, kFar = 2.5f;  // pixels; colour fringes of lenses are narrower
  const PointPairs pairs = find_pairs(one, other);
  if (pairs.found.size() < kMin) return 0.0;
  std::vector<float> heights;
  for (const PointPair& pair : pairs.found) heights.push_back(pair.right.y - pair.left.y);
  const float height = median(std::move(heights));
  const auto moved = std::count_if(pairs.found.begin(), pairs.found.end(), [&](const PointPair& pair) {
    const vec2 way = pair.right - pair.left;
    const bool is_level = std::abs(way.x) > kAside && std::abs(way.y) < kLevel;
    return is_level || (length(way) > kFar && std::abs(way.y - height) < kFar);
  });
  return static_cast<double>(moved) / static_cast<double>(pairs.found.size());
}

double anaglyph_mark(const StoredPicture& whole, Extent size) {
  constexpr double kNone = 0.12, kAll = 0.4;
  const std::vector<Image> colors = color_parts(whole, size);
  const Image red = shown(colors[0]), green = shown(colors[1]), blue = shown(colors[2]);
  const double maximum = std::max({aside(red, blue), aside(red, green), aside(green, blue)});
  return std::clamp((maximum - kNone) / (kAll - kNone), 0.0, 1.0);
}

// --- cubes whose Y is up ---------------------------------------------------------------------------------------------

namespace {

// Fraction of the variance that bands of equal height explain, 0..1, with one of the axes up.
class Bands {
 public:
  void add(double height, double value) {
    Sums& band = bands_[std::min(static_cast<size_t>(0.5 * (height + 1.0) * kBands), kBands - 1)];
    for (Sums* sums : {&band, &all_}) sums->count += 1.0, sums->sum += value, sums->square += value * value;
  }
  double explained() const {
    double within = 0.0;
    for (const Sums& band : bands_) within += band.spread();
    return all_.spread() > 1e-9 ? 1.0 - within / all_.spread() : 0.0;
  }

 private:
  struct Sums {
    double count = 0.0, sum = 0.0, square = 0.0;
    double spread() const { return count > 0.0 ? square - sum * sum / count : 0.0; }
  };
  static constexpr size_t kBands = 16;
  std::array<Sums, kBands> bands_;
  Sums all_;
};

}  // namespace

double y_up_mark(const Image& eye, const ProjectionSetting& cube) {
  const Projection projection = make_projection(cube);
  std::array<Bands, 3> light, detail;
  const int step = std::max(1, std::min(eye.width, eye.height) / 128);
  for (int y = step; y < eye.height - step; y += step) {
    for (int x = step; x < eye.width - step; x += step) {
      const vec2 place = pixel_middle(x, y, eye);
      const vec3 direction = normalize(look_of(projection, place, place).direction);
      const double here = static_cast<double>(*eye.at(x, y));
      const double change = std::abs(static_cast<double>(*eye.at(x + step, y)) - here) +
                            std::abs(static_cast<double>(*eye.at(x, y + step)) - here);
      for (int axis = 0; axis < 3; axis++) {
        light[static_cast<size_t>(axis)].add(static_cast<double>(direction[axis]), here);
        detail[static_cast<size_t>(axis)].add(static_cast<double>(direction[axis]), std::sqrt(change));
      }
    }
  }
  const auto about = [&](size_t axis) { return light[axis].explained() + detail[axis].explained(); };
  return std::clamp(4.0 * (about(2) - about(1)), -1.0, 1.0);
}

}  // namespace ods
