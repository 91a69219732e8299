// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/slit_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ods/image/image_file.h"

namespace ods {

size_t view_index(const SlitRig& rig, size_t eye, int slit, int pitch) {
  const size_t slits = static_cast<size_t>(rig.options.slits), pitches = static_cast<size_t>(rig.options.pitches);
  return (eye * slits + static_cast<size_t>(slit)) * pitches + static_cast<size_t>(pitch);
}

// --- angles ---------------------------------------------------------------------------------------------------------

float slit_width(const SlitRig& rig) {
  const vec2 range = glm::radians(rig.camera.projection.longitude);
  return (range.y - range.x) / static_cast<float>(rig.options.slits);
}

float slit_longitude(const SlitRig& rig, int slit) {
  return glm::radians(rig.camera.projection.longitude).x + (static_cast<float>(slit) + 0.5f) * slit_width(rig);
}

// The pitches that the picture's height divides into; two caps count as one.
static float whole_pitches(const SlitRig& rig) {
  return static_cast<float>(rig.options.pitches - (rig.options.caps ? 1 : 0));
}

float pitch_border(const SlitRig& rig, int pitch) {
  const vec2 range = glm::radians(rig.camera.projection.latitude);
  const float above = static_cast<float>(pitch) + (rig.options.caps ? 0.5f : 1.0f);
  return mix(range.y, range.x, std::clamp(above / whole_pitches(rig), 0.0f, 1.0f));
}

float pitch_latitude(const SlitRig& rig, int pitch) {
  const float upper = pitch_border(rig, pitch - 1), lower = pitch_border(rig, pitch);
  if (rig.options.caps && pitch == 0) return upper;
  return rig.options.caps && pitch + 1 == rig.options.pitches ? lower : 0.5f * (upper + lower);
}

float pitch_height(const SlitRig& rig) {
  const vec2 range = glm::radians(rig.camera.projection.latitude);
  return (range.y - range.x) / whole_pitches(rig);
}

float pitch_fade(const SlitRig& rig) {
  return 0.5f * rig.options.blend * std::min(slit_width(rig), 0.5f * pitch_height(rig));
}

vec2 pitch_reach(const SlitRig& rig, int pitch) {
  const float fade = pitch_fade(rig);
  return {pitch_border(rig, pitch) - (pitch + 1 == rig.options.pitches ? 0.0f : fade),
          pitch_border(rig, pitch - 1) + (pitch == 0 ? 0.0f : fade)};
}

bool goes_round(const SlitRig& rig) {
  const vec2 range = rig.camera.projection.longitude;
  return range.y - range.x == 360.0f;
}

Ray ray_at(const Camera& camera, int eye, float longitude, float latitude) {
  const Projection& projection = camera.projection;
  return camera_ray(camera, eye,
                    vec2(0.5f + (longitude - projection.center.x) / projection.span.x,
                         0.5f - (latitude - projection.center.y) / projection.span.y));
}

// --- views ----------------------------------------------------------------------------------------------------------

namespace {

constexpr float kWidestTangent = 11.4f;  // tangent of half of 170 degrees

// The tangents of the half angles that a view must cover.
struct Window {
  float x = 0.0f;
  float y = 0.0f;
};

// ray: the centre of the view. ahead: the view's direction; for a cap, along the axis.
StereoCamera view_of_ray(const Ray& ray, vec3 ahead, vec3 axis) {
  StereoCamera view;
  view.ipd = 0.0f;
  view.position = ray.origin;
  const glm::dvec3 forward = normalize(glm::dvec3(ahead));
  const glm::dvec3 right = normalize(cross(normalize(glm::dvec3(ray.direction)), glm::dvec3(axis)));
  const ViewAngles angles = view_angles(forward, cross(right, forward));
  view.yaw = angles.yaw, view.pitch = angles.pitch, view.roll = angles.roll;
  view.projection.kind = kPerspective;
  view.projection.fov = 90.0f;
  return view;
}

// Widens the window to cover the view's part of the picture: corners and edges.
void widen(const SlitRig& rig, const Camera& camera, int eye, int slit, int pitch, const StereoCamera& view,
           Window& window) {
  constexpr int kSteps = 8;
  const Camera own = make_camera(view);
  const float half = 0.5f * slit_width(rig) * (1.0f + rig.options.blend);
  const vec2 reach = pitch_reach(rig, pitch);
  for (int i = -1; i <= 1; i++) {
    for (int j = 0; j <= kSteps; j++) {
      const float latitude = mix(reach.y, reach.x, static_cast<float>(j) / kSteps);
      const vec3 d = ray_at(camera, eye, slit_longitude(rig, slit) + static_cast<float>(i) * half, latitude).direction;
      const float ahead = -dot(d, own.back);
      const float x = std::abs(dot(d, own.right)), y = std::abs(dot(d, own.up));
      window.x = std::max(window.x, ahead > 0.0f ? x / ahead : 1e9f);
      window.y = std::max(window.y, ahead > 0.0f ? y / ahead : 1e9f);
    }
  }
}

struct Views {
  std::vector<StereoCamera> views;
  Window window;
};

Views place_views(const SlitRig& rig) {
  Views all;
  const Camera camera = make_camera(rig.camera);
  for (const int eye : rig.eyes) {
    for (int slit = 0; slit < rig.options.slits; slit++) {
      for (int pitch = 0; pitch < rig.options.pitches; pitch++) {
        const float longitude = slit_longitude(rig, slit);
        const float middle = 0.5f * (pitch_border(rig, pitch - 1) + pitch_border(rig, pitch));
        const vec3 ahead = ray_at(camera, eye, longitude, pitch_latitude(rig, pitch)).direction;
        all.views.push_back(view_of_ray(ray_at(camera, eye, longitude, middle), ahead, axis_in_world(camera)));
        widen(rig, camera, eye, slit, pitch, all.views.back(), all.window);
      }
    }
  }
  return all;
}

// The size of a picture pixel at a view's centre, as a tangent.
float pixel_of(const SlitRig& rig) {
  const ProjectionSetting& setting = rig.camera.projection;
  const vec2 across = glm::radians(setting.longitude), up = glm::radians(setting.latitude);
  return std::min((across.y - across.x) / static_cast<float>(rig.eye.width),
                  (up.y - up.x) / static_cast<float>(rig.eye.height)) /
         rig.options.scale;
}

int pixels_for(float tangent, const SlitRig& rig) {
  const double pixels = std::ceil(static_cast<double>(tangent / pixel_of(rig)) - 1e-4);
  return 2 * static_cast<int>(std::min(pixels + rig.options.padding, double{kMaxSide}));
}

}  // namespace

std::string slit_fault(const StereoCamera& camera, Extent eye, const SlitOptions& options) {
  if (camera.projection.kind != kLatLong) {
    return fmt::format("slits make a lat-long picture, whole or a part; ods convert can turn it into {}",
                       projection_name(camera.projection));
  }
  if (camera.head_tilt_map) {
    return "slits are level and cannot show a tilted head: leave out `head-tilt-map`, or use ods render";
  }
  if (camera.lens_radius > 0.0f) return "the views' renderer makes the depth of field: leave out `lens`";
  if (options.slits < 3 || options.slits > eye.width) {
    return fmt::format("{} slits: there must be at least 3, and at most as many as the picture has columns ({})",
                       options.slits, eye.width);
  }
  if (options.pitches < 1 || options.pitches > 64) return "there can be 1 to 64 views above each other";
  if (options.caps && options.pitches < 3) return "caps need at least 3 pitches";
  const SlitRig rig{camera, eye, {kRight}, options, {}, {}, {}};
  const Window window = place_views(rig).window;
  if (!(window.x < kWidestTangent && window.y < kWidestTangent)) {
    return "a view would have to cover more than 170 degrees: use more slits or pitches, or converge the eyes farther "
           "away";
  }
  const int longer = std::max(pixels_for(window.x, rig), pixels_for(window.y, rig));
  if (longer > kMaxSide) return fmt::format("views would have more than {} pixels per side", kMaxSide);
  if (!(0.5 * longer * double{pixel_of(rig)} < kWidestTangent)) {
    return "with their padding, views would cover more than 170 degrees: use less `padding`, or a larger `scale`";
  }
  return "";
}

SlitRig make_slit_rig(const StereoCamera& camera, Extent eye, const std::vector<int>& eyes,
                      const SlitOptions& options) {
  assert(slit_fault(camera, eye, options).empty());
  SlitRig rig{camera, eye, eyes, options, {}, {}, {}};
  Views all = place_views(rig);
  rig.views = std::move(all.views);
  rig.view = {pixels_for(all.window.x, rig), pixels_for(all.window.y, rig)};
  const double half = 0.5 * rig.view.width * static_cast<double>(pixel_of(rig));
  for (StereoCamera& view : rig.views) {
    view.projection.fov = static_cast<float>(glm::degrees(2.0 * std::atan(half)));
    view.projection.aspect = static_cast<float>(rig.view.width) / static_cast<float>(rig.view.height);
  }
  return rig;
}

}  // namespace ods
