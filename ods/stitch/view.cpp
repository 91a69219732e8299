// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/view.h"

#include <algorithm>
#include <cmath>

#include "ods/camera/pixel.h"
#include "ods/convert/convert.h"

namespace ods {

LayerSet layers_of(const StoredPicture& picture) {
  LayerSet layers;
  layers.layers = row_layers(picture);
  const std::optional<size_t> depth = depth_layer(picture);
  for (size_t i = 0; i < layers.layers.size(); i++) {
    const RowLayer& layer = layers.layers[i];
    if (depth == i) layers.depth = static_cast<int>(layers.channels);
    layers.channels += layer.channels.size();
    layers.is_nearest.resize(layers.channels, layer.rule == LayerRule::kNearest);
  }
  const auto first = std::find(layers.is_nearest.begin(), layers.is_nearest.end(), 1);
  layers.first_nearest = static_cast<size_t>(first - layers.is_nearest.begin());
  return layers;
}

bool same_layers(const LayerSet& a, const LayerSet& b) {
  const auto same = [](const RowLayer& x, const RowLayer& y) { return x.channels == y.channels && x.rule == y.rule; };
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same);
}

static StoredPicture posed(StoredPicture picture, const StereoCamera& pose) {
  picture.camera = pose;
  return picture;
}

View::View(StoredPicture picture, const StereoCamera& pose, ViewDepth depth)
    : picture_(posed(std::move(picture), pose)),
      layers_(layers_of(picture_)),
      source_(make_source(picture_)),
      resampler_(source_),
      camera_(make_camera(pose)) {
  const std::optional<size_t> layer = depth_layer(picture_);
  if (!layer || depth == ViewDepth::kNone) return;
  if (depth == ViewDepth::kPlane) measure_along_rays(*layer);
  surfaces_ = make_reprojection(source_);
}

// Converts a depth buffer's metres, along the view's axis, to metres along rays.
void View::measure_along_rays(size_t index) {
  LayerPixels& layer = picture_.eyes[0].layers[index];
  const Extent size = picture_.size;
  const vec2 half = source_.camera.projection.half_size;
  distances_.reserve(static_cast<size_t>(size.width) * static_cast<size_t>(size.height));
  for (int y = 0; y < size.height; y++) {
    for (int x = 0; x < size.width; x++) {
      const float depth = sample_value(layer.sample, layer.first + y * layer.row_stride + x * layer.pixel_stride);
      const vec2 slope = (2.0f * pixel_middle(x, y, size) - 1.0f) * half;
      distances_.push_back(depth < 0.1f * kFarDepth ? depth * std::sqrt(1.0f + dot(slope, slope)) : kFarDepth);
    }
  }
  layer.sample = SampleType::kFloat;
  layer.first = reinterpret_cast<const std::byte*>(distances_.data());
  layer.pixel_stride = sizeof(float);
  layer.row_stride = layer.pixel_stride * size.width;
}

// --- pixels ----------------------------------------------------------------------------------------------------------

static Cell all_of(const StoredPicture& picture) {
  return {0, 0, picture.size.width, picture.size.height};
}

void View::sum_points(const Footprint& footprint, const Place& place, float* out) const {
  thread_local std::vector<FilterPoint> points;
  filter_points(footprint, points);
  std::fill(out, out + layers_.channels, 0.0f);
  for (const FilterPoint& point : points) {
    resampler_.add({0, place.at + point.texels, true}, all_of(picture_), point.weight, out);
  }
}

// Adds adjacent pixels that share a footprint.
void View::add_pixels(PixelRun& run, const Footprint& footprint, std::span<const vec2> places, float* pixels) const {
  const std::optional<TexelTents> tents = texel_tents(footprint);
  const bool together = run.add(tents, places, pixels);
  for (const vec2& at : places) {
    const Place place{0, at, true};
    if (!together && !run.add(tents, {&at, 1}, pixels)) sum_points(footprint, place, pixels);
    resampler_.finish(place, pixels);
    pixels += layers_.channels;
  }
}

static Footprint footprint_in(const RowInView& row, float x, float way) {
  const RayInView seen = ray_along(row, x);
  return {ray_along(row, x + 0.5f).at - ray_along(row, x - 0.5f).at, (seen.beside - seen.at) * way};
}

// Footprints change slowly along a row, so a few pixels share that of their centre.
void View::fill_alike(const RowInView& row, float way, int left, std::span<float> out) const {
  const size_t count = out.size() / layers_.channels;
  PixelRun run(resampler_, 0, all_of(picture_));
  for (size_t i = 0; i < count; i += kMaxAlike) {
    const size_t alike = std::min(count - i, kMaxAlike);
    RayInView seen[kMaxAlike];
    vec2 places[kMaxAlike];
    const float first = static_cast<float>(left) + static_cast<float>(i) + 0.5f;
    for (size_t k = 0; k < kMaxAlike; k++) {
      seen[k] = ray_along(row, first + static_cast<float>(k));
      places[k] = seen[k].at;
    }
    float* pixels = &out[i * layers_.channels];
    add_pixels(run, footprint_in(row, first + 0.5f * static_cast<float>(alike - 1), way), {places, alike}, pixels);
    for (size_t k = 0; k < alike && layers_.depth >= 0; k++) {
      float& depth = pixels[k * layers_.channels + static_cast<size_t>(layers_.depth)];
      if (depth < 0.1f * kFarDepth) depth += seen[k].nearer;
    }
  }
  run.fill();
}

// Traces the view's surfaces if it has depth. Returns whether the view shows the point that the ray hits.
bool View::fill_pixel(const Ray& ray, const RayInView& seen, const Footprint& footprint, float* out) const {
  const SurfaceHit met =
      surfaces_ ? meet_surface(*surfaces_, 0, {ray.origin - camera_.center, ray.direction}) : SurfaceHit{{}, kFarDepth};
  const Place place = met.place.seen ? met.place : Place{0, seen.at, true};
  PixelRun run(resampler_, 0, all_of(picture_));
  add_pixels(run, footprint, {&place.at, 1}, out);
  run.fill();
  if (layers_.depth < 0) return met.place.seen || !surfaces_;
  float& depth = out[layers_.depth];
  if (met.place.seen) {
    depth = met.depth;
  } else if (depth < 0.1f * kFarDepth) {
    depth += seen.nearer;
  }
  return met.place.seen || !surfaces_;
}

int View::fill(const PictureRays& rays, const RowInView& row, int y, int left, std::span<float> out) const {
  const RayInView* at = row.rays;
  const vec2 bend = at[2].at - 2.0f * at[1].at + at[0].at;
  const vec2 turn = at[2].beside - 2.0f * at[1].beside + at[0].beside;
  const bool is_parabola = length(bend) < 1.0f && length(turn) < 1.0f;
  const float py = static_cast<float>(y) + 0.5f, way = rays.way(py);
  if (!surfaces_ && is_parabola) {
    fill_alike(row, way, left, out);
    return 0;
  }
  const int count = static_cast<int>(out.size() / layers_.channels);
  int unseen = 0;
  for (int i = 0; i < count; i++) {
    const float px = static_cast<float>(left + i) + 0.5f;
    const auto find = [&](float x) {
      return is_parabola ? ray_along(row, x) : ray_in_view(camera_, picture_.size, rays, x, py);
    };
    const RayInView seen = find(px);
    const Footprint footprint{find(px + 1.0f).at - seen.at, (seen.beside - seen.at) * way};
    unseen += fill_pixel(rays.at(px, py), seen, footprint, &out[static_cast<size_t>(i) * layers_.channels]) ? 0 : 1;
  }
  return unseen;
}

}  // namespace ods
