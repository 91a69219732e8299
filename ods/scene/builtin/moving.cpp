// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/moving.h"

#include <algorithm>

#include "ods/scene/placement.h"

namespace ods {

int add_node(Scene& scene, int parent, vec3 position) {
  MovingNode node;
  node.parent = parent;
  node.translation = glm::dvec3(position);
  scene.animation.nodes.push_back(node);
  return static_cast<int>(scene.animation.nodes.size()) - 1;
}

int hang(Scene& scene, const Shape& shape, int material, int node, const glm::mat4& local) {
  const int mesh = add(scene, shape, material);
  const Bounds box = mesh_bounds(scene, scene.meshes[static_cast<size_t>(mesh)]);
  const int instance = static_cast<int>(scene.instances.size()) - 1;
  scene.animation.instances.push_back({instance, node, -1, glm::dmat4(local), box.low, box.high});
  return mesh;
}

Deformation& bend_last(Scene& scene) {
  MovingInstance& last = scene.animation.instances.back();
  last.deformation = static_cast<int>(scene.animation.deformations.size());
  Deformation& deformation = scene.animation.deformations.emplace_back();
  deformation.mesh = scene.instances[static_cast<size_t>(last.instance)].mesh;
  const Mesh& mesh = scene.meshes[static_cast<size_t>(deformation.mesh)];
  const auto first = scene.vertices.begin() + mesh.first_vertex;
  deformation.rest.assign(first, first + mesh.vertex_count);
  return deformation;
}

int add_moving_material(Scene& scene, int index) {
  const Material& material = scene.materials[static_cast<size_t>(index)];
  MovingMaterial moving;
  moving.material = index;
  moving.base_color = glm::dvec4(material.base_color);
  moving.emission = glm::dvec3(material.emission);
  moving.metallic = static_cast<double>(material.metallic);
  moving.roughness = static_cast<double>(material.roughness);
  if (material.layers >= 0) rest_at(moving, scene.material_layers[static_cast<size_t>(material.layers)]);
  const TextureSlot& slot = material.base_color_slot;
  moving.places[kBaseColorSlot] = {glm::dvec2(slot.offset), 0.0, {slot.axis_u.x, slot.axis_v.y}};
  scene.animation.materials.push_back(moving);
  return static_cast<int>(scene.animation.materials.size()) - 1;
}

void add_keys(Scene& scene, Property property, int target, Interpolation interpolation, std::vector<float> times,
              std::vector<float> values) {
  std::vector<Clip>& clips = scene.animation.clips;
  if (clips.empty()) clips.push_back({"all", 0.0, {}});
  Keyframes keys{interpolation, property == Property::kRotation, 0, std::move(times), std::move(values)};
  const size_t per_key = keys.values.size() / keys.times.size();
  keys.width = interpolation == Interpolation::kCubicSpline ? per_key / 3 : per_key;
  clips[0].end = std::max(clips[0].end, static_cast<double>(keys.times.back()));
  clips[0].tracks.push_back({property, target, std::move(keys)});
}

void add_keys(Scene& scene, Property property, int target, Interpolation interpolation, float seconds, int count,
              const std::function<std::vector<float>(float)>& value) {
  std::vector<float> times, values;
  for (int i = 0; i < count; i++) {
    const float share = static_cast<float>(i) / static_cast<float>(count - 1);
    times.push_back(share * seconds);
    const std::vector<float> numbers = value(share);
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  add_keys(scene, property, target, interpolation, times, values);
}

std::vector<float> quaternion(vec3 axis, float degrees) {
  const float half = 0.5f * glm::radians(degrees);
  const vec3 v = normalize(axis) * sin(half);
  return {v.x, v.y, v.z, cos(half)};
}

}  // namespace ods
