// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real spherical harmonics of the orders 0 to 2, orthonormal over the sphere, in the scene's axes. Their order is
// (l, m) = (0,0) (1,-1) (1,0) (1,1) (2,-2) (2,-1) (2,0) (2,1) (2,2), where (1,-1) is proportional to y, (1,0) to z and
// (1,1) to x.
// Source: Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps", 2001.
#pragma once
#include <array>

#include "ods/layers/layered_scene.h"

namespace ods {

// The values in a direction of unit length.
inline std::array<float, LightProbe::kHarmonics> harmonics(vec3 d) {
  return {0.28209479f,
          0.48860251f * d.y,
          0.48860251f * d.z,
          0.48860251f * d.x,
          1.09254843f * d.x * d.y,
          1.09254843f * d.y * d.z,
          0.31539157f * (3.0f * d.z * d.z - 1.0f),
          1.09254843f * d.x * d.z,
          0.54627422f * (d.x * d.x - d.y * d.y)};
}

// The irradiance on a surface with this normal, in the unit of the radiance. A white Lambert surface has it over pi as
// its radiance.
inline vec3 irradiance(const LightProbe& probe, vec3 normal) {
  constexpr float kFactors[] = {3.14159265f, 2.09439510f, 0.78539816f};
  const std::array<float, LightProbe::kHarmonics> values = harmonics(normal);
  vec3 sum(0.0f);
  for (size_t i = 0; i < values.size(); i++) {
    sum += kFactors[i == 0 ? 0 : i < 4 ? 1 : 2] * values[i] * probe.radiance[i];
  }
  return sum;
}

}  // namespace ods
