// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/slit_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"
#include "ods/stitch/slit_rows.h"

namespace ods {

static SlitError max_of(const SlitError& a, const SlitError& b) {
  return {std::max(a.across, b.across), std::max(a.along, b.along), std::max(a.whole, b.whole),
          std::max(a.step, b.step)};
}

float arc_minutes(float angle) {
  return glm::degrees(angle) * 60.0f;
}

float picture_pixels(const SlitRig& rig, float angle) {
  return angle * static_cast<float>(pixels_per_radian(rig.camera.projection, rig.eye.width));
}

namespace {

// The component of an offset perpendicular to a ray, in the ray's frame: horizontal and vertical.
vec2 square_to(const Ray& ray, vec3 axis, vec3 offset) {
  const vec3 right = normalize(cross(ray.direction, axis));
  return {dot(offset, right), dot(offset, cross(right, ray.direction))};
}

struct Judge {
  const SlitRig& rig;
  Camera camera;
  vec3 axis;

  explicit Judge(const SlitRig& of) : rig(of), camera(make_camera(of.camera)), axis(axis_in_world(camera)) {}

  vec3 origin(size_t eye, int slit, int pitch) const {
    const int last = rig.options.slits - 1;
    if (slit > last) slit = goes_round(rig) ? 0 : last;
    return rig.views[view_index(rig, eye, slit, pitch)].position;
  }

  // The error of the eye's slit at an angle `off` from its centre.
  SlitError error(size_t eye, int slit, int pitch, float off, float latitude, float distance) const {
    const Ray ray = ray_at(camera, rig.eyes[eye], slit_longitude(rig, slit) + off, latitude);
    const vec3 moved = ray.origin - origin(eye, slit, pitch);
    const vec2 aside = square_to(ray, axis, moved) / (distance + dot(moved, ray.direction));
    SlitError error;
    error.across = std::atan(std::abs(aside.x)), error.along = std::atan(std::abs(aside.y));
    error.whole = std::atan(length(aside));
    return error;
  }

  // The step between two views that both show a point.
  float step(size_t eye, float longitude, float latitude, float distance, vec3 a, vec3 b) const {
    return std::atan(length(square_to(ray_at(camera, rig.eyes[eye], longitude, latitude), axis, a - b)) / distance);
  }

  // beyond: how far past the slit and its fade.
  SlitError at_slit(size_t eye, int slit, int pitch, float latitude, float distance, float beyond) const {
    const float middle = slit_longitude(rig, slit), half = 0.5f * slit_width(rig);
    const float reach = half * (1.0f + rig.options.blend) + beyond;
    SlitError worst = error(eye, slit, pitch, 0.0f, latitude, distance);
    for (const float off : {-reach, reach}) worst = max_of(worst, error(eye, slit, pitch, off, latitude, distance));
    worst.step = step(eye, middle + half, latitude, distance, origin(eye, slit, pitch), origin(eye, slit + 1, pitch));
    return worst;
  }
};

// The pitches that show a latitude of the picture; two where one fades into the other.
std::vector<int> pitches_at(const SlitRig& rig, float latitude) {
  std::vector<int> found;
  for (int pitch = 0; pitch < rig.options.pitches; pitch++) {
    const vec2 reach = pitch_reach(rig, pitch);
    if (latitude >= reach.x && latitude <= reach.y) found.push_back(pitch);
  }
  return found;
}

}  // namespace

ViewDetail view_detail(const SlitRig& rig, float latitude) {
  const float width = static_cast<float>(rig.eye.width), height = static_cast<float>(rig.eye.height);
  const PictureRays rays{make_camera(rig.camera), rig.eyes[0], {width, height}};
  const vec2 range = glm::radians(rig.camera.projection.latitude);
  const float x = 0.5f * width / static_cast<float>(rig.options.slits);
  const float y = std::clamp(height * (range.y - latitude) / (range.y - range.x), 0.5f, height - 0.5f);
  ViewDetail coarsest;
  for (const int pitch : pitches_at(rig, std::clamp(latitude, range.x, range.y))) {
    const Camera view = make_camera(rig.views[view_index(rig, 0, 0, pitch)]);
    const auto at = [&](float dx, float dy) { return ray_in_view(view, rig.view, rays, x + dx, y + dy).at; };
    const float across = 1.0f / length(at(0.5f, 0.0f) - at(-0.5f, 0.0f));
    const float along = 1.0f / length(at(0.0f, 0.5f) - at(0.0f, -0.5f));
    coarsest.across = std::max(coarsest.across, across);
    coarsest.along = std::max(coarsest.along, along);
  }
  const vec2 longitude = glm::radians(rig.camera.projection.longitude);
  const float shown = range.y - (range.y - range.x) * y / height;
  coarsest.angle = coarsest.across * std::cos(shown) * (longitude.y - longitude.x) / width;
  return coarsest;
}

static SlitError error_at(const Judge& judge, float latitude, float distance, float beyond = 0.0f) {
  const SlitRig& rig = judge.rig;
  SlitError worst;
  const std::vector<int> pitches = pitches_at(rig, latitude);
  for (size_t eye = 0; eye < rig.eyes.size(); eye++) {
    for (int slit = 0; slit < rig.options.slits; slit++) {
      for (const int pitch : pitches)
        worst = max_of(worst, judge.at_slit(eye, slit, pitch, latitude, distance, beyond));
      if (pitches.size() < 2) continue;
      const vec3 upper = judge.origin(eye, slit, pitches[0]), lower = judge.origin(eye, slit, pitches[1]);
      worst.step = std::max(worst.step, judge.step(eye, slit_longitude(rig, slit), latitude, distance, upper, lower));
    }
  }
  return worst;
}

// The error belongs to the point actually shown, which is that far to the side, above or below. An error of angle e
// also changes the distance, by a factor of up to 1 + e.
SlitError slit_error(const SlitRig& rig, float latitude, float distance) {
  const Judge judge(rig);
  SlitError worst = error_at(judge, latitude, distance);
  const float off = std::max(worst.whole, worst.step), top = pitch_border(rig, -1);
  const float bottom = pitch_border(rig, rig.options.pitches - 1);
  // Points above or below the inside of the circle are never seen.
  const float radius = length(vec2(0.5f * rig.camera.ipd, rig.camera.neck));
  const float beyond = worst.across / std::max({std::cos(latitude), radius / distance, 1e-6f});
  for (const float other : {latitude - off, latitude + off}) {
    worst = max_of(worst, error_at(judge, std::clamp(other, bottom, top), distance, beyond));
  }
  for (float* each : {&worst.across, &worst.along, &worst.whole, &worst.step}) *each *= 1.0f + off;
  return worst;
}

SlitError largest_slit_error(const SlitRig& rig, float distance) {
  constexpr int kLatitudes = 36;
  const float top = pitch_border(rig, -1), bottom = pitch_border(rig, rig.options.pitches - 1);
  SlitError worst;
  for (int i = 0; i <= kLatitudes; i++) {
    worst = max_of(worst, slit_error(rig, mix(top, bottom, static_cast<float>(i) / kLatitudes), distance));
  }
  for (int pitch = 0; pitch + 1 < rig.options.pitches; pitch++) {
    worst = max_of(worst, slit_error(rig, pitch_border(rig, pitch), distance));
  }
  return worst;
}

// Independent of the rig's position: near the origin floats resolve positions best.
static float pixels_off(StereoCamera camera, Extent eye, const SlitOptions& options, float nearest) {
  camera.position = vec3(0.0f);
  const SlitRig rig = make_slit_rig(camera, eye, {kRight}, options);
  const SlitError error = largest_slit_error(rig, nearest);
  return picture_pixels(rig, std::max(error.whole, error.step));
}

int slits_for(const StereoCamera& camera, Extent eye, const SlitOptions& options, float nearest, float pixels) {
  const float allowed = options.depth == ViewDepth::kNone ? pixels : 10.0f * pixels;
  SlitOptions tried = options;
  const auto fits = [&](int slits) {
    tried.slits = slits;
    return slit_fault(camera, eye, tried).empty() && pixels_off(camera, eye, tried, nearest) <= allowed;
  };
  int enough = eye.width;
  if (!fits(enough)) {
    tried.slits = enough;
    const std::string fault = slit_fault(camera, eye, tried);
    if (!fault.empty()) throw Error(ErrorKind::kUsage, fault);
    throw Error(
        ErrorKind::kUsage,
        fmt::format(
            "even a slit for every column is off by {:.3g} pixels at {:g} m: the pole merge moves the eyes from "
            "one pitch to the next. Use more `pitches`, `merge` none, or views with depth",
            pixels_off(camera, eye, tried, nearest), nearest));
  }
  int few = 2;
  while (enough - few > 1) {
    const int middle = few + (enough - few) / 2;
    (fits(middle) ? enough : few) = middle;
  }
  return enough;
}

}  // namespace ods
