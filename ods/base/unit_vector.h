// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The direction of a vector that may have none.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace ods {

// v at unit length; `fallback` where v has no length, or none that a double can hold.
inline glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double size = glm::length(v);
  return std::isfinite(size) && size > 1e-100 ? v / size : fallback;
}

}  // namespace ods
