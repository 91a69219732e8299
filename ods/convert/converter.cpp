// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/converter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace ods {

// --- plans -----------------------------------------------------------------------------------------------------------

SourcePlan make_plan(const StoredPicture& format, const ConvertTarget& target) {
  return {make_mapping(format, target), is_same_picture(format, target), {}};
}

void remember_rows(SourcePlan& plan) {
  const int height = plan.mapping.size.height, rows = height * static_cast<int>(plan.mapping.eyes.size());
  plan.rows.resize(static_cast<size_t>(rows));
  tbb::parallel_for(0, rows,
                    [&](int i) { plan.rows[static_cast<size_t>(i)] = plan_row(plan.mapping, i / height, i % height); });
}

// --- rows ------------------------------------------------------------------------------------------------------------

Converter::Converter(const SourcePlan& plan, const Source& source, bool moves_eyes, bool adds_alpha, Holes holes)
    : plan_(plan),
      mapping_(plan.mapping),
      resampler_(source, adds_alpha),
      holes_(holes),
      channels_(resampler_.channels()) {
  if (moves_eyes) {
    reprojection_ = make_reprojection(source);
    set_up_rows(*source.picture, adds_alpha);
  }
  const StoredPicture& picture = *source.picture;
  if (const std::optional<size_t> layer = depth_layer(picture)) {
    depth_channel_ = adds_alpha ? 1 : 0;
    for (size_t i = 0; i < *layer; i++) depth_channel_ += static_cast<int>(picture.eyes[0].layers[i].channels.size());
  }
}

// A target that is smaller than the picture is computed at least at the picture's resolution.
void Converter::set_up_rows(const StoredPicture& picture, bool adds_alpha) {
  constexpr int kMax = 8;
  fine_ = mapping_;
  for (finer_ = 1; finer_ <= kMax; finer_++) {
    fine_.size = {mapping_.size.width * finer_, mapping_.size.height * finer_};
    warp_ = RowWarp::make(fine_, *reprojection_);
    if (warp_) break;
  }
  for (size_t i = 0; i < picture.eyes[0].layers.size(); i++) {
    const LayerPixels& layer = picture.eyes[0].layers[i];
    averaged_.insert(averaged_.end(), layer.channels.size(), layer.rule != LayerRule::kNearest);
    if (i == 0 && adds_alpha) averaged_.push_back(true);
  }
}

void Converter::fill_stretch(const Row& row, const Stretch& stretch, const TexelBlock* block) const {
  const int x = stretch.x, count = stretch.count;
  constexpr int kAlike = static_cast<int>(kMaxAlike);
  PixelRun run(resampler_, stretch.source_eye, stretch.cell, block);
  for (int i = 0; i < count; i += kAlike) {
    const int alike = std::min(kAlike, count - i);
    vec2 places[kAlike];
    for (int k = 0; k < alike; k++) places[k] = stretch.at(static_cast<float>(i + k) * stretch.per_pixel);
    const float middle = static_cast<float>(i) + 0.5f * static_cast<float>(alike - 1);
    const std::optional<TexelTents> tents =
        stretch.is_sharp ? TexelTents() : texel_tents(stretch.footprint(middle * stretch.per_pixel));
    const bool together = run.add(tents, {places, static_cast<size_t>(alike)}, pixel_of(row, x + i));
    for (int k = 0; k < alike; k++) {
      if (!together) fill_alone(run, row, stretch, i + k);
      resampler_.finish({stretch.source_eye, places[k], true}, pixel_of(row, x + i + k));
    }
  }
  run.fill();
}

// Fills a pixel whose filter extends beyond its cell, or has no separate columns and rows.
void Converter::fill_alone(PixelRun& run, const Row& row, const Stretch& stretch, int i) const {
  const float t = static_cast<float>(i) * stretch.per_pixel;
  const Place place{stretch.source_eye, stretch.at(t), true};
  const Footprint footprint = stretch.footprint(t);
  const int x = stretch.x + i;
  float* pixel = pixel_of(row, x);
  if (run.add(texel_tents(footprint), {&place.at, 1}, pixel)) return;
  std::fill_n(pixel, channels_, 0.0f);
  std::vector<FilterPoint> points;
  filter_points(footprint, points);
  const bool is_near = points.size() == 1 || stays_in_cell(place, stretch.cell, points);
  const vec2 home = mapping_.home_of(x, row.y), size = mapping_.uv_of(1.0f, 1.0f);
  float weight = 0.0f;
  for (const FilterPoint& point : points) {
    const Place at = is_near ? Place{place.source_eye, place.at + point.texels, true}
                             : mapping_.find(row.index, home, home + point.pixels * size);
    if (!at.seen) continue;
    resampler_.add(at, is_near ? stretch.cell : mapping_.source_cell(at), point.weight, pixel);
    weight += point.weight;
  }
  if (is_near || weight <= 0.0f || weight > 0.9999f) return;
  for (int c = 0; c < resampler_.channels(); c++) pixel[c] /= weight;
}

void Converter::fill_single(const Row& row, const RowPlan& plan, const SinglePixel& single) const {
  float* pixel = pixel_of(row, single.x);
  std::fill_n(pixel, channels_, 0.0f);
  for (size_t i = single.first; i < single.first + single.count; i++) {
    const WeightedPlace& at = plan.places[i];
    resampler_.add(at.place, mapping_.source_cell(at.place), at.weight, pixel);
  }
  for (int c = 0; c < resampler_.channels() && single.weight != 1.0f; c++) pixel[c] /= single.weight;
  resampler_.finish(single.middle, pixel);
}

void Converter::fill_planned(const Row& row, const RowPlan& plan) const {
  for (const Stretch& stretch : plan.stretches) fill_stretch(row, stretch, nullptr);
  for (const SinglePixel& single : plan.singles) fill_single(row, plan, single);
}

// --- bands -----------------------------------------------------------------------------------------------------------

namespace {

// The box of the texels for stretches of several rows, if they are in one eye and cell.
class BlockBounds {
 public:
  void add(const Stretch& stretch) {
    if (is_empty_) eye_ = stretch.source_eye, cell_ = stretch.cell, is_empty_ = false;
    if (stretch.source_eye != eye_ || !same_cell(stretch.cell, cell_)) return;
    const float end = static_cast<float>(stretch.count - 1) * stretch.per_pixel;
    for (const float t : {0.0f, 0.5f * end, end}) {
      const vec2 at = stretch.at(t);
      const Footprint footprint = stretch.footprint(t);
      const float kCubic = 2.0f, kBetween = 0.25f;  // maximum distance of positions beyond these three
      const vec2 tents = stretch.is_sharp ? vec2(0.0f) : abs(footprint.dx) + abs(footprint.dy);
      const vec2 reach = tents + kCubic + kBetween;
      low_ = min(low_, at - reach), high_ = max(high_, at + reach);
    }
  }

  // Returns false if the block would be too large for a cache.
  bool set(Extent picture, TexelBlock& block) const {
    const int kMax = 12 * 1024;  // texels
    if (is_empty_) return false;
    block.source_eye = eye_;
    block.box = {std::max(static_cast<int>(low_.x), 0), std::max(static_cast<int>(low_.y), 0),
                 std::min(static_cast<int>(high_.x) + 1, picture.width),
                 std::min(static_cast<int>(high_.y) + 1, picture.height)};
    const int width = block.box.right - block.box.left, height = block.box.bottom - block.box.top;
    return width > 0 && height > 0 && width <= kMax / height;
  }

 private:
  bool is_empty_ = true;
  int eye_ = 0;
  Cell cell_;
  vec2 low_{1e9f}, high_{-1e9f};
};

}  // namespace

Converter::Converter(const SourcePlan& plan, const TexelReader& reader)
    : plan_(plan), mapping_(plan.mapping), resampler_(plan.mapping.source, reader), channels_(resampler_.channels()) {}

// Returns whether every pixel of a row of this width is filled.
static bool covers(const RowPlan& plan, int width) {
  size_t pixels = plan.singles.size();
  for (const Stretch& stretch : plan.stretches) pixels += static_cast<size_t>(stretch.count);
  return pixels == static_cast<size_t>(width);
}

void Converter::fill_band(int index, int y, int count, std::span<float> rows) const {
  constexpr int kColumns = 64;
  constexpr size_t kMaxRows = 32;
  assert(static_cast<size_t>(count) <= kMaxRows);
  const size_t width = static_cast<size_t>(mapping_.size.width) * static_cast<size_t>(channels_);
  const auto plan_of = [&](int i) -> const RowPlan& {
    return plan_.rows[static_cast<size_t>(index * mapping_.size.height + y + i)];
  };
  const auto row_of = [&](int i) { return Row{index, y + i, rows.subspan(static_cast<size_t>(i) * width, width)}; };
  thread_local TexelBlock block;
  std::array<size_t, kMaxRows> begin{}, end{};  // for each row, its range of stretches in the columns
  for (int i = 0; i < count; i++) {
    if (!covers(plan_of(i), mapping_.size.width)) clear(row_of(i).pixels);
  }
  for (int column = kColumns; column < mapping_.size.width + kColumns; column += kColumns) {
    BlockBounds bounds;
    for (int i = 0; i < count; i++) {
      const std::vector<Stretch>& stretches = plan_of(i).stretches;
      size_t& last = end[static_cast<size_t>(i)];
      begin[static_cast<size_t>(i)] = last;
      for (; last < stretches.size() && stretches[last].x < column; last++) bounds.add(stretches[last]);
    }
    const bool has_block = bounds.set(mapping_.source.picture->size, block);
    if (has_block) resampler_.read(block);
    for (int i = 0; i < count; i++) {
      for (size_t k = begin[static_cast<size_t>(i)]; k < end[static_cast<size_t>(i)]; k++) {
        fill_stretch(row_of(i), plan_of(i).stretches[k], has_block ? &block : nullptr);
      }
    }
  }
  for (int i = 0; i < count; i++) {
    for (const SinglePixel& single : plan_of(i).singles) fill_single(row_of(i), plan_of(i), single);
  }
}

// --- moved eyes ------------------------------------------------------------------------------------------------------

SurfaceHit Converter::meet(int index, vec2 home, vec2 uv) const {
  const Ray ray = mapping_.ray_of(index, home, uv);
  if (ray.direction == vec3(0.0f)) return {};
  return meet_surface(*reprojection_, mapping_.from[static_cast<size_t>(index)], ray, holes_ == Holes::kFilled);
}

// The footprint is computed from the line of sight alone: parallax changes it little, except at depth edges.
SurfaceHit Converter::fill_moved_pixel(const Row& row, int x) const {
  const vec2 home = mapping_.home_of(x, row.y), size = mapping_.uv_of(1.0f, 1.0f);
  const SurfaceHit met = meet(row.index, home, home);
  if (!met.place.seen) return {};
  const Place unmoved = mapping_.find(row.index, home, home);
  std::vector<FilterPoint> points;
  filter_points(unmoved.seen ? find_footprint(mapping_, row.index, x, row.y, unmoved) : Footprint(), points);
  float* pixel = pixel_of(row, x);
  float weight = 0.0f;
  for (const FilterPoint& point : points) {
    const SurfaceHit there = points.size() == 1 ? met : meet(row.index, home, home + point.pixels * size);
    if (!there.place.seen) continue;
    resampler_.add(there.place, mapping_.source_cell(there.place), point.weight, pixel);
    weight += point.weight;
  }
  if (weight <= 0.0f) return {};
  for (int c = 0; c < channels_; c++) pixel[c] /= weight;
  resampler_.finish(met.place, pixel);
  pixel[depth_channel_] = met.depth;
  return met;
}

// Fills adjacent pixels whose hits are in one eye of the picture.
void Converter::fill_hits(PixelRun& run, const Row& row, int x, std::span<const SurfaceHit> hits) const {
  vec2 places[kMaxAlike];
  for (size_t i = 0; i < hits.size(); i++) places[i] = hits[i].place.at;
  const bool together = run.add(TexelTents(), {places, hits.size()}, pixel_of(row, x));
  for (size_t i = 0; i < hits.size(); i++) {
    float* pixel = pixel_of(row, x + static_cast<int>(i));
    const Place& place = hits[i].place;
    if (!together) resampler_.add(place, mapping_.source_cell(place), 1.0f, pixel);
    resampler_.finish(place, pixel);
    pixel[depth_channel_] = hits[i].depth;
  }
}

RowHoles Converter::fill_warped(const Row& row, const std::vector<SurfaceHit>& hits) const {
  const Extent size = mapping_.source.picture->size;
  RowHoles holes;
  for (size_t x = 0; x < hits.size();) {
    const Place& first = hits[x].place;
    if (!first.seen) {
      holes.empty++, x++;
      continue;
    }
    PixelRun run(resampler_, first.source_eye, {0, 0, size.width, size.height});
    while (x < hits.size() && hits[x].place.seen && hits[x].place.source_eye == first.source_eye) {
      size_t end = x;
      while (end < std::min(hits.size(), x + kMaxAlike) && hits[end].place.seen &&
             hits[end].place.source_eye == first.source_eye) {
        holes.filled += hits[end++].is_filled;
      }
      fill_hits(run, row, static_cast<int>(x), {&hits[x], end - x});
      x = end;
    }
    run.fill();
  }
  return holes;
}

std::optional<RowHoles> Converter::fill_by_rows(const Row& row) const {
  thread_local std::vector<SurfaceHit> hits;
  if (!warp_->warp(row.index, row.y, holes_ == Holes::kFilled, hits)) return {};
  return fill_warped(row, hits);
}

// Averages the finer rows' pixels; layers that may not be averaged take the middle pixel, depth the nearest one.
std::optional<RowHoles> Converter::fill_by_finer_rows(const Row& row) const {
  thread_local std::vector<float> fine;
  const size_t channels = static_cast<size_t>(channels_), finer = static_cast<size_t>(finer_);
  const size_t depth = static_cast<size_t>(depth_channel_);
  const float share = 1.0f / static_cast<float>(finer_ * finer_);
  RowHoles holes;
  for (int j = 0; j < finer_; j++) {
    fine.assign(row.pixels.size() * finer, 0.0f);
    for (size_t i = depth; i < fine.size(); i += channels) fine[i] = kFarDepth;
    const std::optional<RowHoles> own = fill_by_rows({row.index, row.y * finer_ + j, fine});
    if (!own) return {};
    holes.empty += own->empty, holes.filled += own->filled;
    for (size_t i = 0; i < fine.size(); i++) {
      const size_t c = i % channels, column = i / channels;
      float& to = row.pixels[column / finer * channels + c];
      if (c == depth) {
        to = std::min(to, fine[i]);
      } else if (averaged_[c]) {
        to += share * fine[i];
      } else if (j == finer_ / 2 && column % finer == finer / 2) {
        to = fine[i];
      }
    }
  }
  return RowHoles{holes.empty / (finer_ * finer_), holes.filled / (finer_ * finer_)};
}

RowHoles Converter::fill_moved(const Row& row) const {
  if (warp_) {
    if (const auto done = finer_ > 1 ? fill_by_finer_rows(row) : fill_by_rows(row)) return *done;
    clear(row.pixels);
  }
  RowHoles holes;
  for (int x = 0; x < mapping_.size.width; x++) {
    if (!mapping_.wants(x, row.y)) continue;
    const SurfaceHit met = fill_moved_pixel(row, x);
    holes.empty += !met.place.seen, holes.filled += met.is_filled;
  }
  return holes;
}

void Converter::clear(std::span<float> row) const {
  std::fill(row.begin(), row.end(), 0.0f);
  const size_t first = static_cast<size_t>(depth_channel_), step = static_cast<size_t>(channels_);
  for (size_t i = first; depth_channel_ >= 0 && i < row.size(); i += step) row[i] = kFarDepth;
}

RowHoles Converter::fill(int index, int y, std::span<float> row) const {
  if (plan_.is_same) {
    resampler_.copy(mapping_.from[static_cast<size_t>(index)], y, row);
    return {};
  }
  clear(row);
  if (reprojection_) return fill_moved({index, y, row});
  if (plan_.rows.empty()) {
    const RowPlan plan = plan_row(mapping_, index, y);
    fill_planned({index, y, row}, plan);
    return {plan.empty, 0};
  }
  const RowPlan& plan = plan_.rows[static_cast<size_t>(index * mapping_.size.height + y)];
  fill_planned({index, y, row}, plan);
  return {plan.empty, 0};
}

}  // namespace ods
