// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/sharpen.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <optional>

namespace ods {

namespace {

constexpr float kStep = 0.15f;        // minimum height of an edge, relative to the closer side
constexpr float kOwn = 0.12f;         // relative to the step: a pixel this close to a side belongs to it
constexpr float kFlat = 0.12f;        // relative to a ramp's largest rise between pixels: it ends at a smaller rise
constexpr float kJump = 0.6f;         // relative to the step: a larger rise is an edge that is already sharp
constexpr float kLoneJump = 0.75f;    // kJump if only one pixel is between the sides
constexpr float kUndecided = 400.0f;  // squared distance of colours (0..255) below which the ramp's middle decides
constexpr int kLooks = 4;             // number of pixels examined between a pixel and the window's edge

struct Span {
  float low = 1e30f, high = -1e30f;
  void add(const Span& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
  float step() const { return high - low; }
};

// Minima and maxima in squares of the picture.
class Tiles {
 public:
  Tiles(const Image& image, int side, bool wraps)
      : columns_((image.width + side - 1) / side), rows_((image.height + side - 1) / side), side_(side), wraps_(wraps) {
    spans_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
    tbb::parallel_for(0, rows_, [&](int row) {
      for (int y = row * side; y < std::min((row + 1) * side, image.height); y++) {
        for (int x = 0; x < image.width; x++) {
          const float value = *image.at(x, y);
          at(x / side, row).add({value, value});
        }
      }
    });
  }

  // The range in the square that extends this many tiles beyond a tile.
  Span around(int x, int y, int reach) const {
    Span span;
    for (int row = std::max(y / side_ - reach, 0); row <= std::min(y / side_ + reach, rows_ - 1); row++) {
      for (int i = -reach; i <= reach; i++) {
        const int column = x / side_ + i;
        const int inside = wraps_ ? (column + columns_) % columns_ : std::clamp(column, 0, columns_ - 1);
        span.add(const_cast<Tiles*>(this)->at(inside, row));
      }
    }
    return span;
  }

 private:
  Span& at(int column, int row) {
    return spans_[static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column)];
  }
  int columns_, rows_, side_;
  bool wraps_;
  std::vector<Span> spans_;
};

class Sharpener {
 public:
  Sharpener(const Image& old, const GuideImage& guide, int radius, bool wraps)
      : old_(old), guide_(guide), radius_(radius), wraps_(wraps) {}

  // The two sides of the ramp that contains a pixel: the values change steadily towards both, and the ramp ends at
  // both. Floors and walls that extend into the distance do not end.
  std::optional<Span> ramp_at(int x, int y) const {
    const float across = value(x + 1, y) - value(x - 1, y), down = value(x, y + 1) - value(x, y - 1);
    const bool is_across = std::abs(across) >= std::abs(down);
    const int sign = (is_across ? across : down) < 0.0f ? -1 : 1, dx = is_across ? sign : 0, dy = is_across ? 0 : sign;
    const float own = value(x, y), above = value(x + dx, y + dy) - own, below = own - value(x - dx, y - dy);
    Climb climb{std::max(above, below), 0};
    if (!(std::min(above, below) > kFlat * climb.largest)) return std::nullopt;
    Span span;
    if (!end_of(x, y, dx, dy, climb, span.high) || !end_of(x, y, -dx, -dy, climb, span.low)) return std::nullopt;
    const float step = span.step();
    const float jump = climb.count > 2 ? kJump : kLoneJump;
    if (step < kStep * span.high || climb.largest > jump * step) return std::nullopt;
    return span;
  }

  // The side of a ramp that a pixel belongs to.
  float side_of(int x, int y, const Span& span) const {
    Side near, far;
    const int hop = std::max(radius_ / kLooks, 1), reach = kLooks * hop;
    for (int j = -reach; j <= reach; j += hop) {
      for (int i = -reach; i <= reach; i += hop) {
        const float there = value(x + i, y + j);
        const float weight = 1.0f / static_cast<float>(i * i + j * j + hop * hop);
        if (std::abs(there - span.high) < kOwn * span.step()) near.add(weight, color(x + i, y + j));
        if (std::abs(there - span.low) < kOwn * span.step()) far.add(weight, color(x + i, y + j));
      }
    }
    const float share = (value(x, y) - span.low) / span.step() - 0.5f;
    if (near.weight == 0.0f || far.weight == 0.0f) return share > 0.0f ? span.high : span.low;
    const float sooner = far.distance(color(x, y)) - near.distance(color(x, y)) + 2.0f * share * kUndecided;
    return sooner > 0.0f ? span.high : span.low;
  }

 private:
  struct Side {
    float weight = 0.0f, color[3] = {};
    void add(float share, const uint8_t* rgb) {
      weight += share;
      for (int c = 0; c < 3; c++) color[c] += share * static_cast<float>(rgb[c]);
    }
    float distance(const uint8_t* rgb) const {
      float sum = 0.0f;
      for (int c = 0; c < 3; c++) {
        const float off = static_cast<float>(rgb[c]) - color[c] / weight;
        sum += off * off;
      }
      return sum;
    }
  };

  struct Climb {
    float largest;  // largest rise between pixels
    int count;      // number of rises
  };

  // Follows the ramp to its end. Returns false if it is too long.
  bool end_of(int x, int y, int dx, int dy, Climb& climb, float& end) const {
    const float sign = value(x + dx, y + dy) < value(x, y) ? -1.0f : 1.0f;
    end = value(x, y);
    for (int i = 1; i <= 2 * radius_; i++) {
      const float next = value(x + i * dx, y + i * dy), rise = sign * (next - end);
      if (rise < kFlat * climb.largest) return true;
      climb.largest = std::max(climb.largest, rise), climb.count++;
      end = next;
    }
    return false;
  }

  int column(int x) const { return wraps_ ? (x + old_.width) % old_.width : std::clamp(x, 0, old_.width - 1); }
  int row(int y) const { return std::clamp(y, 0, old_.height - 1); }
  float value(int x, int y) const { return *old_.at(column(x), row(y)); }
  const uint8_t* color(int x, int y) const { return guide_.at(column(x), row(y)); }

  const Image& old_;
  const GuideImage& guide_;
  int radius_;
  bool wraps_;
};

}  // namespace

// With noisy colours the sides of single pixels are noisy, too, so each takes the side of most pixels around it.
static float majority_side(const Image& chosen, const Image& old, int x, int y, const Span& ramp, int radius,
                           bool wraps) {
  const int hop = std::max(radius / 8, 1);
  int near = 0, all = 0;
  for (int j = -2 * hop; j <= 2 * hop; j += hop) {
    for (int i = -2 * hop; i <= 2 * hop; i += hop) {
      const int column = wraps ? (x + i + old.width) % old.width : std::clamp(x + i, 0, old.width - 1);
      near += *chosen.at(column, std::clamp(y + j, 0, old.height - 1)) > 0.5f * (ramp.low + ramp.high);
      all++;
    }
  }
  return 2 * near > all ? ramp.high : ramp.low;
}

int64_t sharpen_edges(Image& nearness, const GuideImage& guide, int radius, bool wraps) {
  assert(guide.width == nearness.width && guide.height == nearness.height);
  const Image old = nearness;
  const Tiles tiles(old, radius, wraps);
  const Sharpener sharpener(old, guide, radius, wraps);
  std::atomic<int64_t> changed = 0;
  const auto each_ramp = [&](const auto& choose) {
    tbb::parallel_for(0, old.height, [&](int y) {
      Span around;
      for (int x = 0; x < old.width; x++) {
        if (x % radius == 0) around = tiles.around(x, y, 1);
        if (around.step() < kStep * around.high) continue;
        if (const std::optional<Span> ramp = sharpener.ramp_at(x, y)) choose(x, y, *ramp);
      }
    });
  };
  each_ramp([&](int x, int y, const Span& ramp) { *nearness.at(x, y) = sharpener.side_of(x, y, ramp); });
  const Image chosen = nearness;
  each_ramp([&](int x, int y, const Span& ramp) {
    *nearness.at(x, y) = majority_side(chosen, old, x, y, ramp, radius, wraps);
    changed++;
  });
  return changed;
}

}  // namespace ods
