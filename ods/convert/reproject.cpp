// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/reproject.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>

#include "ods/base/parabola.h"
#include "ods/kernel/camera/project.h"

namespace ods {

static float depth_at(const LayerPixels& layer, int x, int y) {
  const std::byte* at = layer.first + y * layer.row_stride + x * layer.pixel_stride;
  if (layer.sample != SampleType::kFloat) return sample_value(layer.sample, at);
  float depth;
  std::memcpy(&depth, at, sizeof depth);
  return depth;
}

static float nearness_at(const Reprojection& reprojection, const Texel& texel) {
  const StoredEye& eye = reprojection.source->picture->eyes[static_cast<size_t>(texel.source_eye)];
  return inverse_depth(depth_at(eye.layers[reprojection.layer], texel.x, texel.y));
}

std::optional<size_t> depth_layer(const StoredPicture& picture) {
  const std::vector<LayerPixels>& layers = picture.eyes[0].layers;
  std::optional<size_t> foreign;
  for (size_t i = 0; i < layers.size(); i++) {
    const bool is_float = layers[i].sample == SampleType::kFloat || layers[i].sample == SampleType::kHalf;
    if (layers[i].rule != LayerRule::kNearest || layers[i].channels.size() != 1 || !is_float) continue;
    if (layers[i].channels[0] == "Z") return i;
    if (layers[i].channels[0].ends_with(".Depth.Z") && !foreign) foreign = i;
  }
  if (picture.camera.projection.kind == kPerspective) return {};  // Blender measures perspective depth along the axis
  return foreign;
}

Image depth_of_eye(const StoredPicture& picture, size_t eye) {
  const LayerPixels& layer = picture.eyes[eye].layers[*depth_layer(picture)];
  Image depth(picture.size.width, picture.size.height, 1);
  for (int y = 0; y < depth.height; y++) {
    for (int x = 0; x < depth.width; x++) depth.at(x, y)[0] = depth_at(layer, x, y);
  }
  return depth;
}

void read_nearness(const Reprojection& reprojection, int source_eye, int y, float* out) {
  const StoredPicture& picture = *reprojection.source->picture;
  const LayerPixels& layer = picture.eyes[static_cast<size_t>(source_eye)].layers[reprojection.layer];
  if (layer.sample == SampleType::kFloat && layer.pixel_stride == sizeof(float)) {
    std::memcpy(out, layer.first + y * layer.row_stride, static_cast<size_t>(picture.size.width) * sizeof(float));
  } else {
    for (int x = 0; x < picture.size.width; x++) out[x] = depth_at(layer, x, y);
  }
  for (int x = 0; x < picture.size.width; x++) out[x] = inverse_depth(out[x]);
}

Reprojection make_reprojection(const Source& source) {
  assert(depth_layer(*source.picture));
  const StoredPicture& picture = *source.picture;
  Reprojection reprojection;
  reprojection.source = &source, reprojection.layer = *depth_layer(picture);
  std::atomic<int64_t> no_depth = 0;
  float largest = 1e-6f;
  for (int source_eye = 0; source_eye < static_cast<int>(picture.eyes.size()); source_eye++) {
    std::vector<float>& maximum = reprojection.row_max.emplace_back(picture.size.height);
    tbb::parallel_for(0, picture.size.height, [&](int y) {
      const LayerPixels& layer = picture.eyes[static_cast<size_t>(source_eye)].layers[reprojection.layer];
      float nearest = 0.0f;
      int64_t invalid = 0;
      for (int x = 0; x < picture.size.width; x++) {
        const float depth = depth_at(layer, x, y);
        nearest = std::max(nearest, inverse_depth(depth));
        invalid += !(depth > 0.0f);
      }
      maximum[static_cast<size_t>(y)] = nearest;
      no_depth += invalid;
    });
    largest = std::max(largest, *std::max_element(maximum.begin(), maximum.end()));
  }
  reprojection.no_depth = no_depth;
  reprojection.nearest = std::max(1.0f / largest, 0.01f);
  return reprojection;
}

float nearness_of(const Reprojection& reprojection, const Place& place) {
  const Source& source = *reprojection.source;
  const Cell cell = cell_of(source.camera.projection, source.picture->size, place.at);
  const vec2 from = place.at - 0.5f, base = floor(from), beyond = from - base;
  const int left = static_cast<int>(base.x), top = static_cast<int>(base.y);
  const bool inside = left >= cell.left && left + 1 < cell.right && top >= cell.top && top + 1 < cell.bottom &&
                      !has_image_circle(source.camera.projection.kind);
  float corners[4];
  for (int i = 0; i < 4; i++) {
    const Texel corner{place.source_eye, left + i % 2, top + i / 2};
    corners[i] =
        nearness_at(reprojection, inside ? corner : texel_of(source, place.source_eye, cell, corner.x, corner.y));
  }
  const float own = corners[(beyond.x < 0.5f ? 0 : 1) + (beyond.y < 0.5f ? 0 : 2)];
  for (const float corner : corners) {
    if (!is_one_surface(corner, own)) return own;
  }
  return mix(mix(corners[0], corners[1], beyond.x), mix(corners[2], corners[3], beyond.x), beyond.y);
}

namespace {

// The position of a point of the ray in an eye's picture. The argument is 1 / the point's distance along the ray.
struct Shown {
  Place place;
  float inverse_depth = 0.0f;  // 1 / distance of the point from that eye
};

struct Curve {
  const Source& source;
  int source_eye;
  const Ray& ray;
  float maximum = 0.0f;      // 1 / distance of the nearest point
  bool is_parabola = false;  // the positions follow a parabola through three of them
  Shown at_far, at_middle, at_near;

  Shown find(float inverse_depth) const;
  Shown at(float inverse_depth) const;
};

const float kMinInverseDepth = 1e-6f;  // 1/metres: beyond this distance floats cannot distinguish points

// Inlining the kernel's camera makes it faster.
[[gnu::flatten]] Shown Curve::find(float inverse_depth) const {
  const int which = source.picture->eyes[static_cast<size_t>(source_eye)].eye;
  const vec3 point = ray.origin + ray.direction * (1.0f / std::max(inverse_depth, kMinInverseDepth));
  const ImagePosition found = project_point(source.camera, which, point);
  const Extent size = source.picture->size;
  const vec2 at = found.uv * vec2(static_cast<float>(size.width), static_cast<float>(size.height));
  return {{source_eye, at, found.seen}, found.seen ? 1.0f / found.depth : 0.0f};
}

Shown Curve::at(float inverse_depth) const {
  if (!is_parabola) return find(inverse_depth);
  const float t = 2.0f * inverse_depth / maximum;
  return {{source_eye, on_parabola(at_far.place.at, at_middle.place.at, at_near.place.at, t), true},
          on_parabola(at_far.inverse_depth, at_middle.inverse_depth, at_near.inverse_depth, t)};
}

Curve make_curve(const Source& source, int source_eye, const Ray& ray, float maximum) {
  Curve curve{source, source_eye, ray, maximum, false, {}, {}, {}};
  curve.at_far = curve.find(0.0f), curve.at_middle = curve.find(0.5f * maximum), curve.at_near = curve.find(maximum);
  const vec2 a = curve.at_far.place.at, b = curve.at_middle.place.at, c = curve.at_near.place.at;
  const auto cell = [&](vec2 at) { return cell_of(source.camera.projection, source.picture->size, at); };
  const bool seen = curve.at_far.place.seen && curve.at_middle.place.seen && curve.at_near.place.seen;
  const bool in_one = cell(a).left == cell(c).left && cell(a).top == cell(c).top && cell(b).left == cell(c).left &&
                      cell(b).top == cell(c).top;
  curve.is_parabola = seen && in_one && length(c - 2.0f * b + a) < 0.5f;
  return curve;
}

// The result of a march along a curve.
struct March {
  std::optional<SurfaceHit> met;
  // At an edge where the curve passes behind an object, or comes out from behind it: the surface on the other side of
  // that edge. The farthest one is the background that the object hides.
  std::optional<Place> edge;
  float hidden = 0.0f;  // its nearness, 1 / metres
};

void take_farther(March& march, const Place& edge, float surface) {
  if (march.edge && march.hidden <= surface) return;
  march.edge = edge, march.hidden = surface;
}

int steps_of(const Curve& curve) {
  const float length_of_curve = length(curve.at_near.place.at - curve.at_middle.place.at) +
                                length(curve.at_middle.place.at - curve.at_far.place.at);
  return curve.is_parabola ? 1 + static_cast<int>(std::min(length_of_curve, 4000.0f)) : 64;
}

// A sample of the curve: 1 / distance, the stored surface there, and how far in front of it the point is, as 1 /
// metres.
struct Sample {
  float inverse_depth = 0.0f, surface = 0.0f, ahead = 0.0f;
};

SurfaceHit crossing(const Reprojection& reprojection, const Curve& curve, const Sample& before, const Sample& after) {
  float low = after.inverse_depth, high = before.inverse_depth, below = after.ahead, above = before.ahead;
  for (int round = 0; round < 4; round++) {
    const float middle = low + (high - low) * (-below / std::max(above - below, 1e-20f));
    const Shown there = curve.at(middle);
    const float off = (middle > 0.0f ? there.inverse_depth : 0.0f) - nearness_of(reprojection, there.place);
    (off > 0.0f ? high : low) = middle;
    (off > 0.0f ? above : below) = off;
  }
  const float met = low + (high - low) * (-below / std::max(above - below, 1e-20f));
  return {curve.at(met).place, met > kMinInverseDepth ? 1.0f / met : kFarDepth};
}

// Finds the first crossing from in front of the surface to behind it, from near to far, in steps of about a texel.
March march_along(const Reprojection& reprojection, const Curve& curve) {
  const int steps = steps_of(curve);
  const float step = curve.maximum / static_cast<float>(steps);
  March march;
  bool was_seen = false;
  Sample last;
  Place last_place;
  for (int i = 0; i <= steps; i++) {
    const float inverse_depth = step * static_cast<float>(steps - i);
    const Shown shown = curve.at(inverse_depth);
    const bool had_seen = was_seen;
    was_seen = shown.place.seen;
    if (!was_seen) continue;
    const float surface = nearness_of(reprojection, shown.place);
    const Sample sample{inverse_depth, surface, (i == steps ? 0.0f : shown.inverse_depth) - surface};
    if (had_seen && sample.ahead <= 0.0f) {
      const bool is_one = is_one_surface(surface, last.surface);
      if (last.ahead > 0.0f && is_one) {
        march.met = crossing(reprojection, curve, last, sample);
        return march;
      }
      if (last.ahead > 0.0f) take_farther(march, last_place, last.surface);
      if (last.ahead <= 0.0f && !is_one && surface < last.surface) take_farther(march, shown.place, surface);
    }
    last = sample, last_place = shown.place;
  }
  return march;
}

// Directions straight above and below, where eyes on a circle do not look: uses the surface visible in that direction.
SurfaceHit fill_blind(const Reprojection& reprojection, const Curve& curve) {
  if (!curve.at_far.place.seen) return {};
  const float nearness = nearness_of(reprojection, curve.at_far.place);
  return {curve.at_far.place, nearness > kMinInverseDepth ? 1.0f / nearness : kFarDepth, true};
}

// Continues the surface beside the object behind it, mirrored at the edge.
SurfaceHit fill_behind(const Reprojection& reprojection, const Curve& curve, const March& march) {
  constexpr float kClear = 1.5f;  // texels from the edge, whose own colours are mixed
  if (!march.edge) return fill_blind(reprojection, curve);
  const Extent size = reprojection.source->picture->size;
  const vec2 whole(static_cast<float>(size.width), static_cast<float>(size.height));
  const float depth = march.hidden > kMinInverseDepth ? 1.0f / march.hidden : kFarDepth;
  const vec2 away = march.edge->at - curve.at(march.hidden).place.at;  // from the hidden point to the edge
  Place clear = *march.edge;
  if (length(away) > 1e-6f) clear.at = clear.at + normalize(away) * kClear;
  Place mirrored = clear;
  mirrored.at = mirrored.at + away;
  for (const Place& each : {mirrored, clear}) {
    if (!inside_picture(each.at / whole)) continue;
    if (is_one_surface(nearness_of(reprojection, each), march.hidden)) return {each, depth, true};
  }
  return {*march.edge, depth, true};
}

}  // namespace

SurfaceHit meet_surface(const Reprojection& reprojection, int source_eye, const Ray& ray, bool fills) {
  const Source& source = *reprojection.source;
  // The ray may start closer to objects than the picture's own rays.
  const float away = length(ray.origin) + length(vec2(0.5f * source.camera.ipd, source.camera.neck));
  const float maximum = 1.0f / std::max(reprojection.nearest - away, 0.25f * reprojection.nearest);
  const int count = static_cast<int>(source.picture->eyes.size());
  SurfaceHit behind;
  for (int i = 0; i < count; i++) {
    const Curve curve = make_curve(source, (source_eye + i) % count, ray, maximum);
    const March march = march_along(reprojection, curve);
    if (march.met) return *march.met;
    if (fills && !behind.place.seen) behind = fill_behind(reprojection, curve, march);
  }
  return behind;
}

}  // namespace ods
