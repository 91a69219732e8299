// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "ods/convert/reproject.h"
#include "ods/convert/resample.h"
#include "ods/files/scratch.h"

namespace ods {

// --- what can be converted ------------------------------------------------------------------------------------------

ConvertTarget same_format(const StoredPicture& picture) {
  ConvertTarget format{picture.camera, picture.size, {}};
  for (const StoredEye& eye : picture.eyes) format.eyes.push_back(eye.eye);
  return format;
}

std::vector<RowLayer> row_layers(const StoredPicture& picture) {
  std::vector<RowLayer> layers;
  for (const LayerPixels& layer : picture.eyes[0].layers) {
    const SampleType sample = layer.sample == SampleType::kFloat ? SampleType::kFloat : SampleType::kHalf;
    layers.push_back({layer.channels, layer.rule, sample});
  }
  return layers;
}

static bool is_tilted(const StereoCamera& from, const StereoCamera& to) {
  return length(axis_in_world(make_camera(from)) - axis_in_world(make_camera(to))) > 1e-4f;
}

// Whether the target's eyes are in other places than the picture's. A mono target takes one eye unchanged.
static bool sees_around(const StoredPicture& picture, const ConvertTarget& target) {
  if (target.eyes[0] == kMono) return false;
  return picture.eyes[0].eye == kMono || !same_eyes(picture.camera, target.camera);
}

std::string conversion_fault(const StoredPicture& picture, const ConvertTarget& target) {
  const std::vector<int> eyes = same_format(picture).eyes;
  const bool from_mono = eyes[0] == kMono;
  if (picture.camera.mirrored != target.camera.mirrored) return "a mirrored picture stays mirrored";
  if (target.eyes[0] == kMono) return "";
  for (const int eye : target.eyes) {
    if (!from_mono && std::find(eyes.begin(), eyes.end(), eye) == eyes.end()) {
      return fmt::format("the picture has no {} eye", eye_name(eye));
    }
  }
  if (!from_mono && is_tilted(picture.camera, target.camera)) {
    return "a stereo picture turns about its viewing circle's axis only (yaw): pitched or rolled, its eyes would need "
           "lines of sight that nobody has seen; a mono one can be tilted";
  }
  if (!sees_around(picture, target) || depth_layer(picture)) return "";
  if (from_mono) return "the picture is of one eye in the middle, and has no depth from which two could be made";
  return "eyes at other places see around things otherwise, which needs depth: render to .exr, which keeps it";
}

Extent fitting_extent(const StoredPicture& picture, const ProjectionSetting& projection) {
  const ProjectionSetting& own = picture.camera.projection;
  const double natural = natural_height(own, picture.size.width);
  const double stretch = std::max(1.0, picture.size.height / natural);  // for eyes that are squeezed horizontally
  const double width = stretch * pixels_per_radian(own, picture.size.width) / pixels_per_radian(projection, 1.0);
  const int step = width_step(projection) == 1 ? 4 : 2 * width_step(projection);
  Extent extent;
  extent.width = std::max(1, static_cast<int>(std::lround(std::min(width, double{kMaxSide}) / step))) * step;
  extent.height = natural_height(projection, extent.width);
  extent.height += extent.height % 2;
  return extent;
}

// --- where a pixel is in the source --------------------------------------------------------------------------------

namespace {

// Maps the target's pixels to places in the source.
struct Mapping {
  StereoCamera stereo;  // owns the maps that `camera` reads
  Source source;
  Camera camera;  // of the target, with its centre at 0
  Extent size;
  std::vector<int> eyes;
  std::vector<int> from;  // for each eye of the target: its index in the source

  Place find(int index, vec2 home, vec2 uv) const;
  Ray ray_of(int index, vec2 home, vec2 uv) const {
    return camera_ray(camera, eyes[static_cast<size_t>(index)], home, uv, vec2(0.0f));
  }
  vec2 uv_of(float x, float y) const {
    return {x / static_cast<float>(size.width), y / static_cast<float>(size.height)};
  }
  Cell cell_at(int x, int y) const {
    return cell_of(camera.projection, size, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  }
  Cell source_cell(const Place& place) const {
    return cell_of(source.camera.projection, source.picture->size, place.at);
  }
  vec2 home_of(int x, int y) const { return uv_of(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f); }
  // Whether the target has a picture at this pixel: fisheyes have empty corners.
  bool wants(int x, int y) const {
    return !has_image_circle(camera.projection.kind) || look_of(camera.projection, home_of(x, y), home_of(x, y)).seen;
  }
};

// uv may be outside the cell of `home`: the target's own filter reaches there.
Place Mapping::find(int index, vec2 home, vec2 uv) const {
  const size_t i = static_cast<size_t>(index);
  const Ray ray = ray_of(index, home, uv);
  if (ray.direction == vec3(0.0f)) return {};
  int source_eye = from[i];
  if (camera.projection.kind == kLatLong && eyes[i] != kMono) {
    const float phi = camera.projection.center.y + (0.5f - uv.y) * camera.projection.span.y;
    if (abs(phi) > 0.5f * kPi) source_eye = eye_over_pole(source, source_eye, phi > 0.0f);
  }
  return place_of_line(source, source_eye, ray.direction);
}

// Whether every target pixel is a texel of the picture.
bool is_as_stored(const StoredPicture& picture, const ConvertTarget& target) {
  StereoCamera stereo = target.camera;
  stereo.position = picture.camera.position, stereo.lens_radius = picture.camera.lens_radius;
  stereo.focus_distance = picture.camera.focus_distance;
  const auto has_eye = [&](int eye) { return picture.eyes[static_cast<size_t>(eye_index(picture, eye))].eye == eye; };
  return stereo == picture.camera && !has_image_circle(stereo.projection.kind) &&
         target.eye.width == picture.size.width && target.eye.height == picture.size.height &&
         std::all_of(target.eyes.begin(), target.eyes.end(), has_eye);
}

Mapping make_mapping(const StoredPicture& picture, const ConvertTarget& target) {
  Mapping mapping{target.camera, make_source(picture), make_camera(target.camera), target.eye, target.eyes, {}};
  mapping.camera.center = vec3(0.0f);
  mapping.camera.lens_radius = 0.0f;
  for (const int eye : target.eyes) mapping.from.push_back(eye_index(picture, eye == kMono ? target.mono_from : eye));
  return mapping;
}

// --- pixels --------------------------------------------------------------------------------------------------------

// A row of a cell of the target, filled from left to right.
struct CellRow {
  int index;  // of the eye, in the target
  int y;
  Cell cell;
  std::span<float> pixels;  // the whole row of the eye
};

// The place of a pixel's centre, and that of its neighbour below or above, away from the nearer edge of the cell:
// beyond a pole another picture begins.
struct Node {
  Place at;
  Place beside;
  Cell cell;  // in the source
};

// Part of a row whose places follow a parabola to 1/100 texel, so that its pixels need no trigonometry of their own.
constexpr int kLongStretch = 64;
constexpr int kShortStretch = 8;
struct Stretch {
  int source_eye;
  Cell cell;        // in the source
  float per_pixel;  // step of t from one pixel to the next
  vec2 start;
  vec2 step;     // from the start to the middle
  vec2 bend;     // difference between the second step and the first
  vec2 down[3];  // offset to the place one pixel below, for each of the three

  // `t`: 0 at the start, 1 in the middle, 2 at the end. Footprints change slowly.
  vec2 at(float t) const { return start + step * t + bend * (0.5f * t * (t - 1.0f)); }
  Footprint footprint(float t) const {
    const vec2 dy = t < 1.0f ? mix(down[0], down[1], t) : mix(down[1], down[2], t - 1.0f);
    return {(step + bend * (t - 0.5f)) * per_pixel, dy};
  }
};

class Converter {
 public:
  Converter(const StoredPicture& picture, const ConvertTarget& target, bool is_as_stored, bool adds_alpha)
      : mapping_(make_mapping(picture, target)),
        resampler_(mapping_.source, adds_alpha),
        channels_(resampler_.channels()),
        is_as_stored_(is_as_stored) {
    if (sees_around(picture, target)) reprojection_ = make_reprojection(mapping_.source);
    if (const std::optional<size_t> layer = depth_layer(picture)) {
      depth_channel_ = adds_alpha ? 1 : 0;
      for (size_t i = 0; i < *layer; i++) depth_channel_ += static_cast<int>(picture.eyes[0].layers[i].channels.size());
    }
  }
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;

  int64_t no_depth() const { return reprojection_ ? reprojection_->no_depth : 0; }

  // Returns the number of empty pixels.
  int fill(int index, int y, std::span<float> row) const;

 private:
  Node find_node(const CellRow& row, int x) const;
  int fill_cell(const CellRow& row) const;
  int fill_between(const CellRow& row, int x, int pixels, const Node& first, const Node& last) const;
  int fill_pixels(const CellRow& row, int x, int end) const;
  Footprint find_footprint(int index, const Cell& cell, int x, int y, const Place& place) const;
  void fill_stretch(const CellRow& row, const Stretch& stretch, int x, int count) const;
  void fill_alone(PixelRun& run, const CellRow& row, const Stretch& stretch, int x, int i) const;
  bool fill_pixel(const CellRow& row, int x) const;
  bool fill_moved_pixel(const CellRow& row, int x) const;
  SurfaceHit meet(int index, vec2 home, vec2 uv) const;
  void sum_near(const Place& place, const Cell& cell, const std::vector<FilterPoint>& points, float* sums) const;
  void sum_exactly(int index, vec2 home, const std::vector<FilterPoint>& points, float* sums) const;
  bool stays_in_cell(const Place& place, const Cell& cell, const std::vector<FilterPoint>& points) const;
  bool is_flat(int index, vec2 home, const Place& place, const std::vector<FilterPoint>& points) const;
  float* pixel_of(const CellRow& row, int x) const {
    return row.pixels.data() + static_cast<size_t>(x) * static_cast<size_t>(channels_);
  }

  Mapping mapping_;
  Resampler resampler_;
  std::optional<Reprojection> reprojection_;
  int channels_;
  int depth_channel_ = -1;  // in a pixel of a row; below 0: there is no depth
  bool is_as_stored_;
};

bool same_cell(const Cell& a, const Cell& b) {
  return a.left == b.left && a.top == b.top;
}

// The direction away from the nearer edge.
int way_down(const CellRow& row) {
  return 2 * row.y < row.cell.top + row.cell.bottom ? 1 : -1;
}

Node Converter::find_node(const CellRow& row, int x) const {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(row.y) + 0.5f;
  const vec2 home = mapping_.home_of((row.cell.left + row.cell.right) / 2, (row.cell.top + row.cell.bottom) / 2);
  const Place at = mapping_.find(row.index, home, mapping_.uv_of(px, py));
  const Place beside = mapping_.find(row.index, home, mapping_.uv_of(px, py + static_cast<float>(way_down(row))));
  return {at, beside, mapping_.source_cell(at)};
}

std::optional<Stretch> find_stretch(const Node& first, const Node& middle, const Node& last, int pixels, int way) {
  Stretch stretch{first.at.source_eye, first.cell, 2.0f / static_cast<float>(pixels), first.at.at, {}, {}, {}};
  stretch.step = middle.at.at - first.at.at;
  stretch.bend = last.at.at - 2.0f * middle.at.at + first.at.at;
  vec2* down = stretch.down;
  for (const Node* node : {&first, &middle, &last}) {
    if (!node->at.seen || !node->beside.seen || node->at.source_eye != stretch.source_eye ||
        node->beside.source_eye != stretch.source_eye || !same_cell(node->cell, stretch.cell))
      return {};
    *down++ = (node->beside.at - node->at.at) * static_cast<float>(way);
  }
  const float texels = length(stretch.step) * stretch.per_pixel;
  const float turn = length(stretch.down[1] - stretch.down[0]) + length(stretch.down[2] - stretch.down[1]);
  const float most = pixels > 2 * kShortStretch ? 8.0f / static_cast<float>(pixels) : 1.0f;
  if (length(stretch.bend) > most * (1.0f + 0.1f * texels) || turn > most * (0.25f + 0.25f * length(stretch.down[1])))
    return {};
  return stretch;
}

// Tries neighbours in the same cell of the source, the one away from the target's edge first; then nearer points.
Footprint Converter::find_footprint(int index, const Cell& cell, int x, int y, const Place& place) const {
  const vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const vec2 home = mapping_.uv_of(middle.x, middle.y);
  const Projection& projection = mapping_.source.camera.projection;
  const Extent size = mapping_.source.picture->size;
  const Cell own = cell_of(projection, size, place.at);
  const bool round = has_range(projection.kind);                                       // columns wrap
  const float turn = static_cast<float>(size.width) * 2.0f * kPi / projection.span.x;  // columns of 360 degrees
  const auto neighbour = [&](vec2 way, bool away) {
    for (const float step : {away ? -1.0f : 1.0f, away ? 1.0f : -1.0f, 0.1f, -0.1f}) {
      const vec2 at = middle + way * step;
      const Place there = mapping_.find(index, home, mapping_.uv_of(at.x, at.y));
      if (!there.seen || there.source_eye != place.source_eye || !same_cell(own, cell_of(projection, size, there.at)))
        continue;
      vec2 move = there.at - place.at;
      if (round) move.x -= turn * std::round(move.x / turn);
      return move / step;
    }
    return vec2(0.0f);
  };
  return {neighbour({1.0f, 0.0f}, 2 * x > cell.left + cell.right),
          neighbour({0.0f, 1.0f}, 2 * y > cell.top + cell.bottom)};
}

bool Converter::stays_in_cell(const Place& place, const Cell& cell, const std::vector<FilterPoint>& points) const {
  return std::all_of(points.begin(), points.end(), [&](const FilterPoint& point) {
    const vec2 at = place.at + point.texels;
    return at.x >= static_cast<float>(cell.left) && at.x < static_cast<float>(cell.right) &&
           at.y >= static_cast<float>(cell.top) && at.y < static_cast<float>(cell.bottom);
  });
}

// Whether the footprint predicts the places of the filter's far points correctly.
bool Converter::is_flat(int index, vec2 home, const Place& place, const std::vector<FilterPoint>& points) const {
  if (!stays_in_cell(place, mapping_.source_cell(place), points)) return false;
  for (const FilterPoint& point : {points.front(), points.back()}) {
    const Place there = mapping_.find(index, home, home + point.pixels * mapping_.uv_of(1.0f, 1.0f));
    if (!there.seen || there.source_eye != place.source_eye || length(there.at - place.at - point.texels) > 0.1f)
      return false;
  }
  return true;
}

void Converter::sum_near(const Place& place, const Cell& cell, const std::vector<FilterPoint>& points,
                         float* sums) const {
  for (const FilterPoint& point : points) {
    resampler_.add({place.source_eye, place.at + point.texels, true}, cell, point.weight, sums);
  }
}

// Normalizes the weights where the source ends inside the pixel.
void Converter::sum_exactly(int index, vec2 home, const std::vector<FilterPoint>& points, float* sums) const {
  float weight = 0.0f;
  const vec2 pixel = mapping_.uv_of(1.0f, 1.0f);
  for (const FilterPoint& point : points) {
    const Place place = mapping_.find(index, home, home + point.pixels * pixel);
    if (!place.seen) continue;
    resampler_.add(place, mapping_.source_cell(place), point.weight, sums);
    weight += point.weight;
  }
  if (weight <= 0.0f || weight > 0.9999f) return;
  for (int c = 0; c < resampler_.channels(); c++) sums[c] /= weight;
}

void Converter::fill_stretch(const CellRow& row, const Stretch& stretch, int x, int count) const {
  constexpr int kAlike = static_cast<int>(kMaxAlike);
  PixelRun run(resampler_, stretch.source_eye, stretch.cell);
  for (int i = 0; i < count; i += kAlike) {
    const int alike = std::min(kAlike, count - i);
    vec2 places[kAlike];
    for (int k = 0; k < alike; k++) places[k] = stretch.at(static_cast<float>(i + k) * stretch.per_pixel);
    const float middle = static_cast<float>(i) + 0.5f * static_cast<float>(alike - 1);
    const Footprint footprint = stretch.footprint(middle * stretch.per_pixel);
    const bool together = run.add(texel_tents(footprint), {places, static_cast<size_t>(alike)}, pixel_of(row, x + i));
    for (int k = 0; k < alike; k++) {
      if (!together) fill_alone(run, row, stretch, x, i + k);
      resampler_.finish({stretch.source_eye, places[k], true}, pixel_of(row, x + i + k));
    }
  }
  run.fill();
}

void Converter::fill_alone(PixelRun& run, const CellRow& row, const Stretch& stretch, int x, int i) const {
  const float t = static_cast<float>(i) * stretch.per_pixel;
  const Place place{stretch.source_eye, stretch.at(t), true};
  const Footprint footprint = stretch.footprint(t);
  float* pixel = pixel_of(row, x + i);
  if (run.add(texel_tents(footprint), {&place.at, 1}, pixel)) return;
  std::vector<FilterPoint> points;
  filter_points(footprint, points);
  const bool is_near = points.size() == 1 || stays_in_cell(place, stretch.cell, points);
  if (is_near) return sum_near(place, stretch.cell, points, pixel);
  sum_exactly(row.index, mapping_.home_of(x + i, row.y), points, pixel);
}

bool Converter::fill_pixel(const CellRow& row, int x) const {
  const vec2 home = mapping_.home_of(x, row.y);
  const Place place = mapping_.find(row.index, home, home);
  if (!place.seen) return false;
  std::vector<FilterPoint> points;
  filter_points(find_footprint(row.index, row.cell, x, row.y, place), points);
  float* pixel = pixel_of(row, x);
  if (points.size() == 1 || is_flat(row.index, home, place, points)) {
    sum_near(place, mapping_.source_cell(place), points, pixel);
  } else {
    sum_exactly(row.index, home, points, pixel);
  }
  resampler_.finish(place, pixel);
  return true;
}

SurfaceHit Converter::meet(int index, vec2 home, vec2 uv) const {
  const Ray ray = mapping_.ray_of(index, home, uv);
  if (ray.direction == vec3(0.0f)) return {};
  return meet_surface(*reprojection_, mapping_.from[static_cast<size_t>(index)], ray);
}

// The footprint is that of the line of sight alone: parallax changes it little, except at depth edges.
bool Converter::fill_moved_pixel(const CellRow& row, int x) const {
  const vec2 home = mapping_.home_of(x, row.y), size = mapping_.uv_of(1.0f, 1.0f);
  const SurfaceHit met = meet(row.index, home, home);
  if (!met.place.seen) return false;
  const Place unmoved = mapping_.find(row.index, home, home);
  std::vector<FilterPoint> points;
  filter_points(unmoved.seen ? find_footprint(row.index, row.cell, x, row.y, unmoved) : Footprint(), points);
  float* pixel = pixel_of(row, x);
  float weight = 0.0f;
  for (const FilterPoint& point : points) {
    const SurfaceHit there = points.size() == 1 ? met : meet(row.index, home, home + point.pixels * size);
    if (!there.place.seen) continue;
    resampler_.add(there.place, mapping_.source_cell(there.place), point.weight, pixel);
    weight += point.weight;
  }
  if (weight <= 0.0f) return false;
  for (int c = 0; c < channels_; c++) pixel[c] /= weight;
  resampler_.finish(met.place, pixel);
  pixel[depth_channel_] = met.depth;
  return true;
}

// Fills pixels one by one and returns the number of empty ones.
int Converter::fill_pixels(const CellRow& row, int x, int end) const {
  int empty = 0;
  for (; x < end; x++) {
    if (!mapping_.wants(x, row.y)) continue;
    const bool filled = reprojection_ ? fill_moved_pixel(row, x) : fill_pixel(row, x);
    empty += filled ? 0 : 1;
  }
  return empty;
}

// Likewise for up to a stretch of pixels; its end may be beyond the cell's.
int Converter::fill_between(const CellRow& row, int x, int pixels, const Node& first, const Node& last) const {
  if (x >= row.cell.right) return 0;
  const int end = std::min(x + pixels, row.cell.right), half = pixels / 2;
  const Node middle = find_node(row, x + half);
  const bool wanted = mapping_.wants(x, row.y) && mapping_.wants(end - 1, row.y);
  if (const auto stretch = find_stretch(first, middle, last, pixels, way_down(row)); stretch && wanted) {
    fill_stretch(row, *stretch, x, end - x);
    return 0;
  }
  if (pixels == kShortStretch) return fill_pixels(row, x, end);
  return fill_between(row, x, half, first, middle) + fill_between(row, x + half, half, middle, last);
}

int Converter::fill_cell(const CellRow& row) const {
  if (reprojection_) return fill_pixels(row, row.cell.left, row.cell.right);
  int empty = 0;
  Node first = find_node(row, row.cell.left);
  for (int x = row.cell.left; x < row.cell.right;) {
    int pixels = kLongStretch;
    while (pixels > kShortStretch && pixels / 2 >= row.cell.right - x) pixels /= 2;
    const Node last = find_node(row, x + pixels);
    empty += fill_between(row, x, pixels, first, last);
    first = last;
    x += pixels;
  }
  return empty;
}

int Converter::fill(int index, int y, std::span<float> row) const {
  if (is_as_stored_) {
    resampler_.copy(mapping_.from[static_cast<size_t>(index)], y, row);
    return 0;
  }
  std::fill(row.begin(), row.end(), 0.0f);
  const size_t first = static_cast<size_t>(depth_channel_), step = static_cast<size_t>(channels_);
  for (size_t i = first; depth_channel_ >= 0 && i < row.size(); i += step) row[i] = kFarDepth;
  int empty = 0;
  for (int x = 0; x < mapping_.size.width;) {
    const Cell cell = mapping_.cell_at(x, y);
    empty += fill_cell({index, y, cell, row});
    x = cell.right;
  }
  return empty;
}

}  // namespace

// --- rows ----------------------------------------------------------------------------------------------------------

// Whether the target has pixels where the source has none, judged by a grid of samples.
static bool sees_more(const StoredPicture& picture, const ConvertTarget& target) {
  const Mapping mapping = make_mapping(picture, target);
  const int kLooks = 128;
  for (int i = 0; i < kLooks * kLooks; i++) {
    const vec2 uv((static_cast<float>(i % kLooks) + 0.5f) / kLooks, (static_cast<float>(i / kLooks) + 0.5f) / kLooks);
    if (look_of(mapping.camera.projection, uv, uv).seen && !mapping.find(0, uv, uv).seen) return true;
  }
  return false;
}

Conversion convert(const StoredPicture& picture, const ConvertTarget& target) {
  assert(conversion_fault(picture, target).empty());
  Conversion conversion;
  conversion.rows.eye = target.eye;
  conversion.rows.eyes = target.eyes;
  conversion.rows.layers = row_layers(picture);
  std::vector<std::string>& colour = conversion.rows.layers[0].channels;
  conversion.sees_around = sees_around(picture, target);
  const bool as_stored = is_as_stored(picture, target);
  const bool adds_alpha = colour.back() != "A" && !as_stored && (conversion.sees_around || sees_more(picture, target));
  if (adds_alpha) colour.push_back("A");
  const auto converter = std::make_shared<const Converter>(picture, target, as_stored, adds_alpha);
  conversion.no_depth = converter->no_depth();
  conversion.rows.fill = [converter, empty = conversion.empty](int index, int y, std::span<float> row) {
    *empty += converter->fill(index, y, row);
  };
  if (picture.memory) conversion.rows.band_done = [memory = picture.memory] { memory->release(); };
  return conversion;
}

}  // namespace ods
