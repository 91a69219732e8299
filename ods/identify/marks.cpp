// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "ods/convert/panorama.h"

namespace ods {

namespace {

constexpr double kDark = 0.08;      // as a display shows it: black, with what JPEG adds to it
constexpr double kVisible = 0.006;  // a mean difference that is more than rounding

double value(const Image& eye, int x, int y) {
  return static_cast<double>(*eye.at(x, y));
}

// From 0 to 1 as there is more to see.
double enough(double difference) {
  return std::clamp(difference / kVisible - 0.2, 0.0, 1.0);
}

// --- the circle ------------------------------------------------------------------------------------------------------

struct Ring {
  int count = 0;
  int dark = 0;
  double share() const { return count > 0 ? static_cast<double>(dark) / count : 0.0; }
};

constexpr int kRings = 50;  // as many have the radius 1

std::vector<Ring> rings_of(const Image& eye) {
  std::vector<Ring> rings(2 * kRings);
  for (int y = 0; y < eye.height; y++) {
    for (int x = 0; x < eye.width; x++) {
      const double r = std::hypot((2.0 * x + 1.0) / eye.width - 1.0, (2.0 * y + 1.0) / eye.height - 1.0);
      Ring& ring = rings[std::min(static_cast<size_t>(r * kRings), rings.size() - 1)];
      ring.count++;
      if (value(eye, x, y) < kDark) ring.dark++;
    }
  }
  return rings;
}

void find_circle(const Image& eye, Marks& marks) {
  const std::vector<Ring> rings = rings_of(eye);
  Ring outside, inside;
  int edge = kRings;
  while (edge > 0 && rings[static_cast<size_t>(edge - 1)].share() > 0.8) edge--;
  for (int i = 0; i < static_cast<int>(rings.size()); i++) {
    Ring& sum = i > kRings ? outside : inside;
    if (i <= kRings && (i >= edge || i < edge * 3 / 4)) continue;  // inside: near the edge
    sum.count += rings[static_cast<size_t>(i)].count, sum.dark += rings[static_cast<size_t>(i)].dark;
  }
  marks.radius = static_cast<double>(edge) / kRings;
  if (outside.share() < 0.97 || edge < kRings / 2) {
    marks.circle = -1.0;
    return;
  }
  marks.circle = std::clamp(2.0 * (0.9 - inside.share()), 0.0, 1.0);  // in the dark everything is black
}

// How much more a picture differs along its radii than around, in a ring.
double stretch_in_ring(const Image& eye, double inner, double outer) {
  double out = 0.0, around = 0.0;
  for (int y = 1; y + 1 < eye.height; y++) {
    for (int x = 1; x + 1 < eye.width; x++) {
      const double u = (2.0 * x + 1.0) / eye.width - 1.0, v = (2.0 * y + 1.0) / eye.height - 1.0, r = std::hypot(u, v);
      if (r < inner || r > outer) continue;
      const double du = (value(eye, x + 1, y) - value(eye, x - 1, y)) * eye.width;
      const double dv = (value(eye, x, y + 1) - value(eye, x, y - 1)) * eye.height;
      out += std::abs(du * u + dv * v), around += std::abs(dv * u - du * v);
    }
  }
  return around > 0.0 ? out / around : 1.0;
}

// The mean difference of places of a ring that are a twelfth of it apart.
double far_apart_on_ring(const Image& eye, double radius) {
  constexpr size_t kPlaces = 192, kWide = 5;
  std::vector<double> places(kPlaces);
  for (size_t i = 0; i < kPlaces * kWide; i++) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / (kPlaces * kWide);
    const int x = static_cast<int>((0.5 + 0.5 * radius * std::cos(angle)) * eye.width);
    const int y = static_cast<int>((0.5 + 0.5 * radius * std::sin(angle)) * eye.height);
    places[i / kWide] += value(eye, std::clamp(x, 0, eye.width - 1), std::clamp(y, 0, eye.height - 1)) / kWide;
  }
  double sum = 0.0;
  for (size_t i = 0; i < kPlaces; i++) sum += std::abs(places[i] - places[(i + kPlaces / 12) % kPlaces]) / kPlaces;
  return sum;
}

// Near the rim of a mirror ball little is far around, and much further out; its very rim is one point.
double ball_of(const Image& eye) {
  const double texel = 2.0 / std::min(eye.width, eye.height);
  const double rim = far_apart_on_ring(eye, 1.0 - 2.0 * texel);
  double off = 0.0;
  for (const double radius : {0.5, 0.6, 0.7, 0.8}) off += far_apart_on_ring(eye, radius) / 4.0;
  const double stretch = std::log(stretch_in_ring(eye, 0.88, 0.94)) + std::log(stretch_in_ring(eye, 0.94, 0.97));
  return enough(off) * std::clamp((stretch + std::log((off + 0.001) / (rim + 0.001)) - 1.4) / 0.5, -1.0, 1.0);
}

// How much of the differences inside the circle the bands of a picture explain, 0..1: rings or rows.
double explained_by(const Image& eye, bool rings) {
  constexpr size_t kBands = 24;
  std::vector<double> sum(kBands), square(kBands), count(kBands);
  for (int y = 0; y < eye.height; y++) {
    for (int x = 0; x < eye.width; x++) {
      const double u = (2.0 * x + 1.0) / eye.width - 1.0, v = (2.0 * y + 1.0) / eye.height - 1.0, r = std::hypot(u, v);
      if (r > 0.95) continue;
      const auto band = static_cast<size_t>((rings ? r * r : 0.5 + 0.5 * v) * kBands);
      const double here = value(eye, x, y);
      sum[band] += here, square[band] += here * here, count[band] += 1.0;
    }
  }
  double within = 0.0, all = 0.0, squares = 0.0, n = 0.0;
  for (size_t i = 0; i < kBands; i++) {
    if (count[i] > 0.0) within += square[i] - sum[i] * sum[i] / count[i];
    all += sum[i], squares += square[i], n += count[i];
  }
  const double spread = squares - all * all / std::max(n, 1.0);
  return spread > 0.0 ? 1.0 - within / spread : 0.0;
}

void find_kind_of_circle(const Image& eye, Marks& marks) {
  marks.ball = ball_of(eye);
  // A lens that looks ahead has the sky above and the ground below: rows explain more of it than rings.
  const double rings = explained_by(eye, true) - explained_by(eye, false);
  marks.dome = std::clamp((rings + 0.12) / 0.12, -1.0, 1.0);
}

// --- the poles -------------------------------------------------------------------------------------------------------

// The mean difference of places of a row that are a twelfth of it apart: an edge that leads through a pole, as of a
// tile below the viewer, parts few of them. Each place is the mean of some neighbours, against noise.
double far_apart(const Image& eye, int y) {
  const int wide = std::max(eye.width / 32, 1);
  std::vector<double> sums(static_cast<size_t>(eye.width));
  for (int x = 0; x < eye.width; x++) {
    for (int i = 0; i < wide; i++) sums[static_cast<size_t>(x)] += value(eye, (x + i) % eye.width, y) / wide;
  }
  double sum = 0.0;
  for (size_t x = 0; x < sums.size(); x++) sum += std::abs(sums[x] - sums[(x + sums.size() / 12) % sums.size()]);
  return sum / eye.width;
}

// How much more a picture differs down than along in the rows from `begin` to `end` of its height; nothing if hardly
// anything differs there.
std::optional<double> stretch_in_rows(const Image& eye, double begin, double end) {
  constexpr double kDiffers = 0.02, kEnough = 0.05;
  double along = 0.0, down = 0.0;
  int differ = 0, all = 0;
  const int first = std::max(1, static_cast<int>(begin * eye.height));
  for (int y = first; y < std::min(eye.height - 1, static_cast<int>(end * eye.height)); y++) {
    for (int x = 1; x + 1 < eye.width; x++) {
      const double dx = std::abs(value(eye, x + 1, y) - value(eye, x - 1, y));
      const double dy = std::abs(value(eye, x, y + 1) - value(eye, x, y - 1));
      all++;
      if (std::max(dx, dy) < kDiffers) continue;
      along += dx, down += dy, differ++;
    }
  }
  if (differ < kEnough * all || along <= 0.0) return {};
  return down / along;
}

// Towards a pole a picture is stretched along its rows, more and more.
double stretched_at_ends(const Image& eye) {
  double most = -1e9;
  for (const bool is_top : {true, false}) {
    const auto at = is_top ? stretch_in_rows(eye, 0.0, 0.06) : stretch_in_rows(eye, 0.94, 1.0);
    const auto off = is_top ? stretch_in_rows(eye, 0.02, 0.12) : stretch_in_rows(eye, 0.88, 0.98);
    if (at && off && *off > 0.0) most = std::max(most, std::log(*at / *off));
  }
  return most < -1e8 ? 0.0 : std::clamp((most - 0.35) / 0.2, -1.0, 1.0);
}

void find_poles(const Image& eye, Marks& marks) {
  double least = 1.0, both = 0.0;
  marks.spread = 0.0;
  for (const bool is_top : {true, false}) {
    const double at_pole = far_apart(eye, is_top ? 0 : eye.height - 1);
    const int begin = eye.height / 10, end = eye.height / 4;
    double off = 0.0;
    for (int i = begin; i < end; i += 2) off += far_apart(eye, is_top ? i : eye.height - 1 - i) * 2.0 / (end - begin);
    const double spread = (at_pole + 0.001) / (off + 0.001);
    const double likely = std::clamp(std::log(0.45 / spread) / std::log(2.0), -1.0, 1.0);
    const double weight = enough(std::max(off, at_pole));
    least = std::min(least, weight * likely);
    both += 0.5 * weight * likely;
    marks.spread = std::max(marks.spread, spread);
  }
  both = std::min(both, least + 0.5);  // a sky without clouds looks like a pole; both ends do not
  marks.poles = std::clamp(std::max(both, -0.6) + stretched_at_ends(eye), -1.0, 1.0);
}

// --- the seam --------------------------------------------------------------------------------------------------------

// How well pairs of texels join, compared with neighbours inside the picture and with pairs that have nothing to do
// with each other: 1 as neighbours, -1 as strangers. Roots of differences count: one sharp edge must not outvote all.
struct Joins {
  double pairs = 0.0, neighbours = 0.0, strangers = 0.0;
  int count = 0;

  double mark() const {
    const double room = strangers - neighbours;
    if (count == 0 || room <= 0.0) return 0.0;
    return enough(room * room / count / count * 10.0) * std::clamp(2.0 * (strangers - pairs) / room - 1.0, -1.0, 1.0);
  }
};

double root_of(double difference) {
  return std::sqrt(std::abs(difference));
}

void find_seam(const Image& eye, Marks& marks) {
  Joins joins;
  const int last = eye.width - 1;
  for (int y = 0; y < eye.height; y++) {
    const double left = value(eye, 0, y), right = value(eye, last, y);
    joins.pairs += root_of(left - right);
    joins.neighbours += 0.5 * (root_of(left - value(eye, 1, y)) + root_of(right - value(eye, last - 1, y)));
    for (int i = 1; i < 8; i++) {
      const double other = value(eye, eye.width * i / 8, y);
      joins.strangers += (root_of(left - other) + root_of(right - other)) / 14.0;
    }
    joins.count++;
  }
  marks.closes = joins.mark();
}

double detail_of(const Image& eye) {
  double sum = 0.0;
  for (int y = 0; y + 1 < eye.height; y++) {
    for (int x = 0; x + 1 < eye.width; x++) {
      sum += std::abs(value(eye, x, y) - value(eye, x + 1, y)) + std::abs(value(eye, x, y) - value(eye, x, y + 1));
    }
  }
  return sum / (2.0 * (eye.width - 1) * (eye.height - 1));
}

}  // namespace

Marks marks_of(const Image& eye) {
  Marks marks;
  if (eye.width < 16 || eye.height < 16) return marks;
  marks.detail = detail_of(eye);
  find_circle(eye, marks);
  if (marks.circle > 0.0) find_kind_of_circle(eye, marks);
  find_poles(eye, marks);
  find_seam(eye, marks);
  return marks;
}

// --- faces -----------------------------------------------------------------------------------------------------------

namespace {

struct Side {
  int x, y;              // of a texel at the edge of a face
  int inner_x, inner_y;  // the next one inwards
  int outer_x, outer_y;  // and outwards, beyond the face
};

std::vector<Side> sides_of(const Cell& cell) {
  std::vector<Side> sides;
  for (int x = cell.left; x < cell.right; x++) {
    sides.push_back({x, cell.top, x, cell.top + 1, x, cell.top - 1});
    sides.push_back({x, cell.bottom - 1, x, cell.bottom - 2, x, cell.bottom});
  }
  for (int y = cell.top; y < cell.bottom; y++) {
    sides.push_back({cell.left, y, cell.left + 1, y, cell.left - 1, y});
    sides.push_back({cell.right - 1, y, cell.right - 2, y, cell.right, y});
  }
  return sides;
}

}  // namespace

double faces_join(const Image& eye, const ProjectionSetting& cube) {
  const int columns = width_step(cube), rows = 6 / columns;
  if (eye.width < 4 * columns || eye.height < 4 * rows) return 0.0;
  StoredPicture picture;
  picture.size = {eye.width, eye.height};
  picture.camera.projection = cube;
  picture.eyes.resize(1);
  const Source source = make_source(picture);
  Joins joins;
  for (int i = 0; i < 6; i++) {
    const vec2 middle((static_cast<float>(i % columns) + 0.5f) * static_cast<float>(eye.width / columns),
                      (static_cast<float>(i / columns) + 0.5f) * static_cast<float>(eye.height / rows));
    const Cell cell = cell_of(source.camera.projection, picture.size, middle);
    for (const Side& side : sides_of(cell)) {
      const Texel there = texel_of(source, 0, cell, side.outer_x, side.outer_y);
      const double here = value(eye, side.x, side.y);
      joins.pairs += root_of(here - value(eye, there.x, there.y));
      joins.neighbours += root_of(here - value(eye, side.inner_x, side.inner_y));
      // The same place of the next faces.
      for (int k = 1; k < 6; k++) {
        const int x = (side.x + (k % columns) * (eye.width / columns)) % eye.width;
        const int y = (side.y + (k / columns) * (eye.height / rows)) % eye.height;
        joins.strangers += root_of(here - value(eye, x, y)) / 5.0;
      }
      joins.count++;
    }
  }
  return joins.mark();
}

double breaks_at_grid(const Image& eye, int columns, int rows) {
  double at = 0.0, beside = 0.0;
  int count = 0;
  const auto step = [&](int x, int y, int dx, int dy) {
    at += std::abs(value(eye, x, y) - value(eye, x - dx, y - dy));
    beside += 0.5 * (std::abs(value(eye, x, y) - value(eye, x + dx, y + dy)) +
                     std::abs(value(eye, x - dx, y - dy) - value(eye, x - 2 * dx, y - 2 * dy)));
    count++;
  };
  if (eye.width < 4 * columns || eye.height < 4 * rows) return 0.0;
  for (int i = 1; i < columns; i++) {
    for (int y = 0; y < eye.height; y++) step(eye.width * i / columns, y, 1, 0);
  }
  for (int i = 1; i < rows; i++) {
    for (int x = 0; x < eye.width; x++) step(x, eye.height * i / rows, 0, 1);
  }
  if (count == 0) return 0.0;
  const double ratio = (at + 1e-4 * count) / (beside + 1e-4 * count);
  return enough(std::max(at, beside) / count) * std::clamp(std::log(ratio / 2.0) / std::log(2.0), -1.0, 1.0);
}

}  // namespace ods
