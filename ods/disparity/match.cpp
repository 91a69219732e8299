// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/disparity/match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ods {

namespace {

// Minimum standard deviation of a tile with enough detail. One step of 8 bits is 0.004.
constexpr double kMinDetail = 0.015;

// A tile is ambiguous if a second peak, not adjacent to the first, is less than this below it.
constexpr double kPeakLead = 0.04;

struct Tile {
  int x, y;  // the tile's first pixel
  int columns, rows;
};

struct Found {
  double x = 0.0, y = 0.0;  // the tile's displacement
  double correlation = -1.0;
};

// A view that continues beyond its edges, with sums over any rectangle of it.
class Sums {
 public:
  explicit Sums(const GrayView& view) : width_(3 * view.width), row_(static_cast<size_t>(width_) + 1) {
    const size_t rows = static_cast<size_t>(view.height);
    values.resize(rows * static_cast<size_t>(width_));
    table_.resize((rows + 1) * row_);
    for (int y = 0; y < view.height; y++) {
      Sum line;
      for (int x = 0; x < width_; x++) {
        const float value = *view.at(x % view.width, y);
        const bool seen = !std::isnan(value);
        values[index(x, y)] = seen ? value : 0.0f;
        if (seen) line.value += static_cast<double>(value), line.square += static_cast<double>(value * value);
        line.unseen += seen ? 0 : 1;
        table_[entry(x + 1, y + 1)] = plus(line, table_[entry(x + 1, y)]);
      }
    }
  }

  struct Sum {
    double value = 0.0;
    double square = 0.0;
    int unseen = 0;
  };

  // x may be from one full turn left of the picture to one full turn right of it.
  Sum over(int x, int y, int columns, int rows) const {
    const Sum &a = table_[entry(x, y)], &b = table_[entry(x + columns, y)], &c = table_[entry(x, y + rows)],
              &d = table_[entry(x + columns, y + rows)];
    return {d.value - b.value - c.value + a.value, d.square - b.square - c.square + a.square,
            d.unseen - b.unseen - c.unseen + a.unseen};
  }

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  std::vector<float> values;

 private:
  size_t entry(int x, int y) const { return static_cast<size_t>(y) * row_ + static_cast<size_t>(x); }
  static Sum plus(const Sum& a, const Sum& b) { return {a.value + b.value, a.square + b.square, a.unseen + b.unseen}; }

  int width_;
  size_t row_;
  std::vector<Sum> table_;
};

class Matcher {
 public:
  Matcher(const GrayView& from, const Sums& from_sums, const Sums& to_sums, int reach_x, int reach_y)
      : view_(from), from_(from_sums), to_(to_sums), reach_x_(reach_x), reach_y_(reach_y) {}

  // Selects a tile. Returns false if it has no detail or no picture.
  bool take(const Tile& tile) {
    tile_ = tile;
    const double n = count();
    const Sums::Sum sum = from_.over(turned(tile.x), tile.y, tile.columns, tile.rows);
    const double square = sum.square - sum.value * sum.value / n;
    if (sum.unseen > 0 || square < kMinDetail * kMinDetail * n) return false;
    const float mean = static_cast<float>(sum.value / n), scale = static_cast<float>(1.0 / std::sqrt(square));
    pattern_.clear();
    for (int y = 0; y < tile.rows; y++) {
      const float* row = &from_.values[from_.index(turned(tile.x), tile.y + y)];
      for (int x = 0; x < tile.columns; x++) pattern_.push_back((row[x] - mean) * scale);
    }
    return true;
  }

  std::optional<Found> find() {
    profile_.assign(static_cast<size_t>(2 * reach_x_ + 1), Found{});
    for (int y = -reach_y_; y <= reach_y_; y++) {
      if (tile_.y + y < 0 || tile_.y + y + tile_.rows > view_.height) continue;
      for (int x = -reach_x_; x <= reach_x_; x++) {
        const double correlation = correlate(tile_.x + x, tile_.y + y);
        Found& best = profile_[static_cast<size_t>(x + reach_x_)];
        if (correlation > best.correlation) best = {double(x), double(y), correlation};
      }
    }
    const auto best = std::max_element(profile_.begin(), profile_.end(),
                                       [](const Found& a, const Found& b) { return a.correlation < b.correlation; });
    if (best == profile_.begin() || best == profile_.end() - 1 || is_ambiguous(*best)) return {};
    Found found = *best;
    found.x += peak((best - 1)->correlation, best->correlation, (best + 1)->correlation);
    found.y += peak_down(*best);
    return found;
  }

 private:
  double count() const { return static_cast<double>(tile_.columns) * tile_.rows; }

  // One full turn to the right, where the sums have columns on both sides.
  int turned(int x) const { return x + view_.width; }

  // Returns -1 if the other picture is empty or flat there.
  double correlate(int x, int y) const {
    const Sums::Sum sum = to_.over(turned(x), y, tile_.columns, tile_.rows);
    const double spread = sum.square - sum.value * sum.value / count();
    if (sum.unseen > 0 || spread < 0.25 * kMinDetail * kMinDetail * count()) return -1.0;
    float product = 0.0f;
    const float* pattern = pattern_.data();
    for (int j = 0; j < tile_.rows; j++, pattern += tile_.columns) {
      const float* row = &to_.values[to_.index(turned(x), y + j)];
      float lanes[4] = {};  // independent sums, so that additions need not wait for each other
      int i = 0;
      for (; i + 4 <= tile_.columns; i += 4) {
        for (int lane = 0; lane < 4; lane++) lanes[lane] += pattern[i + lane] * row[i + lane];
      }
      for (; i < tile_.columns; i++) lanes[0] += pattern[i] * row[i];
      product += (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
    }
    return static_cast<double>(product) / std::sqrt(spread);
  }

  bool is_ambiguous(const Found& best) const {
    const double beside = std::max(2.0, 0.25 * tile_.columns);
    return std::any_of(profile_.begin(), profile_.end(), [&](const Found& other) {
      return std::abs(other.x - best.x) > beside && other.correlation > best.correlation - kPeakLead;
    });
  }

  // The peak of the parabola through three values.
  static double peak(double before, double at, double after) {
    const double bend = before - 2.0 * at + after;
    return bend < 0.0 && before > -1.0 && after > -1.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  }

  double peak_down(const Found& best) const {
    const int x = tile_.x + static_cast<int>(best.x), y = tile_.y + static_cast<int>(best.y);
    if (y < 1 || y + tile_.rows + 1 > view_.height) return 0.0;
    return peak(correlate(x, y - 1), best.correlation, correlate(x, y + 1));
  }

  const GrayView& view_;
  const Sums& from_;
  const Sums& to_;
  int reach_x_, reach_y_;
  Tile tile_{};
  std::vector<float> pattern_;
  std::vector<Found> profile_;  // the best vertical shift for each shift along the row
};

}  // namespace

Matches match_tiles(const GrayView& left, const GrayView& right, const Search& search) {
  Matches matches;
  matches.pixel = static_cast<float>(2.0 * std::numbers::pi / left.width);
  const int reach_x = std::min(static_cast<int>(std::ceil(search.around / matches.pixel)), left.width / 2 - 1);
  const int reach_y = static_cast<int>(std::ceil(search.down / matches.pixel));
  const Sums left_sums(left), right_sums(right);
  Matcher there(left, left_sums, right_sums, reach_x, reach_y), back(right, right_sums, left_sums, reach_x, reach_y);
  for (int y = 0; y + search.rows <= left.height; y += search.step) {
    const float phi = matches.pixel * (0.5f * static_cast<float>(left.height - search.rows) - static_cast<float>(y));
    if (phi < search.lowest || phi > search.highest) continue;
    const int columns = std::min(static_cast<int>(static_cast<float>(search.columns) / std::cos(phi)), left.width / 2);
    for (int x = 0; x + columns <= left.width; x += columns) {
      if (!back.take({x, y, columns, search.rows}) || !there.take({x, y, columns, search.rows})) continue;
      matches.tiles++;
      const std::optional<Found> found = there.find();
      if (!found || found->correlation < static_cast<double>(search.correlation)) continue;
      const int moved_x = static_cast<int>(std::lround(found->x)), moved_y = static_cast<int>(std::lround(found->y));
      const int home = (x + moved_x + left.width) % left.width;
      if (!back.take({home, y + moved_y, columns, search.rows})) continue;
      const std::optional<Found> again = back.find();
      if (!again || std::abs(again->x + found->x) > 1.0 || std::abs(again->y + found->y) > 1.0) continue;
      const float middle = static_cast<float>(x) + 0.5f * static_cast<float>(columns - left.width);
      matches.found.push_back({matches.pixel * middle, phi, -matches.pixel * static_cast<float>(found->x),
                               matches.pixel * static_cast<float>(found->y), static_cast<float>(found->correlation)});
    }
  }
  return matches;
}

}  // namespace ods
