// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Statistics of a scene, for `ods info`.
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ods/scene/scene.h"
#include "ods/scene/sheet_glass.h"

namespace ods {

struct SceneInfo {
  std::string name;
  size_t meshes = 0;
  size_t instances = 0;
  size_t triangles = 0;            // stored
  size_t instanced_triangles = 0;  // counted once per instance
  size_t emissive_triangles = 0;   // instanced triangles that emit light
  size_t materials = 0;            // used by a mesh
  size_t textures = 0;
  size_t texel_bytes = 0;
  size_t point_lights = 0;
  size_t spot_lights = 0;
  size_t directional_lights = 0;
  bool has_environment = false;
  Bounds bounds;                  // metres
  float nearest_surface = -1.0f;  // metres from the camera to the nearest triangle; -1 if there is none
  std::vector<ViewPoint> view_points;
  std::vector<std::pair<std::string, double>> animations;  // names and lengths in seconds
  std::vector<std::string> variants;
  std::vector<SheetGlass> sheet_glass;
  std::vector<UsedExtension> extensions;
  std::vector<std::string> losses;
  std::vector<std::string> warnings;
};

// Brute force over every instanced triangle whose mesh may contain the nearest one; exact.
SceneInfo describe(const Scene& scene, vec3 camera_position);

// The distance from a point to a triangle, edges and corners included. Source: Ericson, Real-Time Collision Detection,
// 5.1.5 (regions of the nearest point).
double point_triangle_distance(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

}  // namespace ods
