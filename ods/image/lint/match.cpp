// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/lint/match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ods {

namespace {

// The least standard deviation of a tile with something to find in it. Eight bits are steps of 0.004.
constexpr double kDetail = 0.015;

// A second peak as high as this below the first, and not beside it, makes a tile ambiguous.
constexpr double kPeakLead = 0.04;

struct Tile {
  int x, y;  // of its first pixel
  int columns, rows;
};

struct Found {
  double x = 0.0, y = 0.0;  // by how much the tile moved
  double correlation = -1.0;
};

class Matcher {
 public:
  Matcher(const View& from, const View& to, int reach_x, int reach_y)
      : from_(from), to_(to), reach_x_(reach_x), reach_y_(reach_y) {}

  // False where there is no detail or no picture.
  bool take(const Tile& tile) {
    tile_ = tile;
    pattern_.clear();
    double sum = 0.0;
    for_each(from_, tile.x, tile.y, [&](float value) {
      pattern_.push_back(value);
      sum += static_cast<double>(value);
    });
    const double mean = sum / static_cast<double>(pattern_.size());
    double square = 0.0;
    for (float& value : pattern_) {
      value -= static_cast<float>(mean);
      square += static_cast<double>(value * value);
    }
    if (!(square >= kDetail * kDetail * static_cast<double>(pattern_.size()))) return false;
    for (float& value : pattern_) value /= static_cast<float>(std::sqrt(square));
    return true;
  }

  std::optional<Found> find() {
    profile_.assign(static_cast<size_t>(2 * reach_x_ + 1), Found{});
    for (int y = -reach_y_; y <= reach_y_; y++) {
      if (tile_.y + y < 0 || tile_.y + y + tile_.rows > to_.height) continue;
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
  template <class Function>
  void for_each(const View& view, int x0, int y0, Function function) const {
    for (int y = y0; y < y0 + tile_.rows; y++) {
      const float* row = view.at(0, y);
      int x = (x0 % view.width + view.width) % view.width;
      for (int i = 0; i < tile_.columns; i++) {
        function(row[x]);
        if (++x == view.width) x = 0;
      }
    }
  }

  // -1 where the other picture is not, or is flat.
  double correlate(int x, int y) const {
    float sum = 0.0f, square = 0.0f, product = 0.0f;
    const float* pattern = pattern_.data();
    for_each(to_, x, y, [&](float value) {
      sum += value;
      square += value * value;
      product += *pattern++ * value;
    });
    const double n = static_cast<double>(pattern_.size());
    const double spread = static_cast<double>(square) - static_cast<double>(sum) * static_cast<double>(sum) / n;
    return spread > 0.25 * kDetail * kDetail * n ? static_cast<double>(product) / std::sqrt(spread) : -1.0;
  }

  bool is_ambiguous(const Found& best) const {
    const double beside = std::max(2.0, 0.25 * tile_.columns);
    return std::any_of(profile_.begin(), profile_.end(), [&](const Found& other) {
      return std::abs(other.x - best.x) > beside && other.correlation > best.correlation - kPeakLead;
    });
  }

  // Of the parabola through three values.
  static double peak(double before, double at, double after) {
    const double bend = before - 2.0 * at + after;
    return bend < 0.0 && before > -1.0 && after > -1.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  }

  double peak_down(const Found& best) const {
    const int x = tile_.x + static_cast<int>(best.x), y = tile_.y + static_cast<int>(best.y);
    if (y < 1 || y + tile_.rows + 1 > to_.height) return 0.0;
    return peak(correlate(x, y - 1), best.correlation, correlate(x, y + 1));
  }

  const View& from_;
  const View& to_;
  int reach_x_, reach_y_;
  Tile tile_{};
  std::vector<float> pattern_;
  std::vector<Found> profile_;  // the best height for each shift
};

}  // namespace

Matches match_tiles(const View& left, const View& right, const Search& search) {
  Matches matches;
  matches.pixel = static_cast<float>(2.0 * std::numbers::pi / left.width);
  const int reach_x = std::min(static_cast<int>(std::ceil(search.around / matches.pixel)), left.width / 2 - 1);
  const int reach_y = static_cast<int>(std::ceil(search.down / matches.pixel));
  Matcher there(left, right, reach_x, reach_y), back(right, left, reach_x, reach_y);
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
      if (!back.take({x + moved_x, y + moved_y, columns, search.rows})) continue;
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
