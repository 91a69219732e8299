// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/view.h"

#include <algorithm>
#include <cmath>

#include "ods/image/convert.h"

namespace ods {

ViewForm form_of(const StoredPicture& picture) {
  ViewForm form;
  form.layers = row_layers(picture);
  const std::optional<size_t> depth = depth_layer(picture);
  for (size_t i = 0; i < form.layers.size(); i++) {
    const RowLayer& layer = form.layers[i];
    if (depth == i) form.depth = static_cast<int>(form.channels);
    form.channels += layer.channels.size();
    form.is_nearest.resize(form.channels, layer.rule == LayerRule::kNearest);
  }
  return form;
}

bool same_layers(const ViewForm& a, const ViewForm& b) {
  const auto same = [](const RowLayer& x, const RowLayer& y) { return x.channels == y.channels && x.rule == y.rule; };
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same);
}

static StoredPicture posed(StoredPicture picture, const CameraRig& pose) {
  picture.rig = pose;
  return picture;
}

View::View(StoredPicture picture, const CameraRig& pose, ViewDepth depth)
    : picture_(posed(std::move(picture), pose)),
      form_(form_of(picture_)),
      source_(make_source(picture_)),
      resampler_(source_),
      place_(pose.position) {
  const std::optional<size_t> layer = depth_layer(picture_);
  if (!layer || depth == ViewDepth::kNone) return;
  if (depth == ViewDepth::kPlane) measure_along_rays(*layer);
  surfaces_ = make_reprojection(source_);
}

// A depth buffer's metres are those along the view's axis.
void View::measure_along_rays(size_t index) {
  LayerPixels& layer = picture_.eyes[0].layers[index];
  const Extent size = picture_.size;
  const vec2 half = source_.camera.projection.half_size;
  distances_.reserve(static_cast<size_t>(size.width) * static_cast<size_t>(size.height));
  for (int y = 0; y < size.height; y++) {
    for (int x = 0; x < size.width; x++) {
      const float depth = sample_value(layer.sample, layer.first + y * layer.row_stride + x * layer.pixel_stride);
      const vec2 at((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height));
      const vec2 slope = (2.0f * at - 1.0f) * half;
      distances_.push_back(depth < 0.1f * kFarDepth ? depth * std::sqrt(1.0f + dot(slope, slope)) : kFarDepth);
    }
  }
  layer.sample = Sample::kFloat;
  layer.first = reinterpret_cast<const std::byte*>(distances_.data());
  layer.pixel_stride = sizeof(float);
  layer.row_stride = layer.pixel_stride * size.width;
}

// --- pixels ----------------------------------------------------------------------------------------------------------

// Where a ray of the picture lies in the view, and the one a pixel beside it, away from the picture's nearer edge.
struct View::Look {
  vec2 at;
  vec2 beside;
  float nearer;  // metres by which the view stands nearer than the ray's origin to what it meets
};

static float way_from_edge(const PictureRays& rays, float y) {
  return 2.0f * y < rays.size.y ? 1.0f : -1.0f;
}

View::Look View::look(const PictureRays& rays, float x, float y) const {
  const Ray ray = rays.at(x, y), beside = rays.at(x, y + way_from_edge(rays, y));
  return {place_of_line(source_, 0, ray.direction).at, place_of_line(source_, 0, beside.direction).at,
          dot(place_ - ray.origin, ray.direction)};
}

static Cell all_of(const StoredPicture& picture) {
  return {0, 0, picture.size.width, picture.size.height};
}

void View::sum_points(const Footprint& footprint, const Place& place, float* out) const {
  thread_local std::vector<FilterPoint> points;
  filter_points(footprint, points);
  std::fill(out, out + form_.channels, 0.0f);
  for (const FilterPoint& point : points) {
    resampler_.add({0, place.at + point.texels, true}, all_of(picture_), point.weight, out);
  }
}

// Pixels whose places follow a parabola through those of the first, the middle and the last.
void View::fill_alike(const Look (&looks)[3], int count, float way, std::span<float> out) const {
  const auto along = [&](auto a, auto b, auto c, float t) {
    return a + (b - a) * t + (c - 2.0f * b + a) * (0.5f * t * (t - 1.0f));
  };
  const float per_pixel = count > 1 ? 2.0f / static_cast<float>(count - 1) : 0.0f;
  const vec2 step = looks[1].at - looks[0].at, bend = looks[2].at - 2.0f * looks[1].at + looks[0].at;
  PixelRun run(resampler_, 0, all_of(picture_));
  for (int i = 0; i < count; i++) {
    const float t = static_cast<float>(i) * per_pixel;
    const Place place{0, along(looks[0].at, looks[1].at, looks[2].at, t), true};
    const vec2 beside = along(looks[0].beside, looks[1].beside, looks[2].beside, t);
    const Footprint footprint{(step + bend * (t - 0.5f)) * per_pixel, (beside - place.at) * way};
    float* pixel = &out[static_cast<size_t>(i) * form_.channels];
    if (!run.add(footprint, place.at, pixel)) sum_points(footprint, place, pixel);
    resampler_.finish(place, pixel);
    if (form_.depth < 0 || pixel[form_.depth] >= 0.1f * kFarDepth) continue;
    pixel[form_.depth] += along(looks[0].nearer, looks[1].nearer, looks[2].nearer, t);
  }
  run.fill();
}

// Each by itself, through the view's surfaces if they are known.
bool View::fill_pixel(const PictureRays& rays, int x, int y, float* out) const {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  const Look own = look(rays, px, py);
  const vec2 right = place_of_line(source_, 0, rays.at(px + 1.0f, py).direction).at;
  const Footprint footprint{right - own.at, (own.beside - own.at) * way_from_edge(rays, py)};
  const Ray ray = rays.at(px, py);
  const SurfaceHit met =
      surfaces_ ? meet_surface(*surfaces_, 0, {ray.origin - place_, ray.direction}) : SurfaceHit{{}, kFarDepth};
  const Place place = met.place.seen ? met.place : Place{0, own.at, true};
  PixelRun run(resampler_, 0, all_of(picture_));
  if (!run.add(footprint, place.at, out)) sum_points(footprint, place, out);
  run.fill();
  resampler_.finish(place, out);
  if (form_.depth < 0) return met.place.seen || !surfaces_;
  float& depth = out[form_.depth];
  if (met.place.seen) {
    depth = met.depth;
  } else if (depth < 0.1f * kFarDepth) {
    depth += own.nearer;
  }
  return met.place.seen || !surfaces_;
}

int View::fill(const PictureRays& rays, int y, int left, std::span<float> out) const {
  const int count = static_cast<int>(out.size() / form_.channels);
  const float py = static_cast<float>(y) + 0.5f, from = static_cast<float>(left) + 0.5f;
  if (!surfaces_ && count > 2) {
    const float way = static_cast<float>(count - 1);
    const Look looks[] = {look(rays, from, py), look(rays, from + 0.5f * way, py), look(rays, from + way, py)};
    const vec2 bend = looks[2].at - 2.0f * looks[1].at + looks[0].at;
    const vec2 turn = looks[2].beside - 2.0f * looks[1].beside + looks[0].beside;
    if (length(bend) < 1.0f && length(turn) < 1.0f) {
      fill_alike(looks, count, way_from_edge(rays, py), out);
      return 0;
    }
  }
  int unseen = 0;
  for (int i = 0; i < count; i++) {
    unseen += fill_pixel(rays, left + i, y, &out[static_cast<size_t>(i) * form_.channels]) ? 0 : 1;
  }
  return unseen;
}

}  // namespace ods
