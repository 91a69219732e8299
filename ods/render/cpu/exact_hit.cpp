// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/cpu/exact_hit.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ods {

// Source: Moeller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection" (1997).
double place_exactly(PathTracer& tracer, const Ray& ray, Hit& hit) {
  const auto triangle = tracer.triangle_of(tracer.instance_now(hit.instance), tracer.corners_of(hit));
  const glm::dvec3 ab(triangle.ab), ac(triangle.ac), direction(ray.direction);
  const glm::dvec3 from = glm::dvec3(ray.origin) - glm::dvec3(triangle.a);
  const glm::dvec3 p = glm::cross(direction, ac), q = glm::cross(from, ab);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return std::numeric_limits<double>::infinity();
  hit.u = static_cast<float>(std::clamp(glm::dot(from, p) / determinant, 0.0, 1.0));
  hit.v = static_cast<float>(std::clamp(glm::dot(direction, q) / determinant, 0.0, 1.0 - double{hit.u}));
  return std::max(0.0, glm::dot(ac, q) / determinant);
}

double ExactRays::distance(PathTracer& tracer, uint ray, Hit& candidate) const {
  tracer.ray_time = times[ray];
  const double t = place_exactly(tracer, rays[ray], candidate);
  if (lengths) return t <= double{lengths[ray]} ? t : -1.0;
  const NearestHit& other = nearest[ray];
  const bool is_nearer =
      std::tie(t, candidate.instance, candidate.triangle) < std::tie(other.t, other.hit.instance, other.hit.triangle);
  return std::isfinite(t) && is_nearer ? t : -1.0;
}

void ExactRays::keep(uint ray, double distance, const Hit& candidate) const {
  nearest[ray] = {distance, candidate};
  nearest[ray].hit.t = static_cast<float>(distance);
}

}  // namespace ods
