// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/row_warp.h"

#include <algorithm>
#include <cmath>

#include "ods/kernel/counterpart.h"

namespace ods {

// --- cameras ---------------------------------------------------------------------------------------------------------

static bool is_symmetric(const Camera& camera) {
  const bool upright = camera.axis == vec3(0.0f, 1.0f, 0.0f) && camera.up == vec3(0.0f, 1.0f, 0.0f);
  return upright && camera.projection.kind == kLatLong && !has_head_tilt(camera) && merges_same_around(camera);
}

static float density(const Projection& projection, Extent size) {
  return static_cast<float>(size.width) / projection.span.x;
}

// Radians: the width of edges after lenses, stitchers and encoders.
static const float kBlur = 2.0f * kPi / 4096.0f;

std::optional<RowWarp> RowWarp::make(const Mapping& mapping, const Reprojection& reprojection) {
  const Camera &from = mapping.source.camera, &to = mapping.camera;
  if (!is_symmetric(from) || !is_symmetric(to) || mapping.turn || mapping.source.right) return std::nullopt;
  constexpr float kSmaller = 1.02f;
  const Extent size = mapping.source.picture->size;
  const float across = density(from.projection, size) / density(to.projection, mapping.size);
  const float down = static_cast<float>(size.height) / from.projection.span.y * to.projection.span.y /
                     static_cast<float>(mapping.size.height);
  if (across > kSmaller || down > kSmaller) return std::nullopt;
  return RowWarp(mapping, reprojection);
}

RowWarp::RowWarp(const Mapping& mapping, const Reprojection& reprojection)
    : mapping_(&mapping), reprojection_(&reprojection) {
  const Projection &from = mapping.source.camera.projection, &to = mapping.camera.projection;
  const Extent size = mapping.source.picture->size;
  scale_ = density(from, size) / density(to, mapping.size);
  period_ = wraps_around(from) ? static_cast<float>(size.width) / scale_ : 0.0f;
  // A surface at a slant of 88 degrees, but at most as steep as is_one_surface() allows.
  one_surface_ = std::clamp(25.0f / density(from, size), 0.01f, 0.1f);
}

// --- surfaces along a row --------------------------------------------------------------------------------------------

namespace {

// The position in the picture that the target's pixel 0 would see at some distance, if the row were extended on both
// sides.
struct WarpNode {
  float column = 0.0f, row = 0.0f;  // texels
  float inverse_depth = 0.0f;       // along the target's ray
};

// The shifts by the surface's nearness in the picture.
class Shifts {
 public:
  std::vector<WarpNode> nodes;
  float maximum = 1e-6f;   // nearness of the last node
  float nodes_per = 0.0f;  // nearness

  WarpNode at(float nearness) const {
    const float t = std::clamp(nearness, 0.0f, maximum) * nodes_per;
    const size_t i = std::min(static_cast<size_t>(t), nodes.size() - 2);
    const float beyond = t - static_cast<float>(i);
    const WarpNode &a = nodes[i], &b = nodes[i + 1];
    return {a.column + (b.column - a.column) * beyond, a.row + (b.row - a.row) * beyond,
            a.inverse_depth + (b.inverse_depth - a.inverse_depth) * beyond};
  }
  float row_of_min() const { return extreme(-1.0f); }
  float row_of_max() const { return extreme(1.0f); }

 private:
  float extreme(float sign) const {
    float row = nodes[0].row;
    for (const WarpNode& node : nodes) row = sign * node.row > sign * row ? node.row : row;
    return row;
  }
};

struct RowOfTarget {
  int index;  // index of the eye
  int y;
};

// Returns false if a part is outside the picture.
bool find_shifts(const Mapping& mapping, RowOfTarget target, int source_eye, float scale, size_t count,
                 Shifts& shifts) {
  const Source& source = mapping.source;
  const int middle = mapping.size.width / 2, which = source.picture->eyes[static_cast<size_t>(source_eye)].eye;
  const float width = static_cast<float>(source.picture->size.width);
  const vec2 home = mapping.home_of(middle, target.y);
  const Ray ray = mapping.ray_of(target.index, home, home);
  shifts.nodes.resize(count);
  shifts.nodes_per = static_cast<float>(count - 1) / shifts.maximum;
  for (size_t i = 0; i < count; i++) {
    const float wanted = shifts.maximum * static_cast<float>(i) / static_cast<float>(count - 1);
    float inverse = wanted;
    ImagePosition found;
    for (int round = 0; round < 3; round++) {
      found = project_point(source.camera, which, ray.origin + ray.direction * (1.0f / std::max(inverse, 1e-6f)));
      if (!found.seen) return false;
      if (round < 2) inverse *= wanted * found.depth;
    }
    WarpNode& node = shifts.nodes[i];
    node = {found.uv.x * width - scale * static_cast<float>(middle),
            found.uv.y * static_cast<float>(source.picture->size.height), inverse};
    if (i > 0) node.column -= width * std::round((node.column - shifts.nodes[i - 1].column) / width);
  }
  return true;
}

// Several rows of the picture as 1 / metres.
class Strip {
 public:
  void read(const Reprojection& reprojection, int source_eye, int first, int last) {
    width_ = reprojection.source->picture->size.width, first_ = first, count_ = last - first + 1;
    values_.resize(static_cast<size_t>(width_) * static_cast<size_t>(count_));
    for (int y = first; y <= last; y++) {
      read_nearness(reprojection, source_eye, y,
                    &values_[static_cast<size_t>(width_) * static_cast<size_t>(y - first)]);
    }
  }

  // Interpolates between the centres of two texels of a column; if they are not on one surface, the closer one counts.
  float at(int column, float row, float one_surface) const {
    const float from = row - 0.5f - static_cast<float>(first_);
    const int upper = std::clamp(static_cast<int>(from), 0, count_ - 1), lower = std::min(upper + 1, count_ - 1);
    const float beyond = std::clamp(from - static_cast<float>(upper), 0.0f, 1.0f);
    const float a = texel(column, upper), b = texel(column, lower);
    if (std::abs(a - b) > one_surface * std::max(a, b)) return beyond < 0.5f ? a : b;
    return a + (b - a) * beyond;
  }

 private:
  float texel(int column, int row) const {
    return values_[static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column)];
  }
  std::vector<float> values_;
  int width_ = 0, first_ = 0, count_ = 0;
};

// --- the target's row ------------------------------------------------------------------------------------------------

constexpr float kNothing = -1.0f;

struct Found {
  float nearness = kNothing;  // in the picture
  float column = 0.0f;        // texels
  int source_eye = 0;
  bool is_filled = false;
};

// std::floor() compiles to a function call.
int floor_of(float x) {
  const int towards_0 = static_cast<int>(x);
  return towards_0 - (static_cast<float>(towards_0) > x ? 1 : 0);
}

// A texel as a point on the target's row.
struct Point {
  float x = 0.0f, nearness = kNothing, column = 0.0f;
};

class Drawing {
 public:
  // fringe: texels beside an edge that have colours of both sides.
  Drawing(std::vector<Found>& found, float scale, float period, float one_surface, int fringe, int source_eye)
      : found_(found),
        half_(0.5f / scale),
        scale_(scale),
        period_(period),
        one_surface_(one_surface),
        fringe_(fringe),
        eye_(source_eye) {}

  // Draws all texels of a row. In a full turn the last one is the first one again.
  void draw(const std::vector<Point>& points) {
    frayed_.assign(points.size(), false);
    for (size_t i = 0; i + 1 < points.size(); i++) {
      const Point &a = points[i], &b = points[i + 1];
      if (is_joined(a, b) || b.x - a.x < 2.0f * half_) continue;
      fray(points, a.nearness > b.nearness ? i + 1 : i, a.nearness > b.nearness ? 1 : -1);
    }
    if (period_ > 0.0f) frayed_.front() = frayed_.back() = frayed_.front() || frayed_.back();
    for (size_t i = 0; i + 1 < points.size(); i++) {
      const Point &a = points[i], &b = points[i + 1];
      if (is_joined(a, b)) {
        if (!frayed_[i] && !frayed_[i + 1]) line(a, b);
      } else if (a.nearness > b.nearness) {
        line(a, {a.x + half_, a.nearness, a.column + 0.5f});
      } else if (b.nearness >= 0.0f) {
        line({b.x - half_, b.nearness, b.column - 0.5f}, b);
      }
    }
  }

 private:
  // Marks texels from one away from the closer surface beside it, as far as the surface extends.
  void fray(const std::vector<Point>& points, size_t first, int step) {
    for (int i = 0; i < fringe_; i++) {
      const size_t at = first + static_cast<size_t>(i * step), next = at + static_cast<size_t>(step);
      frayed_[at] = true;
      if (next >= points.size() || !is_joined(points[std::min(at, next)], points[std::max(at, next)])) return;
    }
  }

  // Returns whether points are on one surface, or so close in the new picture that nothing is visible between them.
  bool is_joined(const Point& a, const Point& b) const {
    if (a.nearness < 0.0f || b.nearness < 0.0f) return false;
    if (std::abs((b.x - a.x) * scale_ - 1.0f) <= 1.0f) return true;
    return std::abs(a.nearness - b.nearness) <= one_surface_ * std::max(a.nearness, b.nearness);
  }

  void line(Point a, Point b) {
    const float width = static_cast<float>(found_.size());
    if (b.x < a.x) std::swap(a, b);
    if (period_ > 0.0f) {
      const float minimum = 0.5f * (width - period_);
      float turn = a.x < minimum ? period_ : 0.0f;
      while (a.x + turn < minimum) turn += period_;
      while (a.x + turn >= minimum + period_) turn -= period_;
      a.x += turn, b.x += turn;
    }
    const float per_pixel = 1.0f / std::max(b.x - a.x, 1e-6f);
    const int last = floor_of(std::min(b.x, 2.0f * width));
    for (int x = -floor_of(-std::max(a.x, -width)); x <= last; x++) {
      const float t = (static_cast<float>(x) - a.x) * per_pixel;
      put(x, a.nearness + (b.nearness - a.nearness) * t, a.column + (b.column - a.column) * t);
    }
  }
  void put(int x, float nearness, float column) {
    const int width = static_cast<int>(found_.size()), turn = static_cast<int>(std::lround(period_));
    if (x < 0) x += turn;
    if (x >= width) x -= turn;
    if (x < 0 || x >= width) return;
    Found& there = found_[static_cast<size_t>(x)];
    if (there.nearness >= nearness) return;
    if (there.nearness >= 0.0f && there.source_eye != eye_) return;
    there = {nearness, column, eye_, false};
  }

  std::vector<Found>& found_;
  std::vector<bool> frayed_;  // beside a closer surface that uncovers the background: its colours are mixed
  float half_;                // half a texel, in pixels
  float scale_, period_, one_surface_;
  int fringe_, eye_;
};

// Fills the hidden parts with the surface beside them, mirrored at the edge: of a hole's two sides, the farther one.
class Filling {
 public:
  // find: the nearness of a texel's column, in the row that contains a surface of a given nearness.
  template <class Find>
  static void fill(std::vector<Found>& found, bool is_turn, float scale, const Find& find) {
    const int width = static_cast<int>(found.size());
    int start = 0;
    while (start < width && found[static_cast<size_t>(start)].nearness < 0.0f) start++;
    if (start == width) return;
    for (int x = start; x < start + width;) {
      int end = x + 1;
      while (end < start + width && at(found, end).nearness < 0.0f) end++;
      const bool is_inside = is_turn || (x < width && end < width);
      if (end > x + 1 && is_inside) fill_hole(found, x, end, scale, find);
      x = end;
    }
  }

 private:
  static Found& at(std::vector<Found>& found, int x) { return found[static_cast<size_t>(x) % found.size()]; }

  template <class Find>
  static void fill_hole(std::vector<Found>& found, int left, int right, float scale, const Find& find) {
    const Found before = at(found, left), after = at(found, right);
    const bool from_left = before.nearness <= after.nearness;
    const Found& edge = from_left ? before : after;
    const float step = (after.column - before.column) / static_cast<float>(right - left);
    const bool is_crack = before.source_eye == after.source_eye && step > 0.0f && step < 2.0f * scale &&
                          is_one_surface(before.nearness, after.nearness);
    float column = edge.column;
    for (int k = 1; k < right - left; k++) {
      if (is_crack) {
        at(found, left + k) = {edge.nearness, before.column + step * static_cast<float>(k), edge.source_eye, false};
        continue;
      }
      const float mirrored = edge.column + (from_left ? -scale : scale) * static_cast<float>(k);
      if (is_one_surface(find(edge, mirrored), edge.nearness)) column = mirrored;
      at(found, from_left ? left + k : right - k) = {edge.nearness, column, edge.source_eye, true};
    }
  }
};

}  // namespace

// --- rows ------------------------------------------------------------------------------------------------------------

namespace {

// The surfaces that a picture's eye has along a row of the target.
struct Surfaces {
  Shifts shifts;
  Strip strip;
  bool is_level = false;  // all in one row of the picture
};

// Returns false if they are in too many rows, or partly outside the picture.
bool find_surfaces(const Mapping& mapping, const Reprojection& reprojection, RowOfTarget target, int source_eye,
                   float scale, Surfaces& found) {
  constexpr float kMaxRows = 6.0f, kLevel = 0.02f;
  constexpr size_t kFew = 9, kMany = 256;
  const int height = mapping.source.picture->size.height;
  const std::vector<float>& row_max = reprojection.row_max[static_cast<size_t>(source_eye)];
  const auto range = [&] {
    const int first = static_cast<int>(std::floor(found.shifts.row_of_min() - 0.5f));
    const int last = static_cast<int>(std::floor(found.shifts.row_of_max() - 0.5f)) + 1;
    return std::pair(std::clamp(first, 0, height - 1), std::clamp(last, 0, height - 1));
  };
  found.shifts.maximum = 1.0f / reprojection.nearest;
  if (!find_shifts(mapping, target, source_eye, scale, kFew, found.shifts)) return false;
  const auto [above, below] = range();
  found.shifts.maximum = std::max(1e-6f, *std::max_element(row_max.begin() + above, row_max.begin() + below + 1));
  const float across = std::abs(found.shifts.nodes.back().column - found.shifts.nodes.front().column);
  const size_t count = std::min(kMany, kFew + static_cast<size_t>(across));
  if (!find_shifts(mapping, target, source_eye, scale, count, found.shifts)) return false;
  const float rows = found.shifts.row_of_max() - found.shifts.row_of_min();
  if (rows > kMaxRows) return false;
  const auto [first, last] = range();
  found.strip.read(reprojection, source_eye, first, last);
  found.is_level = rows < kLevel;
  return true;
}

// The nearness of a column's surface where the row crosses it. Row and nearness depend on each other, so it iterates,
// from `start`.
float nearness_in(const Surfaces& surfaces, int column, float start, float one_surface) {
  float nearness = surfaces.strip.at(column, surfaces.shifts.at(start).row, one_surface);
  for (int round = 0; round < 3 && !surfaces.is_level; round++) {
    const float next = surfaces.strip.at(column, surfaces.shifts.at(nearness).row, one_surface);
    if (std::abs(next - nearness) <= 1e-4f * nearness) return next;
    if (round == 2 && !is_one_surface(next, nearness)) return kNothing;
    nearness = next;
  }
  return nearness;
}

}  // namespace

// Draws the surfaces that an eye of the picture has along the row. Where surfaces cross rows, a column may meet two of
// them: one is found starting from near, the other from far.
static void draw_surfaces(const Surfaces& surfaces, Extent picture, float scale, float period, float one_surface,
                          Drawing& drawing) {
  constexpr float kTwice = 0.25f;  // rows
  thread_local std::vector<Point> points;
  const float pixels = 1.0f / scale;  // per texel
  const bool twice = surfaces.shifts.row_of_max() - surfaces.shifts.row_of_min() > kTwice;
  for (const float start : {surfaces.shifts.maximum, 0.0f}) {
    points.clear();
    for (int c = 0; c < picture.width; c++) {
      const float nearness = nearness_in(surfaces, c, start, one_surface), column = static_cast<float>(c) + 0.5f;
      points.push_back({(column - surfaces.shifts.at(nearness).column) * pixels, nearness, column});
    }
    if (period > 0.0f) {
      const float columns = static_cast<float>(picture.width);
      points.push_back({points[0].x + period, points[0].nearness, points[0].column + columns});
    }
    drawing.draw(points);
    if (!twice) return;
  }
}

static SurfaceHit hit_of(const Found& found, const Shifts& shifts, float turn) {
  if (found.nearness < 0.0f) return {};
  const WarpNode node = shifts.at(found.nearness);
  const float column = turn > 0.0f ? found.column - turn * std::floor(found.column / turn) : found.column;
  const float depth = node.inverse_depth > 1e-6f ? 1.0f / node.inverse_depth : kFarDepth;
  return {{found.source_eye, {column, node.row}, true}, depth, found.is_filled};
}

bool RowWarp::warp(int index, int y, bool fills, std::vector<SurfaceHit>& row) const {
  const Extent picture = mapping_->source.picture->size;
  const int eyes = static_cast<int>(mapping_->source.picture->eyes.size());
  thread_local Surfaces surfaces[2];
  thread_local std::vector<Found> found;
  for (int eye = 0; eye < eyes; eye++) {
    if (!find_surfaces(*mapping_, *reprojection_, {index, y}, eye, scale_, surfaces[eye])) return false;
  }
  found.assign(static_cast<size_t>(mapping_->size.width), Found());
  const int fringe = 1 + static_cast<int>(density(mapping_->source.camera.projection, picture) * kBlur);
  for (int i = 0; i < eyes; i++) {
    const int eye = (mapping_->from[static_cast<size_t>(index)] + i) % eyes;
    Drawing drawing(found, scale_, period_, one_surface_, fringe, eye);
    draw_surfaces(surfaces[eye], picture, scale_, period_, one_surface_, drawing);
  }
  if (fills) {
    const auto find = [&](const Found& edge, float at) {
      const Surfaces& own = surfaces[edge.source_eye];
      const int whole = floor_of(at);
      const int column = period_ > 0.0f ? (whole % picture.width + picture.width) % picture.width
                                        : std::clamp(whole, 0, picture.width - 1);
      return own.strip.at(column, own.shifts.at(edge.nearness).row, one_surface_);
    };
    Filling::fill(found, std::lround(period_) == mapping_->size.width, scale_, find);
  }
  const float turn = period_ > 0.0f ? static_cast<float>(picture.width) : 0.0f;
  row.clear();
  for (const Found& each : found) row.push_back(hit_of(each, surfaces[each.source_eye].shifts, turn));
  return true;
}

}  // namespace ods
