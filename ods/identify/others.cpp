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

namespace {

// The places of one colour that are shifted in another, as fractions of those found in both.
struct Shifted {
  double aside = 0.0;   // all by the same height: cameras need not be level
  double excess = 0.0;  // clearly sideways, more than clearly up or down; 0 if these are only a few places
};

Shifted shifted(const Image& one, const Image& other) {
  constexpr size_t kMin = 16;                                      // places
  constexpr float kAside = 0.9f, kSameHeight = 0.6f, kFar = 2.5f;  // pixels; colour fringes of lenses are narrower
  constexpr float kClear = 1.5f;
  constexpr int kFew = 3;
  const PointPairs pairs = find_pairs(one, other);
  if (pairs.found.size() < kMin) return {};
  std::vector<float> heights;
  for (const PointPair& pair : pairs.found) heights.push_back(pair.right.y - pair.left.y);
  const float height = median(std::move(heights));
  int aside = 0, excess = 0;
  for (const PointPair& pair : pairs.found) {
    const vec2 way = pair.right - pair.left, size = abs(way);
    aside +=
        (size.x > kAside && size.y < kSameHeight) || (length(way) > kFar && std::abs(way.y - height) < kFar) ? 1 : 0;
    if (size.x > kClear && size.y < kSameHeight) excess++;
    if (size.y > kClear && size.x < kSameHeight) excess -= 2;
  }
  const auto found = static_cast<double>(pairs.found.size());
  return {aside / found, excess < kFew ? 0.0 : excess / found};
}

}  // namespace

double anaglyph_mark(const StoredPicture& whole, Extent size) {
  constexpr double kNone = 0.12, kAll = 0.4;
  // A small picture of distant things has parallax at a few places. These are a reason for doubt, not for more.
  constexpr double kNoExcess = 0.009, kAllExcess = 0.011, kDoubt = 0.27;
  const std::vector<Image> colors = color_parts(whole, size);
  const Image red = shown(colors[0]), green = shown(colors[1]), blue = shown(colors[2]);
  double aside = 0.0, excess = 0.0;
  for (const auto& [one, other] : {std::pair{&red, &blue}, {&red, &green}, {&green, &blue}}) {
    const Shifted places = shifted(*one, *other);
    aside = std::max(aside, places.aside), excess = std::max(excess, places.excess);
  }
  return std::max(std::clamp((aside - kNone) / (kAll - kNone), 0.0, 1.0),
                  kDoubt * std::clamp((excess - kNoExcess) / (kAllExcess - kNoExcess), 0.0, 1.0));
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
