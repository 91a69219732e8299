// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ods/stage/object_or_place.h"
#include "ods/stage/stands.h"

namespace ods {

namespace {

constexpr size_t kMaxSamples = 200000;  // triangles

struct Triangle {
  vec3 corners[3];
  vec3 middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0f; }
};

size_t visible_triangles(const Scene& scene) {
  size_t count = 0;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (!is_hidden(scene, i)) count += scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangle_count;
  }
  return count;
}

// Every n-th triangle, at most kMaxSamples in all.
std::vector<Triangle> sampled_triangles(const Scene& scene) {
  const size_t stride = visible_triangles(scene) / kMaxSamples + 1;
  std::vector<Triangle> triangles;
  size_t number = 0;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (is_hidden(scene, i)) continue;
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (uint k = 0; k < mesh.triangle_count; k++) {
      if (number++ % stride != 0) continue;
      const uvec3 corners = scene.triangles[mesh.first_triangle + k];
      const auto at = [&](uint corner) {
        return to_world(instance, scene.vertices[mesh.first_vertex + size_t{corner}].position);
      };
      triangles.push_back({{at(corners.x), at(corners.y), at(corners.z)}});
    }
  }
  return triangles;
}

// The range of the middle 96 percent of the values.
std::array<float, 2> bulk(std::vector<float> values) {
  const auto at = [&](double share) {
    const auto place =
        values.begin() + static_cast<ptrdiff_t>(std::llround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const float low = at(0.02);
  return {low, at(0.98)};
}

}  // namespace

Bounds core_bounds(const Scene& scene) {
  const std::vector<Triangle> triangles = sampled_triangles(scene);
  if (triangles.empty()) return {};
  vec3 low(0.0f), high(0.0f);
  for (int axis = 0; axis < 3; axis++) {
    std::vector<float> values;
    for (const Triangle& triangle : triangles) values.push_back(triangle.middle()[axis]);
    const auto [first, last] = bulk(std::move(values));
    low[axis] = first, high[axis] = last;
  }
  const vec3 size = high - low;
  const float reach = std::max({size.x, size.y, size.z});
  const auto is_near = [&](const Triangle& triangle) {
    return std::all_of(std::begin(triangle.corners), std::end(triangle.corners), [&](vec3 p) {
      return all(greaterThanEqual(p, low - reach)) && all(lessThanEqual(p, high + reach));
    });
  };
  Bounds core;
  bool empty = true;
  for (const Triangle& triangle : triangles) {
    if (!is_near(triangle)) continue;
    for (const vec3& p : triangle.corners) {
      core.low = empty ? p : min(core.low, p);
      core.high = empty ? p : max(core.high, p);
      empty = false;
    }
  }
  return empty ? scene_bounds(scene) : core;
}

float distance_to_see(const Scene& scene, const Bounds& core) {
  constexpr float kCotangent = 1.7320508f;  // cotangent of 30 degrees
  const vec3 middle = 0.5f * (core.low + core.high);
  float distance = 0.0f;
  for (const Triangle& triangle : sampled_triangles(scene)) {
    for (const vec3& corner : triangle.corners) {
      if (any(lessThan(corner, core.low)) || any(greaterThan(corner, core.high))) continue;
      const vec3 off = corner - middle;
      const float radius = std::hypot(off.x, off.z);
      distance = std::max({distance, 2.0f * radius, radius + kCotangent * std::abs(off.y)});
    }
  }
  return distance;
}

void for_views_from_outside(const Bounds& core, int count, const std::function<void(vec3 from, vec3 way)>& look) {
  const vec3 middle = 0.5f * (core.low + core.high), half = 0.5f * (core.high - core.low);
  const float radius = 2.0f * length(half);
  const std::vector<vec3> out = sphere_directions(count);
  for (size_t i = 0; i < out.size(); i++) {
    const vec3 aim = middle + 0.7f * half * out[(i * 97) % out.size()];
    const vec3 from = middle + radius * out[i];
    look(from, normalize(aim - from));
  }
}

float backs_seen_outside(const SceneRays& rays, const Bounds& core) {
  int hits = 0, backs = 0;
  for_views_from_outside(core, 256, [&](vec3 from, vec3 way) {
    const Sight sight = rays.look(from, way);
    if (sight.leaves()) return;
    hits++;
    backs += sight.front ? 0 : 1;
  });
  return hits == 0 ? 0.0f : static_cast<float>(backs) / static_cast<float>(hits);
}

// In a furnished room most triangles are furniture, so the core may have no walls. So the extent of the place is
// measured from a first stand. An object may be in a hall.
static void find_stand(const SceneRays& rays, float metres_per_unit, Survey& survey) {
  survey.stand = best_stand(rays, survey.core, metres_per_unit);
  const bool has_outliers = survey.core.low != survey.bounds.low || survey.core.high != survey.bounds.high;
  if (!survey.stand && has_outliers) {
    survey.stand = best_stand(rays, survey.bounds, metres_per_unit);
    if (survey.stand && survey.stand->open.upper > kOpenUpwards) survey.stand.reset();
  }
  if (!survey.stand) {
    survey.stand = best_float(rays, survey.core, metres_per_unit);
    return;
  }
  if (!has_outliers) return;
  const Bounds seen = seen_bounds(rays, survey.stand->eye);
  survey.core.low = min(survey.core.low, seen.low);
  survey.core.high = max(survey.core.high, seen.high);
  const std::optional<Stand> stand = best_stand(rays, survey.core, metres_per_unit);
  if (stand) survey.stand = stand;
}

// Objects and places in metres have similar sizes up to a few metres; larger ones are doubtful.
static bool may_be_object(const PlaceSigns& signs) {
  constexpr float kLikeObjects = 10.0f;
  return signs.backs_outside < 0.1f && signs.extent > kLikeObjects && signs.detail < 1.0f;
}

static void judge(const SceneRays& rays, float metres_per_unit, TakenFor taken_for, Survey& survey) {
  if (!survey.stand || taken_for == TakenFor::kPlace) return;
  const PlaceSigns signs = place_signs(rays, survey, metres_per_unit);
  const bool object = taken_for == TakenFor::kObject || is_object(signs);
  survey.doubted = taken_for == TakenFor::kAuto && (object || may_be_object(signs));
  if (!object) return;
  survey.refused = std::exchange(survey.stand, std::nullopt);
  survey.core = core_bounds(rays.scene());
}

Survey survey(const SceneRays& rays, float metres_per_unit, TakenFor taken_for) {
  Survey survey;
  const Scene& scene = rays.scene();
  survey.has_light = has_light(scene);
  if (visible_triangles(scene) == 0) return survey;
  survey.bounds = scene_bounds(scene);
  survey.core = core_bounds(scene);
  find_stand(rays, metres_per_unit, survey);
  judge(rays, metres_per_unit, taken_for, survey);
  survey.kind = !survey.stand                             ? SceneKind::kObject
                : survey.stand->open.upper > kOpenUpwards ? SceneKind::kOpenPlace
                                                          : SceneKind::kClosedRoom;
  return survey;
}

}  // namespace ods
