// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/scene_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/stage/repeats.h"

namespace ods {

namespace {

constexpr int kNearDirections = 256;
constexpr int kOpenDirections = 512;
constexpr int kMaxPanes = 32;  // panes of glass behind each other
constexpr float kSteepest = 0.7071f;

// Repeated surfaces, and outlines.
std::vector<char> left_out(const Scene& scene) {
  std::vector<char> found = find_repeats(scene);
  for (size_t i = 0; i < found.size(); i++) {
    if (scene.instances[i].role == kOutline) found[i] = 1;
  }
  return found;
}

}  // namespace

SceneRays::SceneRays(const Scene& scene)
    : scene_(scene),
      no_lights_(without_lights(scene)),
      left_out_(left_out(scene)),
      embree_(scene, EmbreeScene::kMaxCopiedTriangles, left_out_) {
  set_scene(tracer_, scene_, no_lights_);
  tracer_.ray_time = 0.5f;
}

static bool is_two_sided(const Scene& scene, int instance) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[static_cast<size_t>(instance)].mesh)];
  return scene.materials[static_cast<size_t>(mesh.material)].double_sided != 0;
}

Sight SceneRays::look(vec3 from, vec3 direction) const {
  PathTracer tracer = tracer_;  // it has state while it decides about alpha
  const Ray ray{from, direction};
  tracer.start_path(ray, no_media(), 0u, 0u);
  const Hit hit = embree_.closest_hit(tracer, ray, kHalfAlphaRay);
  Sight sight;
  if (hit.t < 0.0f) return sight;
  const Surface surface = tracer.surface_at(hit, direction, true);
  sight.distance = hit.t;
  sight.front = surface.front;
  sight.two_sided = is_two_sided(scene_, hit.instance);
  sight.clear = surface.transmission > 0.5f;
  sight.normal = surface.geometric;
  sight.instance = hit.instance;
  sight.triangle = hit.triangle;
  return sight;
}

bool SceneRays::is_open(vec3 from, vec3 direction) const {
  for (int pane = 0; pane < kMaxPanes; pane++) {
    const Sight sight = look(from, direction);
    if (sight.leaves()) return true;
    if (!sight.clear) return false;
    from = offset_point(from + direction * sight.distance, -sight.normal);
  }
  return false;
}

// Source of the spiral: Gonzalez, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices",
// Mathematical Geosciences 42 (2010).
vec3 direction_at(float yaw, float elevation) {
  return direction_of(glm::radians(yaw), glm::radians(elevation));
}

std::vector<vec3> sphere_directions(int count) {
  std::vector<vec3> directions;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; i++) {
    const double y = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - y * y);
    directions.emplace_back(radius * std::cos(golden * i), y, radius * std::sin(golden * i));
  }
  return directions;
}

float free_radius(const SceneRays& rays, vec3 point) {
  static const std::vector<vec3> kDirections = sphere_directions(kNearDirections);
  float nearest = std::numeric_limits<float>::infinity();
  for (const vec3& direction : kDirections) nearest = std::min(nearest, rays.distance(point, direction));
  return nearest;
}

bool is_free(const SceneRays& rays, vec3 point, float radius) {
  static const std::vector<vec3> kDirections = sphere_directions(kNearDirections);
  return std::all_of(kDirections.begin(), kDirections.end(),
                     [&](vec3 direction) { return rays.distance(point, direction) >= radius; });
}

Bounds seen_bounds(const SceneRays& rays, vec3 point) {
  static const std::vector<vec3> kDirections = sphere_directions(kOpenDirections);
  std::vector<float> values[3];
  for (const vec3& direction : kDirections) {
    const Sight sight = rays.look(point, direction);
    if (sight.leaves()) continue;
    for (int axis = 0; axis < 3; axis++) values[axis].push_back((point + direction * sight.distance)[axis]);
  }
  Bounds seen{point, point};
  const size_t few = values[0].size() / 25;
  for (int axis = 0; axis < 3 && !values[0].empty(); axis++) {
    std::sort(values[axis].begin(), values[axis].end());
    seen.low[axis] = values[axis][few];
    seen.high[axis] = values[axis][values[axis].size() - 1 - few];
  }
  return seen;
}

Openness openness(const SceneRays& rays, vec3 point) {
  static const std::vector<vec3> kDirections = sphere_directions(kOpenDirections);
  int upper = 0, whole = 0;
  for (const vec3& direction : kDirections) {
    if (!rays.is_open(point, direction)) continue;
    whole++;
    if (direction.y > 0.0f) upper++;
  }
  return {static_cast<float>(upper) / (0.5f * kOpenDirections), static_cast<float>(whole) / kOpenDirections};
}

Surroundings surroundings(const SceneRays& rays, vec3 point) {
  static const std::vector<vec3> kDirections = sphere_directions(kNearDirections);
  int fronts = 0, backs = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (const vec3& direction : kDirections) {
    const Sight sight = rays.look(point, direction);
    if (!sight.leaves()) (sight.front || sight.two_sided ? fronts : backs)++;
    nearest = std::min(nearest, sight.distance);
  }
  return {static_cast<float>(fronts) / kNearDirections, static_cast<float>(backs) / kNearDirections, nearest};
}

std::optional<float> floor_below(const SceneRays& rays, vec3 point) {
  const Sight sight = rays.look(point, vec3(0.0f, -1.0f, 0.0f));
  if (sight.leaves() || sight.normal.y < kSteepest) return std::nullopt;
  return point.y - sight.distance;
}

}  // namespace ods
