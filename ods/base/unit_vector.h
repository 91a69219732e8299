// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Normalizes vectors that may be zero.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace ods {

// Returns v normalized, or `fallback` if its length is zero or overflows a double.
inline glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double size = glm::length(v);
  return std::isfinite(size) && size > 1e-100 ? v / size : fallback;
}

}  // namespace ods
