// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "ods/convert/panorama.h"

namespace ods {

namespace {

constexpr double kDark = 0.08;      // as displayed: black, including JPEG's artifacts
constexpr double kVisible = 0.006;  // a mean difference larger than rounding

double value(const Image& eye, int x, int y) {
  return static_cast<double>(*eye.at(x, y));
}

// Rises from 0 to 1 with the visible difference.
double enough(double difference) {
  return std::clamp(difference / kVisible - 0.2, 0.0, 1.0);
}

// --- the circle ------------------------------------------------------------------------------------------------------

struct Ring {
  int count = 0;
  int dark = 0;
  double share() const { return count > 0 ? static_cast<double>(dark) / count : 0.0; }
};

constexpr int kRings = 50;  // number of rings within the radius 1

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

// The ratio of differences along the radii to differences around, in a ring.
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

// The mean difference of points of a ring that are a twelfth of it apart.
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

// Near the rim of a mirror ball the picture varies little around, and much more farther out; its rim itself is one
// point.
double ball_of(const Image& eye) {
  const double texel = 2.0 / std::min(eye.width, eye.height);
  const double rim = far_apart_on_ring(eye, 1.0 - 2.0 * texel);
  double off = 0.0;
  for (const double radius : {0.5, 0.6, 0.7, 0.8}) off += far_apart_on_ring(eye, radius) / 4.0;
  const double stretch = std::log(stretch_in_ring(eye, 0.88, 0.94)) + std::log(stretch_in_ring(eye, 0.94, 0.97));
  return enough(off) * std::clamp((stretch + std::log((off + 0.001) / (rim + 0.001)) - 1.4) / 0.5, -1.0, 1.0);
}

// Fraction of the variance inside the circle that the means of bands explain, 0..1. The bands are rings or rows.
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
  // A lens that looks ahead has the sky above and the ground below, so rows explain more of it than rings.
  const double rings = explained_by(eye, true) - explained_by(eye, false);
  marks.dome = std::clamp((rings + 0.12) / 0.12, -1.0, 1.0);
}

// --- pairs of texels -------------------------------------------------------------------------------------------------

// Measures how well pairs of texels join, compared with adjacent texels inside the picture and with unrelated pairs: 1
// like adjacent texels, -1 like unrelated ones. Roots of differences are summed, so that one sharp edge does not
// outvote all others.
struct Joins {
  double pairs = 0.0, neighbours = 0.0, strangers = 0.0;
  int count = 0;

  Joins& operator+=(const Joins& other) {
    pairs += other.pairs, neighbours += other.neighbours, strangers += other.strangers, count += other.count;
    return *this;
  }

  double mark() const {
    const double room = strangers - neighbours;
    if (count == 0 || room <= 0.0) return 0.0;
    return enough(room * room / count / count * 10.0) * std::clamp(2.0 * (strangers - pairs) / room - 1.0, -1.0, 1.0);
  }
};

double root_of(double difference) {
  return std::sqrt(std::abs(difference));
}

// --- the poles -------------------------------------------------------------------------------------------------------

// The mean difference of points of a row that are a twelfth of it apart. An edge that passes through a pole, such as a
// tile's below the viewer, separates few of them. Each point is the mean of several texels, against noise.
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

// The ratio of vertical to horizontal differences in the rows from `begin` to `end` of the height. Returns nullopt if
// the picture hardly varies there.
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

// Evidence that a row continues in the one above it, as Joins::mark().
double continues_upwards(const Image& eye, int y) {
  Joins joins;
  for (int x = 0; x < eye.width; x++) {
    const double here = value(eye, x, y), above = value(eye, x, y - 1);
    joins.pairs += root_of(here - above);
    joins.neighbours += 0.5 * (root_of(here - value(eye, x, y + 1)) + root_of(above - value(eye, x, y - 2)));
    for (int i = 1; i < 8; i++)
      joins.strangers += root_of(here - value(eye, (x + eye.width * i / 8) % eye.width, y)) / 7.0;
    joins.count++;
  }
  return joins.mark();
}

double row_difference(const Image& eye, const Image& other, int y) {
  double sum = 0.0;
  for (int x = 0; x < eye.width; x++) sum += std::abs(value(eye, x, y) - value(other, x, y));
  return sum / eye.width;
}

// The number of rows at the bottom that are covered by a patch over the tripod: it is at the same place in both eyes,
// or ends at an edge from side to side. It has detail, whereas a nadir would be one point.
int covered_rows(const Image& eye, const Image* other) {
  constexpr double kEqual = 0.02, kBreak = -0.2, kPoint = 0.04;
  const int maximum = eye.height / 4, minimum = std::max(2, eye.height / 50);
  if (far_apart(eye, eye.height - 1) < kPoint) return 0;
  int same = 0;
  while (other != nullptr && same < maximum && row_difference(eye, *other, eye.height - 1 - same) < kEqual) same++;
  if (same >= minimum) return same;
  for (int rows = minimum; rows < maximum; rows++) {
    if (continues_upwards(eye, eye.height - rows) < kBreak) return rows;
  }
  return 0;
}

// A black row is not evidence for a pole: it may be a border, or the ground on which a chart is drawn.
bool is_black(const Image& eye, int y) {
  for (int x = 0; x < eye.width; x++) {
    if (value(eye, x, y) >= kDark) return false;
  }
  return true;
}

// Towards a pole, a picture is increasingly stretched along its rows.
double stretched_at_ends(const Image& eye, bool has_nadir) {
  double maximum = -1e9;
  for (const bool is_top : {true, false}) {
    if ((!is_top && !has_nadir) || is_black(eye, is_top ? 0 : eye.height - 1)) continue;
    const auto at = is_top ? stretch_in_rows(eye, 0.0, 0.06) : stretch_in_rows(eye, 0.94, 1.0);
    const auto off = is_top ? stretch_in_rows(eye, 0.02, 0.12) : stretch_in_rows(eye, 0.88, 0.98);
    if (at && off && *off > 0.0) maximum = std::max(maximum, std::log(*at / *off));
  }
  return maximum < -1e8 ? 0.0 : std::clamp((maximum - 0.35) / 0.2, -1.0, 1.0);
}

void find_poles(const Image& eye, bool has_nadir, Marks& marks) {
  double minimum = 1.0, both = 0.0;
  marks.spread = 0.0;
  for (const bool is_top : {true, false}) {
    if (!is_top && !has_nadir) continue;
    const int row = is_top ? 0 : eye.height - 1;
    const double at_pole = far_apart(eye, row);
    const int begin = eye.height / 10, end = eye.height / 4;
    double off = 0.0;
    for (int i = begin; i < end; i += 2) off += far_apart(eye, is_top ? i : eye.height - 1 - i) * 2.0 / (end - begin);
    const double spread = (at_pole + 0.001) / (off + 0.001);
    const double likely = std::clamp(std::log(0.45 / spread) / std::log(2.0), -1.0, is_black(eye, row) ? 0.0 : 1.0);
    const double weight = enough(std::max(off, at_pole));
    minimum = std::min(minimum, weight * likely);
    both += 0.5 * weight * likely;
    marks.spread = std::max(marks.spread, spread);
  }
  both = std::min(both, minimum + 0.5);  // a sky without clouds looks like a pole; both ends together do not
  marks.poles = std::clamp(std::max(both, -0.6) + stretched_at_ends(eye, has_nadir), -1.0, 1.0);
}

// --- the seam --------------------------------------------------------------------------------------------------------

void find_seam(const Image& eye, int rows, Marks& marks) {
  Joins joins;
  const int last = eye.width - 1;
  for (int y = 0; y < rows; y++) {
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

Marks marks_of(const Image& eye, const Image* other) {
  Marks marks;
  if (eye.width < 16 || eye.height < 16) return marks;
  marks.detail = detail_of(eye);
  find_circle(eye, marks);
  if (marks.circle > 0.0) find_kind_of_circle(eye, marks);
  const int covered = covered_rows(eye, other);
  find_poles(eye, covered == 0, marks);
  find_seam(eye, eye.height - covered, marks);
  return marks;
}

// --- faces -----------------------------------------------------------------------------------------------------------

namespace {

struct Side {
  size_t edge;           // edge of the face
  int x, y;              // a texel at the edge of a face
  int inner_x, inner_y;  // the next texel inwards
  int outer_x, outer_y;  // the next texel outwards, beyond the face
};

std::vector<Side> sides_of(const Cell& cell) {
  std::vector<Side> sides;
  for (int x = cell.left; x < cell.right; x++) {
    sides.push_back({0, x, cell.top, x, cell.top + 1, x, cell.top - 1});
    sides.push_back({1, x, cell.bottom - 1, x, cell.bottom - 2, x, cell.bottom});
  }
  for (int y = cell.top; y < cell.bottom; y++) {
    sides.push_back({2, cell.left, y, cell.left + 1, y, cell.left - 1, y});
    sides.push_back({3, cell.right - 1, y, cell.right - 2, y, cell.right, y});
  }
  return sides;
}

}  // namespace

constexpr size_t kWorstEdges = 4;  // out of 24, tolerated because a stitcher or a codec may have spoilt them

double faces_join(const Image& eye, const ProjectionSetting& cube) {
  const int columns = width_step(cube), rows = 6 / columns;
  if (eye.width < 4 * columns || eye.height < 4 * rows) return 0.0;
  StoredPicture picture;
  picture.size = {eye.width, eye.height};
  picture.camera.projection = cube;
  picture.eyes.resize(1);
  const Source source = make_source(picture);
  std::array<Joins, 24> edges;
  for (int i = 0; i < 6; i++) {
    const vec2 middle((static_cast<float>(i % columns) + 0.5f) * static_cast<float>(eye.width / columns),
                      (static_cast<float>(i / columns) + 0.5f) * static_cast<float>(eye.height / rows));
    const Cell cell = cell_of(source.camera.projection, picture.size, middle);
    for (const Side& side : sides_of(cell)) {
      const Texel there = texel_of(source, 0, cell, side.outer_x, side.outer_y);
      Joins& joins = edges[4 * static_cast<size_t>(i) + side.edge];
      const double here = value(eye, side.x, side.y);
      joins.pairs += root_of(here - value(eye, there.x, there.y));
      joins.neighbours += root_of(here - value(eye, side.inner_x, side.inner_y));
      // The same position on the next faces.
      for (int k = 1; k < 6; k++) {
        const int x = (side.x + (k % columns) * (eye.width / columns)) % eye.width;
        const int y = (side.y + (k / columns) * (eye.height / rows)) % eye.height;
        joins.strangers += root_of(here - value(eye, x, y)) / 5.0;
      }
      joins.count++;
    }
  }
  // Some edges also join if the faces are in another order.
  Joins all;
  std::array<double, 24> marks;
  for (size_t i = 0; i < edges.size(); i++) all += edges[i], marks[i] = edges[i].mark();
  std::nth_element(marks.begin(), marks.begin() + kWorstEdges, marks.end());
  return std::min(all.mark(), marks[kWorstEdges] + 0.5);
}

// Evidence for a border between two cells, whose texels start at (x, y) and continue by (dx, dy).
static double border_mark(const Image& eye, int x, int y, int dx, int dy, int length) {
  Joins joins;
  for (int i = 0; i < length; i++) {
    const int at_x = x + (1 - dx) * i, at_y = y + (1 - dy) * i;
    const double here = value(eye, at_x, at_y), before = value(eye, at_x - dx, at_y - dy);
    joins.pairs += root_of(here - before);
    joins.neighbours += 0.5 * (root_of(here - value(eye, at_x + dx, at_y + dy)) +
                               root_of(before - value(eye, at_x - 2 * dx, at_y - 2 * dy)));
    for (int k = 1; k < 8; k++) {
      const int other = (i + length * k / 8) % length;
      joins.strangers += root_of(here - value(eye, x + (1 - dx) * other, y + (1 - dy) * other)) / 7.0;
    }
    joins.count++;
  }
  return joins.mark();
}

double breaks_in_middle(const Image& eye) {
  if (eye.width < 16) return 0.0;
  return -border_mark(eye, eye.width / 2, 0, 1, 0, eye.height);
}

double breaks_at_grid(const Image& eye, int columns, int rows) {
  if (eye.width < 8 * columns || eye.height < 8 * rows) return 0.0;
  const int wide = eye.width / columns, high = eye.height / rows;
  std::vector<double> marks;
  for (int row = 1; row < rows; row++) marks.push_back(border_mark(eye, 0, row * high, 0, 1, eye.width));
  for (int i = rows; i < rows * columns; i++) {
    marks.push_back(border_mark(eye, i / rows * wide, i % rows * high, 1, 0, high));
  }
  std::nth_element(marks.begin(), marks.begin() + 1, marks.end());
  return -marks[1];
}

}  // namespace ods
