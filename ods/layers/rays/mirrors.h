// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Flat mirrors. What one shows looks like a second world behind its plane, the reflection of the first one, seen through
// the mirror's outline. World coordinates, metres.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct FlatMirror {
  int instance = 0;
  std::vector<uint> triangles;    // of its mesh, ascending
  std::vector<vec3> corners;      // of the triangles: three each
  vec3 normal{0.0f, 0.0f, 1.0f};  // unit length, on the side that reflects
  float height = 0.0f;            // of the plane: dot(normal, point on it)
  bool has_two_sides = false;     // both reflect
};

// The flat mirrors of visible instances: smooth metal (metallic > 0.5, roughness < 0.15) without textures that vary it
// or bend its normals, and without light or layers of its own; triangles in one plane whose vertices have its normal.
// Curved mirrors are none of these.
std::vector<FlatMirror> find_mirrors(const Scene& scene);

// Turns the mirror to a place. Returns false if it does not reflect on that side.
bool turn_to(FlatMirror& mirror, vec3 place);

// Metres in front of the plane; negative behind it.
inline float height_above(const FlatMirror& mirror, vec3 point) {
  return dot(mirror.normal, point) - mirror.height;
}

// The reflection of a point, and of a direction.
inline vec3 reflected_point(const FlatMirror& mirror, vec3 point) {
  return point - mirror.normal * (2.0f * height_above(mirror, point));
}
inline vec3 reflected_direction(const FlatMirror& mirror, vec3 direction) {
  return direction - mirror.normal * (2.0f * dot(mirror.normal, direction));
}

// Returns whether a point of the plane is in the mirror's outline, or at most `slack` metres outside one of its
// triangles.
bool is_in_outline(const FlatMirror& mirror, vec3 on_plane, float slack);

// Cuts triangles at the mirror's plane and keeps what is behind it. offset: of the positions, in the world.
void keep_behind(const FlatMirror& mirror, vec3 offset, std::vector<vec3>& positions, std::vector<uvec3>& triangles);

}  // namespace ods
