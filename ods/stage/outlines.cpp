// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/outlines.h"

#include <algorithm>
#include <vector>

#include "ods/stage/scene_rays.h"

namespace ods {

namespace {

struct Face {
  vec3 middle;
  vec3 front;  // unit normal
};

Face face_of(const Scene& scene, const Instance& instance, uint triangle) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const uvec3 corners = scene.triangles[mesh.first_triangle + triangle];
  const auto at = [&](uint corner) {
    return to_world(instance, scene.vertices[mesh.first_vertex + size_t{corner}].position);
  };
  const vec3 a = at(corners.x), b = at(corners.y), c = at(corners.z);
  return {(a + b + c) / 3.0f, normalize(cross(b - a, c - a)) * handedness_of(instance)};
}

// Returns whether the fronts of a mesh face inwards: its volume, measured from the middle of its vertices, is negative.
bool is_inside_out(const Scene& scene, const Mesh& mesh) {
  const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
  glm::dvec3 middle(0.0);
  for (uint i = 0; i < mesh.vertex_count; i++) middle += glm::dvec3(vertices[i].position);
  middle /= static_cast<double>(mesh.vertex_count);
  double volume = 0.0;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 corners = scene.triangles[mesh.first_triangle + i];
    const auto at = [&](uint corner) { return glm::dvec3(vertices[corner].position) - middle; };
    volume += glm::dot(at(corners.x), glm::cross(at(corners.y), at(corners.z)));
  }
  return volume < 0.0;
}

bool may_be_outline(const Scene& scene, size_t instance) {
  const Instance& own = scene.instances[instance];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(own.mesh)];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const bool culls = material.double_sided == 0 && material.alpha_mode == kAlphaOpaque && material.transmission == 0.0f;
  return culls && own.role == kOrdinary && !is_hidden(scene, instance) && is_inside_out(scene, mesh);
}

bool surrounds_an_object(const SceneRays& rays, size_t instance) {
  constexpr uint kSamples = 200;
  constexpr float kNear = 0.05f;   // relative to the box around the mesh
  constexpr float kNearly = 0.8f;  // share of the faces
  const Scene& scene = rays.scene();
  const Instance& own = scene.instances[instance];
  const uint count = scene.meshes[static_cast<size_t>(own.mesh)].triangle_count, step = count / kSamples + 1;
  std::vector<Face> faces;
  for (uint i = 0; i < count; i += step) faces.push_back(face_of(scene, own, i));
  vec3 low = faces.front().middle, high = low;
  for (const Face& face : faces) low = min(low, face.middle), high = max(high, face.middle);
  const float reach = kNear * length(high - low);
  const auto near = std::ranges::count_if(faces, [&](const Face& face) {
    const Sight sight = rays.look(offset_point(face.middle, face.front), face.front);
    return sight.distance < reach && sight.front && static_cast<size_t>(sight.instance) != instance;
  });
  return static_cast<float>(near) > kNearly * static_cast<float>(faces.size());
}

}  // namespace

size_t mark_outlines(Scene& scene) {
  std::vector<size_t> candidates;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (may_be_outline(scene, i)) candidates.push_back(i);
  }
  if (candidates.empty()) return 0;
  const SceneRays rays(scene);
  std::erase_if(candidates, [&](size_t instance) { return !surrounds_an_object(rays, instance); });
  for (const size_t instance : candidates) scene.instances[instance].role = kOutline;
  return candidates.size();
}

}  // namespace ods
