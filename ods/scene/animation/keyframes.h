// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers that change with time, given at some times: glTF 2.0's animation samplers.
#pragma once
#include <span>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

enum class Interpolation { kStep, kLinear, kCubicSpline };

struct Keyframes {
  Interpolation interpolation = Interpolation::kLinear;
  bool rotation = false;      // the numbers are a quaternion x, y, z, w, and stay of unit length
  size_t width = 1;           // how many numbers change together
  std::vector<float> times;   // seconds, never falling; not empty
  std::vector<float> values;  // width for each time; of kCubicSpline the tangent in, the value and the tangent out
};

// The numbers at a time; before the first key and after the last they stand still.
//   kStep         the key before;
//   kLinear       straight between two keys; rotations along the shorter arc at constant speed (slerp);
//   kCubicSpline  Hermite's curve through the keys, tangents per second; rotations are made unit length again.
// Source: glTF 2.0, appendix C. Precondition: out.size() == width.
void evaluate(const Keyframes& keys, double seconds, std::span<double> out);

}  // namespace ods
