// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every projection by its definition, and the camera through it, in double precision.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "ods/camera/projection.h"
#include "tests/support/exact_camera.h"

namespace ods {

using glm::dvec2, glm::dvec3;

inline dvec3 at_angles(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi)};
}

// pan to the right, then tilt up.
inline dvec3 turned(dvec3 d, double pan, double tilt) {
  const dvec3 up(d.x, d.y * std::cos(tilt) - d.z * std::sin(tilt), d.y * std::sin(tilt) + d.z * std::cos(tilt));
  return {up.x * std::cos(pan) - up.z * std::sin(pan), up.y, up.x * std::sin(pan) + up.z * std::cos(pan)};
}

inline dvec3 exact_fisheye(const ProjectionSetting& setting, dvec2 uv) {
  const double x = 2.0 * uv.x - 1.0, y = 1.0 - 2.0 * uv.y, r = std::hypot(x, y);
  const double fov = glm::radians(double{setting.fov});
  double angle = fov / 2.0 * r;
  if (setting.kind == kFisheyeEquisolid) angle = 2.0 * std::asin(std::min(r * std::sin(fov / 4.0), 1.0));
  // The line from the point opposite to the axis meets the sphere at the angle and the picture's plane at the radius.
  if (setting.kind == kFisheyeStereographic) angle = 2.0 * std::atan(r * std::tan(fov / 4.0));
  const double roll = std::atan2(y, x);
  return {std::sin(angle) * std::cos(roll), std::sin(angle) * std::sin(roll), -std::cos(angle)};
}

inline dvec3 exact_polynomial(const ProjectionSetting& setting, dvec2 uv) {
  const double x = (uv.x - 0.5) * double{setting.sensor.x}, y = (0.5 - uv.y) * double{setting.sensor.y};
  const double r = std::hypot(x, y), roll = std::atan2(y, x);
  double theta = 0.0;
  for (int i = 0; i < 5; i++) theta -= double{setting.polynomial[static_cast<size_t>(i)]} * std::pow(r, i);
  theta = std::max(theta, 0.0);
  return {std::sin(theta) * std::cos(roll), std::sin(theta) * std::sin(roll), -std::cos(theta)};
}

// The faces in the order of the source of the VR camera for Arnold, s to the right and t up; kEac as unfolded by
// players.
inline dvec3 exact_face(int kind, int cell, double s, double t) {
  if (kind == kCube3x2) {
    const dvec3 faces[] = {{s, t, -1}, {-s, 1, -t}, {-s, -1, t}, {1, t, s}, {-s, t, 1}, {-1, t, -s}};
    return faces[cell];
  }
  if (kind == kEac) {
    s = std::tan(kExactPi / 4.0 * s), t = std::tan(kExactPi / 4.0 * t);
    const dvec3 faces[] = {{-1, t, -s}, {s, t, -1}, {1, t, s}, {t, -1, s}, {t, s, 1}, {t, 1, -s}};
    return faces[cell];
  }
  const dvec3 faces[] = {{1, -s, t}, {-1, s, t}, {s, -t, 1}, {s, t, -1}, {s, 1, t}, {-s, -1, t}};
  return faces[cell];
}

inline dvec3 exact_cube(int kind, dvec2 uv) {
  const int columns = kind == kCube6x1 ? 6 : kind == kCube1x6 ? 1 : 3, rows = 6 / columns;
  const int column = std::min(static_cast<int>(uv.x * columns), columns - 1);
  const int row = std::min(static_cast<int>(uv.y * rows), rows - 1);
  return exact_face(kind, row * columns + column, 2.0 * (uv.x * columns - column) - 1.0,
                    1.0 - 2.0 * (uv.y * rows - row));
}

inline dvec3 exact_direction(const ProjectionSetting& setting, dvec2 uv) {
  const auto angle = [](float low, float high, double at) {
    return glm::radians(glm::mix(double{low}, double{high}, at));
  };
  const double pan = glm::radians(double{setting.pan}), tilt = glm::radians(double{setting.tilt});
  const double theta = angle(setting.longitude.x, setting.longitude.y, uv.x);
  switch (setting.kind) {
    case kLatLong:
      return at_angles(theta, angle(setting.latitude.y, setting.latitude.x, uv.y));
    case kCylinder: {
      const double top = std::tan(glm::radians(double{setting.latitude.y}));
      const double bottom = std::tan(glm::radians(double{setting.latitude.x}));
      return {std::sin(theta), glm::mix(top, bottom, uv.y), -std::cos(theta)};
    }
    case kFisheye:
    case kFisheyeEquisolid:
    case kFisheyeStereographic:
      return turned(exact_fisheye(setting, uv), pan, tilt);
    case kPerspective: {
      const double half = std::tan(glm::radians(double{setting.fov}) / 2.0);
      return turned({half * (2.0 * uv.x - 1.0), half / double{setting.aspect} * (1.0 - 2.0 * uv.y), -1.0}, pan, tilt);
    }
    case kFisheyePolynomial:
      return turned(exact_polynomial(setting, uv), pan, tilt);
    case kEacFace:
      return turned({std::tan(kExactPi / 2.0 * (uv.x - 0.5)), std::tan(kExactPi / 2.0 * (0.5 - uv.y)), -1.0}, pan,
                    tilt);
    case kCube3x2:
    case kCube6x1:
    case kCube1x6:
    case kEac:
      return exact_cube(setting.kind, uv);
    default:
      ADD_FAILURE() << "exact_direction() lacks " << projection_name(setting);
      return {};
  }
}

// Each named projection unchanged, and with other numbers.
inline std::vector<ProjectionSetting> many_settings(Dice& dice) {
  std::vector<ProjectionSetting> settings;
  for (const NamedProjection& named : named_projections()) {
    settings.push_back(named.setting);
    ProjectionSetting other = named.setting;
    other.longitude.x = dice.between(-400.0f, 300.0f);
    other.longitude.y = other.longitude.x + dice.between(20.0f, 350.0f);
    other.latitude = vec2(dice.between(-85.0f, -5.0f), dice.between(5.0f, 85.0f));
    other.fov = dice.between(20.0f, other.kind == kPerspective ? 160.0f : 350.0f);
    other.aspect = dice.between(0.3f, 3.0f);
    other.pan = dice.between(-180.0f, 180.0f);
    other.tilt = dice.between(-90.0f, 90.0f);
    if (other.kind == kFisheyePolynomial) {
      other.sensor = vec2(dice.between(10.0f, 40.0f), dice.between(10.0f, 40.0f));
      other.polynomial = {dice.between(-1e-4f, 0.0f), dice.between(-0.08f, -0.03f), dice.between(-1e-3f, 0.0f),
                          dice.between(-1e-5f, 2e-6f), dice.between(-1e-6f, 0.0f)};
    }
    settings.push_back(other);
  }
  return settings;
}

// The rounding error of a direction in the kernel's floats: its radius is rounded, and an equisolid lens turns that
// into a larger angle the closer it is to straight behind.
inline double rounding(const ProjectionSetting& setting, dvec2 uv) {
  if (setting.kind == kFisheyePolynomial) return 5e-7;  // five terms, a root
  if (setting.kind == kFisheyeStereographic) return 2.4e-7 * std::tan(glm::radians(double{setting.fov}) / 4.0);
  if (setting.kind != kFisheyeEquisolid) return 0.0;
  const double sine = std::sin(glm::radians(double{setting.fov}) / 4.0), r = sine * length(2.0 * uv - 1.0);
  return 1.2e-7 * 2.0 * sine / std::sqrt(1.0 - std::min(r * r, 0.99999));
}

inline bool in_circle(const ProjectionSetting& setting, dvec2 uv) {
  if (setting.kind != kFisheyePolynomial) return length(uv - dvec2(0.5)) < 0.4999;
  const dvec3 ahead(0.0, 0.0, -1.0);
  return angle_between(exact_polynomial(setting, uv), ahead) < 0.4999 * glm::radians(double{setting.fov});
}

// --- the camera through them -----------------------------------------------------------------------------------------

// A camera with this projection and convergence, and with every feature except a lens, a map and an eye distance.
inline StereoCamera odd_rig(Dice& dice, const ProjectionSetting& setting, int convergence) {
  StereoCamera stereo;
  stereo.position = vec3(dice.between(-2, 2), dice.between(-2, 2), dice.between(-2, 2));
  stereo.yaw = dice.between(-180, 180), stereo.pitch = dice.between(-40, 40), stereo.roll = dice.between(-40, 40);
  stereo.projection = setting;
  stereo.convergence = convergence;
  stereo.convergence_distance = dice.between(0.5f, 5.0f);
  if (dice.next() < 0.5f) stereo.neck = dice.between(0.0f, 0.1f);
  if (dice.next() < 0.5f) stereo.axis = vec3(0.0f, 2.0f, 0.0f);
  stereo.mirrored = dice.next() < 0.3f;
  stereo.top.mode = any_closed_merge(dice);
  stereo.bottom.mode = any_closed_merge(dice);
  stereo.top.start = 20.0f, stereo.bottom.start = 0.0f;
  if (dice.next() < 0.5f) stereo.bottom.exponent = 2.0f;
  return stereo;
}

// The ray as defined by ods/kernel/camera/camera.h, in world coordinates.
inline ExactRay exact_ray(const StereoCamera& stereo, const Camera& camera, double side, dvec2 uv) {
  const dvec3 d = normalize(exact_direction(stereo.projection, uv));
  const dvec3 right(camera.right), up(camera.up), back(camera.back);
  const dvec3 axis = stereo.axis ? normalize(dvec3(*stereo.axis)) : up;
  dvec3 direction = right * d.x + up * d.y + back * d.z;
  const dvec3 a(dot(axis, right), dot(axis, up), dot(axis, back));
  const double half = double{stereo.ipd} / 2.0;
  dvec3 look = d;
  if (stereo.convergence == kShift) {
    const double turn = side * std::asin(half / double{stereo.convergence_distance});
    look = d * std::cos(turn) + cross(a, d) * std::sin(turn) + a * dot(a, d) * (1.0 - std::cos(turn));
  }
  const double phi = std::asin(std::clamp(dot(look, a), -1.0, 1.0));
  const double left = exact_factor(phi < 0.0 ? stereo.bottom : stereo.top, phi);
  const dvec3 heading = normalize(look - a * dot(look, a));
  dvec3 sideways = cross(heading, a) * (side * half * left);
  if (stereo.head_tilt_map) {
    const double tilt = (exact_map_at(*stereo.head_tilt_map, look) - 0.5) * kExactPi;
    sideways = sideways * std::cos(tilt) + cross(look, sideways) * std::sin(tilt);  // look is perpendicular to it
  }
  const dvec3 origin = sideways + heading * (double{stereo.neck} * left);
  if (stereo.convergence == kToeIn) look = normalize(look * double{stereo.convergence_distance} - sideways);
  direction = right * look.x + up * look.y + back * look.z;
  return {dvec3(stereo.position) + right * origin.x + up * origin.y + back * origin.z, direction};
}

// Compares rays of all eyes through random positions of the picture; origins within `origin_tolerance` metres.
inline void expect_exact_rays(const StereoCamera& stereo, int count, double origin_tolerance, Dice& dice) {
  const ProjectionSetting& setting = stereo.projection;
  const Camera camera = make_camera(stereo);
  for (int i = 0; i < count; i++) {
    const vec2 uv = dice.pair();
    if (has_image_circle(setting.kind) && !in_circle(setting, uv)) continue;
    const int eye = i % 3;
    const Ray ray = camera_ray(camera, eye, uv);
    const ExactRay exact = exact_ray(stereo, camera, double{eye_side(eye)}, uv);
    ASSERT_LT(angle_between(ray.direction, exact.direction), 1.5e-6 + rounding(setting, uv))
        << projection_name(setting);
    // The heading of a ray close to the pole is as uncertain as its horizontal direction is small.
    const dvec3 a = stereo.axis ? dvec3(0, 1, 0) : dvec3(camera.up);
    const double level = std::max(length(cross(exact.direction, a)), 1e-6);
    ASSERT_LT(length(dvec3(ray.origin) - exact.origin), origin_tolerance + 1e-7 / level) << projection_name(setting);
  }
}

}  // namespace ods
