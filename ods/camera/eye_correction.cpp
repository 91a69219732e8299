// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/eye_correction.h"

#include <cmath>

#include "ods/camera/projection.h"

namespace ods {

bool moves_pixels(const EyeCorrection& correction) {
  EyeCorrection still = correction;
  still.gain = vec3(1.0f), still.gamma = 1.0f;
  return !(still == EyeCorrection());
}

bool changes_colors(const EyeCorrection& correction) {
  return correction.gain != vec3(1.0f) || correction.gamma != 1.0f;
}

vec3 stored_direction(const EyeCorrection& correction, vec3 direction) {
  const auto radians = [](float degrees) { return glm::radians(static_cast<double>(degrees)); };
  const auto [right, up, back] =
      orientation(radians(correction.yaw), radians(correction.pitch), radians(correction.roll));
  const glm::dvec3 d = right * double{direction.x} + up * double{direction.y} + back * double{direction.z};
  const double theta = std::atan2(d.x, -d.z) / double{correction.zoom};
  const double phi = (std::atan2(d.y, std::hypot(d.x, d.z)) - radians(correction.raise)) / double{correction.zoom};
  return vec3(glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi)));
}

vec3 corrected_color(const EyeCorrection& correction, vec3 light) {
  return correction.gain * pow(light, vec3(correction.gamma));
}

}  // namespace ods
