// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Between three values an equal way apart.
#pragma once

namespace ods {

// At t = 0 it is `a`, at 1 `b`, at 2 `c`.
template <class T>
T on_parabola(const T& a, const T& b, const T& c, float t) {
  return a + (b - a) * t + (c - 2.0f * b + a) * (0.5f * t * (t - 1.0f));
}

}  // namespace ods
