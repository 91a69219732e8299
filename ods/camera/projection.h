// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Projections as users set them: names, degrees, defaults. The formulas are in ods/kernel/camera/projection.h.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "ods/kernel/camera/projection.h"

namespace ods {

inline constexpr std::array<float, 5> kCyclesPolynomial = {-1.1735143712967577e-05f, -0.019988736953434998f,
                                                           -3.3525322965709175e-06f, 3.099275275886036e-06f,
                                                           -2.6064646454854524e-08f};

// Angles are in degrees. Longitudes grow to the right, latitudes upwards, 0 is ahead.
struct ProjectionSetting {
  int kind = kLatLong;
  // Ranges are in camera_fields.h.
  vec2 longitude{-180.0f, 180.0f};  // left and right edge, at most 360 apart (kLatLong, kCylinder)
  vec2 latitude{-90.0f, 90.0f};     // bottom and top edge; for a cylinder within +-89
  float fov = 180.0f;               // kFisheye...: from edge to edge, at most 360; kPerspective: horizontal, below 180
  float aspect = 1.0f;              // kPerspective: width over height
  // kFisheyePolynomial, whose field of view is `fov`: a sensor in millimetres, and K0 .. K4. At r millimetres from the
  // sensor's centre the ray is -(K0 + K1 r + K2 r^2 + K3 r^3 + K4 r^4) radians away from the axis. These are Cycles'
  // parameters and defaults, which are close to a lens of 50 mm.
  vec2 sensor{36.0f, 24.0f};
  std::array<float, 5> polynomial = kCyclesPolynomial;
  float pan = 0.0f;   // has_lens(): direction of the lens, to the right
  float tilt = 0.0f;  // direction of the lens, upwards; the viewing circle does not move

  bool operator==(const ProjectionSetting&) const = default;
};

// A projection under a name for users. Several names may share a kind with different defaults: `vr180` is the front
// half of `lat-long`, `dome` a fisheye that looks up.
struct NamedProjection {
  std::string_view name;
  std::string_view summary;
  ProjectionSetting setting;
  double usual;  // logarithm of the frequency of files of this projection without metadata; 0 for lat-long
};
std::span<const NamedProjection> named_projections();
const NamedProjection* find_projection(std::string_view name);

// The name of a setting: the first name whose kind and default numbers match it, otherwise the first name of the kind.
std::string_view projection_name(const ProjectionSetting& setting);

// The kinds of a family, such as has_lens, as text for a message: "fisheye and perspective".
std::string kinds_with(bool (*trait)(int kind));

// Returns whether a setting is the whole sphere in lat-long, which players assume if the metadata does not specify
// another.
bool is_full_lat_long(const ProjectionSetting& setting);

// Returns whether a setting is vr180, the front half of the sphere in lat-long.
bool is_vr180(const ProjectionSetting& setting);

// Describes the fault of a setting, for messages. Empty if it has none.
std::string projection_fault(const ProjectionSetting& setting);

// The height that gives a picture of this width its true shape; at least 1.
int natural_height(const ProjectionSetting& setting, int width);

// The number of pixels per radian at the centre of a picture of this width, horizontally.
double pixels_per_radian(const ProjectionSetting& setting, double width);

// The number that the width of one eye must be a multiple of, because cubes need whole faces; 1 for all others.
int width_step(const ProjectionSetting& setting);

// The right, up and back vectors of a camera that looks along -Z and is rolled clockwise, then pitched up, then turned
// to the right. Angles in radians.
std::array<glm::dvec3, 3> orientation(double yaw, double pitch, double roll);

// Precondition: projection_fault() is empty.
Projection make_projection(const ProjectionSetting& setting);

}  // namespace ods
