// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/sharpen.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

namespace ods {

namespace {

constexpr float kStep = 0.15f;        // of the nearer side: what lies between it and the farther one is no edge
constexpr float kOwn = 0.12f;         // of the step: so near to a side, a pixel belongs to it
constexpr float kSteep = 0.015f;      // of the step: from a pixel of a ramp to the next
constexpr float kStraight = 1.4f;     // a slope goes on beyond the window; a ramp ends in it
constexpr float kUndecided = 400.0f;  // of the squared distance of colours (0..255): where the ramp's middle decides
constexpr int kLooks = 4;             // pixels that are looked at, from a pixel to the window's edge

struct Span {
  float low = 1e30f, high = -1e30f;
  void add(const Span& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
  float step() const { return high - low; }
};

// The least and the largest of squares of the picture.
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

  // Of the square around a tile that reaches so many tiles beyond it.
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

  // Between a step's sides, and changing steadily: its neighbours to both sides differ by a part of the step.
  bool is_on_ramp(int x, int y, const Span& span) const {
    const float own = value(x, y), step = span.step();
    if (own < span.low + kSteep * step || own > span.high - kSteep * step) return false;
    const auto climbs = [&](float before, float after) {
      const float first = own - before, second = after - own;
      return first * second > 0.0f && std::min(std::abs(first), std::abs(second)) > kSteep * step;
    };
    return climbs(value(x - 1, y), value(x + 1, y)) || climbs(value(x, y - 1), value(x, y + 1));
  }

  // The side of the step to which a pixel belongs.
  float side_of(int x, int y, const Span& span) const {
    Side near, far;
    const int hop = std::max(radius_ / kLooks, 1), reach = kLooks * hop;
    for (int j = -reach; j <= reach; j += hop) {
      for (int i = -reach; i <= reach; i += hop) {
        const float there = value(x + i, y + j);
        const float weight = 1.0f / static_cast<float>(i * i + j * j + hop * hop);
        if (there > span.high - kOwn * span.step()) near.add(weight, there, color(x + i, y + j));
        if (there < span.low + kOwn * span.step()) far.add(weight, there, color(x + i, y + j));
      }
    }
    const float own = value(x, y);
    if (near.weight == 0.0f || far.weight == 0.0f) return own;
    const float share = (own - span.low) / span.step() - 0.5f;
    const float sooner = far.distance(color(x, y)) - near.distance(color(x, y)) + 2.0f * share * kUndecided;
    return sooner > 0.0f ? near.depth / near.weight : far.depth / far.weight;
  }

 private:
  struct Side {
    float weight = 0.0f, depth = 0.0f, color[3] = {};
    void add(float share, float value, const uint8_t* rgb) {
      weight += share, depth += share * value;
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

int64_t sharpen_edges(Image& nearness, const GuideImage& guide, int radius, bool wraps) {
  assert(guide.width == nearness.width && guide.height == nearness.height);
  const Image old = nearness;
  const Tiles tiles(old, radius, wraps);
  const Sharpener sharpener(old, guide, radius, wraps);
  std::atomic<int64_t> changed = 0;
  tbb::parallel_for(0, old.height, [&](int y) {
    int64_t count = 0;
    Span close, wide;
    for (int x = 0; x < old.width; x++) {
      if (x % radius == 0) close = tiles.around(x, y, 1), wide = tiles.around(x, y, 2);
      if (close.step() < kStep * close.high || wide.step() > kStraight * close.step()) continue;
      if (!sharpener.is_on_ramp(x, y, close)) continue;
      float& value = *nearness.at(x, y);
      const float side = sharpener.side_of(x, y, close);
      count += side != value;
      value = side;
    }
    changed += count;
  });
  return changed;
}

}  // namespace ods
