// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A triangle that moves in front of a box, and what its film shows of it.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ods/kernel/surface.h"
#include "ods/layers/film/film_geometry.h"
#include "ods/scene/motion.h"
#include "tests/support/moving_files.h"

namespace ods::film_scene {

constexpr float kHalf = 0.70710678f;
inline const std::vector<double> kTimes = {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0};

inline GltfBuilder turning(bool is_double_sided) {
  GltfBuilder file = make_triangle();
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0, "translation": [-0.3, 0, -1.5]}])");
  file.json["materials"] = {
      {{"doubleSided", is_double_sided}, {"extensions", {{"KHR_materials_unlit", GltfJson::object()}}}}};
  file.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_animation_pointer"};
  file.primitive()["material"] = 0;
  animate(file, node_target(0, "rotation"), {0, 1, 2}, {0, 0, 0, 1, 0, kHalf, 0, kHalf, 0, 1, 0, 0}, "VEC4");
  animate(file, node_target(0, "translation"), {0, 2}, {-0.3f, 0, -1.5f, 0.5f, 0.2f, -2}, "VEC3");
  return file;
}

inline Scene playing(Scene scene) {
  play(scene.animation, "");
  set_time(scene, 0.0);
  return scene;
}

inline HeadBox small_box() {
  return {vec3(0.1f, 0.0f, 0.2f), vec3(0.3f)};
}

// A point of the triangle, at the present time.
inline vec3 triangle_point(const Scene& scene, vec2 weights) {
  const Instance& instance = scene.instances[0];
  const uint first = scene.meshes[static_cast<size_t>(instance.mesh)].first_vertex;
  const auto at = [&](uint i) { return to_world(instance, scene.vertices[first + i].position); };
  return at(0) + weights.x * (at(1) - at(0)) + weights.y * (at(2) - at(0));
}

struct FilmSpot {
  bool found = false;
  size_t texture = 0;
  vec2 uv{0.0f};
};

// The triangle of a film that an eye sees at a point at a frame.
inline FilmSpot spot_at(const LayerFilm& film, size_t frame, vec3 point, vec3 eye) {
  for (const LayerMover& mover : film.movers) {
    for (const MoverMesh& mesh : mover.meshes) {
      const std::vector<vec3>& positions = mesh.shapes.empty() ? mesh.positions : mesh.shapes[frame];
      for (const uvec3& corners : mesh.triangles) {
        const vec3 a = at_pose(mover.poses[frame], positions[corners.x]);
        const vec3 ab = at_pose(mover.poses[frame], positions[corners.y]) - a;
        const vec3 ac = at_pose(mover.poses[frame], positions[corners.z]) - a;
        const vec3 normal = cross(ab, ac), to = point - a;
        const float v = dot(cross(ab, to), normal) / dot(normal, normal);
        const float u = dot(cross(to, ac), normal) / dot(normal, normal);
        if (dot(normal, eye - a) <= 0.0f || abs(dot(normalize(normal), to)) > 1e-3f) continue;
        if (u < -1e-3f || v < -1e-3f || u + v > 1.001f) continue;
        const vec2 uv = (1 - u - v) * mesh.uvs[corners.x] + u * mesh.uvs[corners.y] + v * mesh.uvs[corners.z];
        return {true, mesh.texture, uv};
      }
    }
  }
  return {};
}

// Calls check(frame, point, eye, faces) for random points, eyes in the box, and all frames.
template <typename Check>
void for_each_look(Scene& scene, const std::vector<double>& times, const HeadBox& box, const Check& check) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(0.0f, 1.0f);
  for (size_t frame = 0; frame < times.size(); frame++) {
    set_time(scene, times[frame]);
    for (int i = 0; i < 300; i++) {
      vec2 weights(any(random), any(random));
      if (weights.x + weights.y > 1.0f) weights = vec2(1.0f) - weights;
      const vec3 eye = box.center + box.size * (vec3(any(random), any(random), any(random)) - 0.5f);
      const vec3 point = triangle_point(scene, weights);
      const vec3 normal = cross(triangle_point(scene, {1, 0}) - triangle_point(scene, {0, 0}),
                                triangle_point(scene, {0, 1}) - triangle_point(scene, {0, 0}));
      check(frame, point, eye, dot(normal, eye - point) > 0.0f);
    }
  }
}

}  // namespace ods::film_scene
