// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/view.h"

#include <algorithm>
#include <cmath>

namespace ods {

ViewForm form_of(const StoredPicture& picture) {
  ViewForm form;
  const std::optional<size_t> depth = depth_layer(picture);
  for (size_t i = 0; i < picture.eyes[0].layers.size(); i++) {
    const LayerPixels& layer = picture.eyes[0].layers[i];
    form.layers.push_back(
        {layer.channels, layer.rule, layer.sample == Sample::kFloat ? Sample::kFloat : Sample::kHalf});
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

bool View::look(const Ray& ray, vec3 right, vec3 down, std::span<float> out) const {
  const Place straight = place_of_line(source_, 0, ray.direction);
  const Footprint footprint{place_of_line(source_, 0, right).at - straight.at,
                            place_of_line(source_, 0, down).at - straight.at};
  SurfaceHit met{straight, kFarDepth};
  bool sees = true;
  if (surfaces_) {
    const SurfaceHit found = meet_surface(*surfaces_, 0, {ray.origin - place_, ray.direction});
    sees = found.place.seen;
    if (sees) met = found;
  }
  std::fill(out.begin(), out.end(), 0.0f);
  const Cell cell{0, 0, picture_.size.width, picture_.size.height};
  TexelFilter filter;
  if (!texel_filter(footprint, met.place.at, filter) || !resampler_.add(0, filter, cell, out.data())) {
    thread_local std::vector<FilterPoint> points;
    filter_points(footprint, points);
    for (const FilterPoint& point : points) {
      resampler_.add({0, met.place.at + point.texels, true}, cell, point.weight, out.data());
    }
  }
  resampler_.finish(met.place, out.data());
  if (form_.depth < 0) return sees;
  float& depth = out[static_cast<size_t>(form_.depth)];
  if (surfaces_ && sees) depth = met.depth;
  if (!surfaces_ && depth < 0.1f * kFarDepth) depth += dot(place_ - ray.origin, ray.direction);
  return sees;
}

}  // namespace ods
