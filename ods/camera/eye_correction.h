// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the right eye's picture match the left one's, for a pair of cameras that were not aligned or set alike. A
// rotation gives the picture that a camera turned by these angles would have taken. A raise is not a rotation: it moves
// every direction up by the same angle, as if the rows of a lat-long picture were moved.
//
// The direction of a corrected picture is computed from the stored one in these steps: rotated; lowered by `raise`; its
// heading and elevation divided by `zoom`.
#pragma once
#include "ods/kernel/math.h"

namespace ods {

struct EyeCorrection {
  float yaw = 0.0f;    // degrees to the right, as in StereoCamera
  float pitch = 0.0f;  // degrees up
  float roll = 0.0f;   // degrees clockwise
  float raise = 0.0f;  // degrees by which the picture moves up
  float zoom = 1.0f;   // > 0; enlarges headings and elevations about the middle of the picture
  vec3 gain{1.0f};     // factors of linear red, green and blue, >= 0
  float gamma = 1.0f;  // > 0; linear light is raised to this power before the gain

  bool operator==(const EyeCorrection&) const = default;
};

bool moves_pixels(const EyeCorrection& correction);
bool changes_colors(const EyeCorrection& correction);

// The direction in the stored picture that a corrected picture shows in this direction. Both are in the camera's frame;
// `direction` has any length but 0, the result is a unit vector.
vec3 stored_direction(const EyeCorrection& correction, vec3 direction);

// Applies gain and gamma to linear light; the result is not negative.
vec3 corrected_color(const EyeCorrection& correction, vec3 light);

}  // namespace ods
