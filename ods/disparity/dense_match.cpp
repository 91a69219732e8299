// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/disparity/dense_match.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "ods/base/angles.h"
#include "ods/base/median.h"

namespace ods {

namespace {

constexpr double kHighest = 78.0 * kDegree;
// The search range.
constexpr double kOutwards = 2.0 * kDegree, kInwards = 20.0 * kDegree;
constexpr int kAcross = 4, kDown = 3;  // half size of the transform's window
constexpr int kUnseen = 24;            // cost of a pixel that one eye does not show, out of 62
constexpr int kSlope = 8;              // cost of a step by one pixel between neighbours
constexpr int kJump = 90, kEdge = 30;  // cost of a larger step; at an edge of the picture
constexpr float kDetail = 0.03f;       // minimum difference in a row of the window, out of 0..1
constexpr double kSpeck = 3.0;         // square degrees: smaller isolated patches are mistakes
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

using Cost = int16_t;
constexpr Cost kMax = 4096;  // more than the cost of any path

// The rows of a view that are matched, around the sphere.
struct Band {
  const GrayView& view;
  int top, rows;

  int width() const { return view.width; }
  float at(int x, int y) const {
    const int w = view.width;
    return *view.at(((x % w) + w) % w, std::clamp(top + y, 0, view.height - 1));
  }
  double cosine(int y) const { return std::cos(std::numbers::pi * ((top + y + 0.5) / view.height - 0.5)); }
  int stride(int y) const { return static_cast<int>(std::lround(1.0 / cosine(y))); }
};

// A bit for each pixel of the window that is brighter than its centre; separately, whether the pixel is seen.
struct Census {
  std::vector<uint64_t> bits;
  std::vector<char> seen, detailed;
};

Census census_of(const Band& band) {
  const size_t count = static_cast<size_t>(band.width()) * static_cast<size_t>(band.rows);
  Census census{std::vector<uint64_t>(count), std::vector<char>(count), std::vector<char>(count)};
  tbb::parallel_for(0, band.rows, [&](int y) {
    const int stride = band.stride(y), reach = kAcross * stride, wide = band.width() + 2 * reach;
    std::vector<float> window(static_cast<size_t>((2 * kDown + 1) * wide));
    for (int j = 0; j <= 2 * kDown; j++) {
      for (int i = 0; i < wide; i++) window[static_cast<size_t>(j * wide + i)] = band.at(i - reach, y + j - kDown);
    }
    for (int x = 0; x < band.width(); x++) {
      const float middle = window[static_cast<size_t>(kDown * wide + x + reach)];
      uint64_t bits = 0;
      float maximum = 0.0f;
      for (int j = 0; j <= 2 * kDown; j++) {
        const float* row = &window[static_cast<size_t>(j * wide + x)];
        float low = row[0], high = row[0];
        for (int i = 0; i <= 2 * kAcross; i++) {
          const float value = row[i * stride];
          bits = bits << 1 | (value > middle ? 1u : 0u);
          low = std::min(low, value), high = std::max(high, value);
        }
        maximum = std::max(maximum, high - low);
      }
      const size_t at = static_cast<size_t>(y) * static_cast<size_t>(band.width()) + static_cast<size_t>(x);
      census.bits[at] = bits, census.seen[at] = !std::isnan(middle), census.detailed[at] = maximum > kDetail;
    }
  });
  return census;
}

// The costs of all shifts of all pixels of the left eye, and their sums over the paths.
class Volume {
 public:
  Volume(const Band& left, const Band& right);

  void sum_paths();
  DenseMatch match() const;

 private:
  struct Best {
    float shift = kNone;  // pixels
    int index = -1;
  };
  struct Path;  // the costs at the pixels of one row

  void sum_along_rows(int step);
  void sum_across_rows(int down, int aside);
  int jump(int x, int y, int from_x, int from_y) const;
  Best best_of(const Cost* sums) const;
  std::vector<Best> best_shifts(int eye) const;
  std::vector<float> checked(int eye, const std::vector<Best>& own, const std::vector<Best>& other) const;
  void remove_specks(std::vector<float>& shifts) const;
  std::vector<float> medians(const std::vector<float>& shifts) const;
  Image picture_of(int eye, const std::vector<float>& shifts) const;

  int width() const { return left_.width(); }
  int turned(int x) const { return x < 0 ? x + width() : x >= width() ? x - width() : x; }
  size_t pixel(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width()) + static_cast<size_t>(x);
  }
  size_t cell(int x, int y) const { return pixel(x, y) * static_cast<size_t>(shifts_); }
  double size() const { return 2.0 * std::numbers::pi / width(); }

  const Band left_;
  const int first_shift_, shifts_;  // the first shift, and the number of shifts
  Census own_, other_;
  std::vector<uint8_t> costs_;
  std::vector<Cost> sums_;
};

Volume::Volume(const Band& left, const Band& right)
    : left_(left),
      first_shift_(-static_cast<int>(std::ceil(kOutwards / size()))),
      shifts_((static_cast<int>(std::ceil(kInwards / size())) - first_shift_ + 8) / 8 * 8),
      own_(census_of(left)),
      other_(census_of(right)),
      costs_(own_.bits.size() * static_cast<size_t>(shifts_)),
      sums_(costs_.size()) {
  tbb::parallel_for(0, left.rows, [&](int y) {
    for (int x = 0; x < width(); x++) {
      uint8_t* costs = &costs_[cell(x, y)];
      const uint64_t bits = own_.bits[pixel(x, y)];
      for (int i = 0; i < shifts_; i++) {
        const size_t there = pixel(turned(x - first_shift_ - i), y);
        const bool seen = own_.seen[pixel(x, y)] && other_.seen[there];
        costs[i] = seen ? static_cast<uint8_t>(std::popcount(bits ^ other_.bits[there])) : uint8_t{kUnseen};
      }
    }
  });
}

int Volume::jump(int x, int y, int from_x, int from_y) const {
  const float edge = std::abs(left_.at(x, y) - left_.at(from_x, from_y));
  return edge > 0.0f ? std::max(kEdge, kJump - static_cast<int>(400.0f * std::min(edge, 1.0f))) : kJump;
}

// The costs of a path's last pixel, between two unreachable ones.
struct Volume::Path {
  std::vector<Cost> costs;
  std::vector<Cost> minimum;  // per pixel
  int shifts;

  Path(int count, int n)
      : costs(static_cast<size_t>(count) * static_cast<size_t>(n + 2), kMax),
        minimum(static_cast<size_t>(count), 0),
        shifts(n) {
    for (int x = 0; x < count; x++) std::fill_n(at(x), n, Cost{0});
  }
  Cost* at(int x) { return &costs[static_cast<size_t>(x) * static_cast<size_t>(shifts + 2) + 1]; }

  // Continues from pixel `from` of another path to pixel x of this one.
  void go(int x, Path& other, int from, int jump, const uint8_t* cost, Cost* sums) {
    const Cost* before = other.at(from);
    const Cost base = other.minimum[static_cast<size_t>(from)], far = static_cast<Cost>(base + jump);
    Cost* now = at(x);
    for (int i = 0; i < shifts; i++) {
      const Cost beside = static_cast<Cost>(std::min(before[i - 1], before[i + 1]) + kSlope);
      now[i] = static_cast<Cost>(std::min(std::min(before[i], beside), far) - base + cost[i]);
    }
    for (int i = 0; i < shifts; i++) sums[i] = static_cast<Cost>(sums[i] + now[i]);
    Cost lowest = now[0];
    for (int i = 1; i < shifts; i++) lowest = std::min(lowest, now[i]);
    minimum[static_cast<size_t>(x)] = lowest;
  }
};

void Volume::sum_along_rows(int step) {
  tbb::parallel_for(0, left_.rows, [&](int y) {
    Path path(2, shifts_);
    std::vector<Cost> unused(static_cast<size_t>(shifts_));
    const int before = width() / 16;  // the path is a closed circle and needs a run-up
    int x = step > 0 ? width() - before : before;
    for (int i = 0; i < width() + before; i++, x = turned(x + step)) {
      path.go(i % 2, path, 1 - i % 2, jump(x, y, x - step, y), &costs_[cell(x, y)],
              i < before ? unused.data() : &sums_[cell(x, y)]);
    }
  });
}

void Volume::sum_across_rows(int down, int aside) {
  Path last(width(), shifts_), next(width(), shifts_);
  for (int i = 0; i < left_.rows; i++) {
    const int y = down > 0 ? i : left_.rows - 1 - i;
    tbb::parallel_for(0, width(), [&](int x) {
      next.go(x, last, turned(x - aside), jump(x, y, x - aside, y - down), &costs_[cell(x, y)], &sums_[cell(x, y)]);
    });
    std::swap(last, next);
  }
}

void Volume::sum_paths() {
  for (const int way : {1, -1}) {
    sum_along_rows(way);
    for (const int aside : {-1, 0, 1}) sum_across_rows(way, aside);
  }
}

// The shift whose sum is clearly smaller than all others, except the adjacent ones.
Volume::Best Volume::best_of(const Cost* sums) const {
  Best best;
  Cost minimum = kMax, second = kMax;
  for (int i = 0; i < shifts_; i++) {
    if (sums[i] < minimum) minimum = sums[i], best.index = i;
  }
  for (int i = 0; i < shifts_; i++) {
    if (std::abs(i - best.index) > 1) second = std::min(second, sums[i]);
  }
  if (best.index <= 0 || best.index >= shifts_ - 1 || minimum >= 0.97 * second) return {};
  const double before = sums[best.index - 1], after = sums[best.index + 1];
  const double bend = before + after - 2.0 * minimum;
  best.shift = static_cast<float>(first_shift_ + best.index + (bend > 0.0 ? 0.5 * (before - after) / bend : 0.0));
  return best;
}

// The right eye's pixel x matches the left eye's x + shift.
std::vector<Volume::Best> Volume::best_shifts(int eye) const {
  std::vector<Best> best(own_.bits.size());
  tbb::parallel_for(0, left_.rows, [&](int y) {
    std::vector<Cost> row(static_cast<size_t>(shifts_));
    for (int x = 0; x < width(); x++) {
      const Cost* sums = &sums_[cell(x, y)];
      if (eye == 1) {
        for (int i = 0; i < shifts_; i++) {
          row[static_cast<size_t>(i)] = sums_[cell(turned(x + first_shift_ + i), y) + static_cast<size_t>(i)];
        }
        sums = row.data();
      }
      best[pixel(x, y)] = best_of(sums);
    }
  });
  return best;
}

std::vector<float> Volume::checked(int eye, const std::vector<Best>& own, const std::vector<Best>& other) const {
  const Census& census = eye == 0 ? own_ : other_;
  std::vector<float> shifts(own.size(), kNone);
  for (int y = 0; y < left_.rows; y++) {
    for (int x = 0; x < width(); x++) {
      const Best& there = own[pixel(x, y)];
      if (there.index < 0 || !census.seen[pixel(x, y)]) continue;
      const int moved = static_cast<int>(std::lround(there.shift));
      const Best& back = other[pixel(turned(x + (eye == 0 ? -moved : moved)), y)];
      if (back.index >= 0 && std::abs(back.shift - there.shift) <= 1.0f) shifts[pixel(x, y)] = there.shift;
    }
  }
  return shifts;
}

// Medians of three by three pixels where most are known.
std::vector<float> Volume::medians(const std::vector<float>& shifts) const {
  std::vector<float> smooth = shifts;
  tbb::parallel_for(1, left_.rows - 1, [&](int y) {
    for (int x = 0; x < width(); x++) {
      if (std::isnan(shifts[pixel(x, y)])) continue;
      std::array<float, 9> near{};
      size_t count = 0;
      for (int i = 0; i < 9; i++) {
        const float shift = shifts[pixel(turned(x + i % 3 - 1), y + i / 3 - 1)];
        if (!std::isnan(shift)) near[count++] = shift;
      }
      std::nth_element(near.begin(), near.begin() + count / 2, near.begin() + count);
      smooth[pixel(x, y)] = near[count / 2];
    }
  });
  return smooth;
}

void Volume::remove_specks(std::vector<float>& shifts) const {
  std::vector<char> done(shifts.size());
  std::vector<std::pair<int, int>> patch;
  for (int y0 = 0; y0 < left_.rows; y0++) {
    for (int x0 = 0; x0 < width(); x0++) {
      if (done[pixel(x0, y0)] || std::isnan(shifts[pixel(x0, y0)])) continue;
      patch.assign(1, {x0, y0}), done[pixel(x0, y0)] = 1;
      double area = 0.0;
      for (size_t i = 0; i < patch.size(); i++) {
        const auto [x, y] = patch[i];
        area += left_.cosine(y) * std::pow(size() / kDegree, 2);
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (y + dy < 0 || y + dy >= left_.rows) continue;
          const size_t at = pixel(turned(x + dx), y + dy);
          if (done[at] || !(std::abs(shifts[at] - shifts[pixel(x, y)]) <= 1.0f)) continue;
          done[at] = 1, patch.push_back({turned(x + dx), y + dy});
        }
      }
      if (area >= kSpeck) continue;
      for (const auto& [x, y] : patch) shifts[pixel(x, y)] = kNone;
    }
  }
}

Image Volume::picture_of(int eye, const std::vector<float>& shifts) const {
  Image around(width(), left_.view.height, 1);
  std::ranges::fill(around.pixels, kNone);
  const Census& census = eye == 0 ? own_ : other_;
  for (int y = 0; y < left_.rows; y++) {
    for (int x = 0; x < width(); x++) {
      const size_t at = pixel(x, y);
      if (census.detailed[at]) *around.at(x, left_.top + y) = static_cast<float>(size()) * shifts[at];
    }
  }
  return around;
}

DenseMatch Volume::match() const {
  DenseMatch match;
  const std::array<std::vector<Best>, 2> best = {best_shifts(0), best_shifts(1)};
  for (size_t eye = 0; eye < 2; eye++) {
    std::vector<float> shifts = checked(static_cast<int>(eye), best[eye], best[1 - eye]);
    remove_specks(shifts);
    match.around[eye] = picture_of(static_cast<int>(eye), medians(shifts));
  }
  double shown = 0.0, found = 0.0;
  std::vector<double> apart;
  for (int y = 0; y < left_.view.height; y++) {
    const double cosine = Band{left_.view, 0, 0}.cosine(y);
    for (int x = 0; x < width(); x++) {
      if (std::isnan(*left_.view.at(x, y))) continue;
      shown += cosine;
      const float around = *match.around[0].at(x, y);
      if (std::isnan(around)) continue;
      found += cosine;
      const float back = *match.around[1].at(turned(x - static_cast<int>(std::lround(around / size()))), y);
      if (!std::isnan(back)) apart.push_back(std::abs(double{around} - double{back}) * cosine);
    }
  }
  match.share = shown > 0.0 ? found / shown : 0.0;
  match.precision = std::max(0.15 * size(), apart.empty() ? 0.0 : 1.48 * median(std::move(apart)));
  return match;
}

}  // namespace

DenseMatch match_densely(const GrayView& left, const GrayView& right) {
  const int height = left.height;
  const int top = static_cast<int>(std::ceil((0.5 - kHighest / std::numbers::pi) * height));
  Volume volume(Band{left, top, height - 2 * top}, Band{right, top, height - 2 * top});
  volume.sum_paths();
  return volume.match();
}

}  // namespace ods
