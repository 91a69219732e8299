// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A small film of a layered scene in closed form.
#pragma once
#include <cmath>

#include "tests/support/layered_box.h"

namespace ods::layered_film {

inline Image plain(vec3 light) {
  Image image(16, 16, 3);
  for (size_t i = 0; i < image.pixels.size(); i++) image.pixels[i] = srgb_encode(light[static_cast<int>(i % 3)]);
  return image;
}

// A square that faces the box and has its origin in its middle.
inline MoverMesh panel(size_t texture, float half) {
  const LayerMesh square_of = square(LayerKind::kOpaque, vec3(0.0f), vec3(half, 0, 0), vec3(0, half, 0), 2, 0);
  return {LayerKind::kOpaque, texture, square_of.positions, square_of.uvs, square_of.triangles, {}};
}

inline constexpr vec3 kFirst(0.8f, 0.1f, 0.1f), kLast(0.1f, 0.2f, 0.9f), kOther(0.1f, 0.6f, 0.1f);

// A room in which a panel moves to the right, turns and becomes larger while its light changes; another one becomes
// wider, and a third one is there until the second frame.
inline LayeredScene film() {
  LayeredScene scene = layered_box();
  scene.yaw = 0.0f;
  scene.fallback.clear();
  std::erase_if(scene.meshes, [](const LayerMesh& mesh) { return mesh.kind == LayerKind::kMasked; });  // in the way
  scene.film.times = {0.0f, 0.5f, 1.0f};
  scene.film.light_times = {0.0f, 1.0f};
  scene.film.lights = {{plain(kFirst), plain(kLast)}, {plain(kOther), plain(kOther)}};
  const vec3 middle = scene.box.center;
  LayerMover moving{"mover 0", {panel(0, 0.2f)}, {}};
  for (const float t : scene.film.times) {
    const float angle = 0.4f * t;  // half of that about z
    moving.poses.push_back({middle + vec3(-0.5f + t, 0.2f, -1.2f), vec4(0, 0, std::sin(angle), std::cos(angle)),
                            vec3(1.0f + 0.5f * t), true});
  }
  LayerMover widening{"mover 1", {panel(1, 0.15f)}, {}};
  MoverMesh& mesh = widening.meshes[0];
  for (const float t : scene.film.times) {
    widening.poses.push_back({middle + vec3(0.0f, -0.45f, -1.2f), vec4(0, 0, 0, 1), vec3(1.0f), true});
    mesh.shapes.push_back(mesh.positions);
    for (vec3& position : mesh.shapes.back()) position.x *= 1.0f + 2.0f * t;
  }
  LayerMover leaving{"mover 2", {panel(1, 0.1f)}, widening.poses};
  for (LayerPose& pose : leaving.poses) pose.place.y += 0.95f;
  leaving.poses[1].shown = leaving.poses[2].shown = false;
  scene.film.movers = {moving, widening, leaving};
  return scene;
}

}  // namespace ods::layered_film
