// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Quadratic interpolation of three equally spaced values.
#pragma once

namespace ods {

// Interpolates `a` at t = 0, `b` at t = 1, `c` at t = 2.
template <class T>
T on_parabola(const T& a, const T& b, const T& c, float t) {
  return a + (b - a) * t + (c - 2.0f * b + a) * (0.5f * t * (t - 1.0f));
}

}  // namespace ods
