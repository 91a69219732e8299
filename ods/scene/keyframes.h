// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Keyframe interpolation: glTF 2.0's animation samplers.
#pragma once
#include <span>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

enum class Interpolation { kStep, kLinear, kCubicSpline };

struct Keyframes {
  Interpolation interpolation = Interpolation::kLinear;
  bool rotation = false;      // quaternions x, y, z, w, kept at unit length
  size_t width = 1;           // values per key
  std::vector<float> times;   // seconds, in non-decreasing order; not empty
  std::vector<float> values;  // `width` per time; for kCubicSpline in-tangent, value, out-tangent
};

// The values at a time; constant before the first key and after the last.
//   kStep         the previous key;
//   kLinear       linear between two keys; rotations along the shorter arc at constant speed (slerp);
//   kCubicSpline  Hermite curve through the keys, tangents per second; rotations are renormalized.
// Source: glTF 2.0, appendix C. Precondition: out.size() == width.
void evaluate(const Keyframes& keys, double seconds, std::span<double> out);

}  // namespace ods
