// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ods/image/block_means.h"

namespace ods {

namespace {

constexpr int kTile = 14;           // pixels
constexpr int kReach = 9;           // search radius in the coarse image, pixels
constexpr int kCoarse = 4;          // scale of the coarse image
constexpr double kDetail = 0.012;   // minimum standard deviation of a tile
constexpr double kAlike = 0.8;      // minimum correlation of a pair
constexpr double kLead = 0.03;      // minimum lead of the best position over others
constexpr double kPrecision = 0.2;  // precision of a pair, pixels
constexpr double kOutliers = 0.15;  // fraction of wrong pairs

struct Shift {
  double x = 0.0, y = 0.0;
  double correlation = -1.0;
};

// A tile of one image, and the search for it in another.
class Tile {
 public:
  // A tile without detail matches nothing.
  Tile(const Image& from, int x, int y, int side)
      : x_(x), y_(y), side_(side), values_(static_cast<size_t>(side * side)) {
    float sum = 0.0f, square = 0.0f;
    for (int j = 0; j < side; j++) {
      for (int i = 0; i < side; i++) sum += values_[static_cast<size_t>(j * side + i)] = *from.at(x + i, y + j);
    }
    for (float& value : values_) value -= sum / static_cast<float>(side * side), square += value * value;
    spread_ = std::sqrt(square);
  }

  bool has_detail() const { return static_cast<double>(spread_ * spread_) > kDetail * kDetail * count(); }

  double correlate(const Image& to, int dx, int dy) const {
    if (x_ + dx < 0 || y_ + dy < 0 || x_ + dx + side_ > to.width || y_ + dy + side_ > to.height) return -1.0;
    float product = 0.0f, sum = 0.0f, square = 0.0f;
    for (int j = 0; j < side_; j++) {
      const float* row = to.at(x_ + dx, y_ + dy + j);
      const float* own = &values_[static_cast<size_t>(j * side_)];
      for (int i = 0; i < side_; i++) product += own[i] * row[i], sum += row[i], square += row[i] * row[i];
    }
    const double spread = static_cast<double>(square - sum * sum / static_cast<float>(count()));
    if (spread < 0.25 * kDetail * kDetail * count()) return -1.0;
    return static_cast<double>(product) / (std::sqrt(spread) * static_cast<double>(spread_));
  }

  // The best shift within `reach` of one. Returns nullopt if there are two or it is at the edge.
  std::optional<Shift> find(const Image& to, Shift from, int reach) const {
    const int side = 2 * reach + 1, x0 = static_cast<int>(std::lround(from.x)),
              y0 = static_cast<int>(std::lround(from.y));
    std::vector<double> all(static_cast<size_t>(side * side));
    for (int i = 0; i < side * side; i++) {
      all[static_cast<size_t>(i)] = correlate(to, x0 + i % side - reach, y0 + i / side - reach);
    }
    const int best = static_cast<int>(std::max_element(all.begin(), all.end()) - all.begin());
    const int bx = best % side, by = best / side;
    const auto at = [&](int x, int y) { return all[static_cast<size_t>(y * side + x)]; };
    if (at(bx, by) < 0.6 || bx == 0 || by == 0 || bx == side - 1 || by == side - 1) return {};
    for (int i = 0; i < side * side; i++) {
      const bool apart = std::max(std::abs(i % side - bx), std::abs(i / side - by)) > 2;
      if (apart && all[static_cast<size_t>(i)] > at(bx, by) - kLead) return {};
    }
    return Shift{x0 + bx - reach + peak(at(bx - 1, by), at(bx, by), at(bx + 1, by)),
                 y0 + by - reach + peak(at(bx, by - 1), at(bx, by), at(bx, by + 1)), at(bx, by)};
  }

 private:
  double count() const { return static_cast<double>(values_.size()); }

  static double peak(double before, double at, double after) {
    const double bend = before - 2.0 * at + after;
    return bend < 0.0 && before > -1.0 && after > -1.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  }

  int x_, y_, side_;
  std::vector<float> values_;
  float spread_ = 0.0f;
};

struct Pyramid {
  Image fine, coarse;
};

// Finds a tile of one image in the other: within a wide range in the coarse images, then precisely in the fine ones.
std::optional<Shift> find_there(const Pyramid& from, const Pyramid& to, int x, int y) {
  constexpr int kSide = 10;  // side of a coarse tile
  const int cx = std::clamp((x + kTile / 2) / kCoarse - kSide / 2, 0, from.coarse.width - kSide);
  const int cy = std::clamp((y + kTile / 2) / kCoarse - kSide / 2, 0, from.coarse.height - kSide);
  const Tile far(from.coarse, cx, cy, kSide);
  if (!far.has_detail()) return {};
  const std::optional<Shift> about = far.find(to.coarse, {}, kReach);
  if (!about) return {};
  const std::optional<Shift> exact =
      Tile(from.fine, x, y, kTile).find(to.fine, {kCoarse * about->x, kCoarse * about->y}, 4);
  return exact && exact->correlation > kAlike ? exact : std::nullopt;
}

}  // namespace

PointPairs find_pairs(const Image& left, const Image& right) {
  PointPairs pairs;
  pairs.size = {left.width, left.height};
  if (std::min(left.width, left.height) < 12 * kCoarse) return pairs;
  const Pyramid a{left, block_means(left, kCoarse)}, b{right, block_means(right, kCoarse)};
  for (int y = 0; y + kTile <= left.height; y += kTile) {
    for (int x = 0; x + kTile <= left.width; x += kTile) {
      if (!Tile(left, x, y, kTile).has_detail()) continue;
      pairs.places++;
      const std::optional<Shift> there = find_there(a, b, x, y);
      if (!there) continue;
      const int home_x = x + static_cast<int>(std::lround(there->x)),
                home_y = y + static_cast<int>(std::lround(there->y));
      const std::optional<Shift> back = Tile(b.fine, home_x, home_y, kTile).find(a.fine, {-there->x, -there->y}, 4);
      if (!back || std::abs(back->x + there->x) > 1.0 || std::abs(back->y + there->y) > 1.0) continue;
      const vec2 middle(static_cast<float>(x) + 0.5f * kTile, static_cast<float>(y) + 0.5f * kTile);
      pairs.found.push_back({middle, middle + vec2(static_cast<float>(there->x), static_cast<float>(there->y))});
    }
  }
  return pairs;
}

// --- how well a projection explains the pairs

namespace {

// The likelihood of a difference in height, pixels; 1 if there is none.
double likelihood(double off) {
  return (1.0 - kOutliers) * std::exp(-0.5 * off * off / (kPrecision * kPrecision)) +
         kOutliers * std::exp(-std::abs(off));
}

struct Looker {
  Projection projection;
  vec2 size;

  // home: a pixel of the same face.
  ViewDirection at(vec2 home, vec2 pixel) const { return look_of(projection, home / size, pixel / size); }
  bool is_one_face(const PointPair& pair) const { return same_face(projection, pair.left / size, pair.right / size); }
};

// The difference of two directions: how far the first is around and up from the second.
struct Apart {
  double around = 0.0, up = 0.0;
};

double turned(double angle) {
  return std::remainder(angle, 2.0 * 3.14159265358979);
}

// Eyes on a circle: headings differ, elevations do not.
Apart on_circle(vec3 a, vec3 b) {
  const auto heading = [](vec3 d) { return std::atan2(static_cast<double>(d.x), -static_cast<double>(d.z)); };
  const auto height = [](vec3 d) { return std::asin(std::clamp(static_cast<double>(d.y), -1.0, 1.0)); };
  return {turned(heading(a) - heading(b)) * std::cos(height(a)), height(a) - height(b)};
}

// Two cameras that look ahead: directions differ along the great circles through the line between the cameras.
Apart of_cameras(vec3 a, vec3 b) {
  const auto side = [](vec3 d) { return std::asin(std::clamp(static_cast<double>(d.x), -1.0, 1.0)); };
  const auto up = [](vec3 d) { return std::atan2(static_cast<double>(d.y), -static_cast<double>(d.z)); };
  return {side(a) - side(b), turned(up(a) - up(b)) * std::cos(side(a))};
}

// The parallax of a pair, in pixels.
struct Move {
  double around = 0.0, up = 0.0;
  double height = 0.0;  // above the horizon, radians
};

// Returns nullopt if a position is outside the picture.
std::optional<Move> move_of(const PointPair& pair, const Looker& looker, Apart (*apart)(vec3 a, vec3 b)) {
  const ViewDirection a = looker.at(pair.left, pair.left), b = looker.at(pair.left, pair.right),
                      beside = looker.at(pair.left, pair.left + vec2(1.0f, 0.0f)),
                      below = looker.at(pair.left, pair.left + vec2(0.0f, 1.0f));
  if (!a.seen || !b.seen || !beside.seen || !below.seen) return {};
  const Apart there = apart(a.direction, b.direction), right = apart(beside.direction, a.direction),
              down = apart(below.direction, a.direction);
  return Move{there.around / std::hypot(right.around, down.around), there.up / std::hypot(right.up, down.up),
              static_cast<double>(a.elevation)};
}

// Evidence that parallax grows downwards below the horizon, -1..1. It does for eyes in the right order, because the
// ground gets closer, wherever the eyes converge; it decreases if they are swapped.
double growth_downwards(const std::vector<Move>& moves) {
  double n = 0.0, depth = 0.0, around = 0.0, both = 0.0, depths = 0.0, arounds = 0.0;
  for (const Move& move : moves) {
    if (move.height < 0.0) n += 1.0, depth -= move.height, around += move.around;
  }
  if (n < 5.0) return 0.0;
  for (const Move& move : moves) {
    if (move.height >= 0.0) continue;
    const double deeper = -move.height - depth / n, farther = move.around - around / n;
    both += deeper * farther, depths += deeper * deeper, arounds += farther * farther;
  }
  return depths > 0.0 && arounds > 0.0 ? both / std::sqrt(depths * arounds) : 0.0;
}

double order_of(const std::vector<Move>& moves) {
  double signs = 0.0, all = 0.0;
  for (const Move& move : moves) {
    const double sign = std::clamp(move.around, -1.0, 1.0);
    signs += sign, all += std::abs(sign);
  }
  if (all == 0.0) return 0.0;
  // Eyes that converge nearby have negative parallax, too; then only the ground decides.
  const double converge = signs < 0.0 ? 0.5 - 0.5 * std::tanh(6.0 * (growth_downwards(moves) - 0.2)) : 1.0;
  return converge * signs / (all + 4.0);
}

Parallax parallax_of(const PointPairs& pairs, const Looker& looker, Apart (*apart)(vec3 a, vec3 b)) {
  Parallax parallax;
  std::vector<Move> moves;
  for (const PointPair& pair : pairs.found) {
    // Pairs without parallax are the same in every projection.
    if (length(pair.left - pair.right) < 0.4f || !looker.is_one_face(pair)) continue;
    parallax.count++;
    const std::optional<Move> move = move_of(pair, looker, apart);
    parallax.level += std::log(move ? likelihood(move->up) : 0.1 * kOutliers);
    if (move) moves.push_back(*move);
  }
  if (parallax.count > 0) parallax.level /= parallax.count;
  const double explained = std::clamp((1.6 + parallax.level) / 0.6, 0.0, 1.0);  // the signs of bad pairs mean nothing
  parallax.order = explained * order_of(moves);
  return parallax;
}

}  // namespace

Parallax parallax_in(const PointPairs& pairs, const ProjectionSetting& projection) {
  const Looker looker{make_projection(projection),
                      vec2(static_cast<float>(pairs.size.width), static_cast<float>(pairs.size.height))};
  const Parallax circle = parallax_of(pairs, looker, on_circle), cameras = parallax_of(pairs, looker, of_cameras);
  return circle.level >= cameras.level ? circle : cameras;
}

}  // namespace ods
