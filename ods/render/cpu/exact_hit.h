// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes the hit of a ray and a triangle, and the first triangle hit, with the same bits on every processor. Embree
// divides by the processor's approximate reciprocals, whose last bits are each maker's own; so its distances only
// choose the candidates.
#pragma once
#include <limits>

#include "ods/kernel/path.h"

namespace ods {

// Sets the hit's u and v. Returns its distance; infinity if the ray runs along the triangle. Precondition: the hit's
// instance and triangle are set, and the tracer's ray_time.
double place_exactly(PathTracer& tracer, const Ray& ray, Hit& hit);

struct NearestHit {
  double t = std::numeric_limits<double>::infinity();
  Hit hit{-1.0f, 0.0f, 0.0f, -1, -1};  // t < 0: none
};

// One or several rays, for which Embree names candidates. Of those in one place, the first in the scene counts, in
// whatever order they come.
struct ExactRays {
  const Ray* rays = nullptr;
  const float* times = nullptr;
  const float* lengths = nullptr;  // of shadow rays
  NearestHit* nearest = nullptr;   // of others

  // Places a candidate, and returns its distance; negative if a ray ends before it, or meets something else first.
  double distance(PathTracer& tracer, uint ray, Hit& candidate) const;
  // Makes a candidate that distance() has placed the nearest.
  void keep(uint ray, double distance, const Hit& candidate) const;
};

// A candidate that Embree finds up to this many times as far away as the nearest one may be nearer.
inline constexpr float kCandidates = 1.0f + 1e-5f;

}  // namespace ods
