// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/scene.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "ods/kernel/surface.h"

namespace ods {

TextureSlot no_texture() {
  TextureSlot slot;
  slot.texture = -1;
  slot.uv_set = 0;
  slot.offset = vec2(0.0f);
  slot.axis_u = vec2(1.0f, 0.0f);
  slot.axis_v = vec2(0.0f, 1.0f);
  return slot;
}

vec3 direction_of(float azimuth, float elevation) {
  return vec3(sin(azimuth) * cos(elevation), sin(elevation), -cos(azimuth) * cos(elevation));
}

Material default_material() {
  Material material;
  material.base_color = vec4(1.0f);
  material.emission = vec3(0.0f);
  material.metallic = 0.0f;
  material.roughness = 1.0f;
  material.normal_scale = 1.0f;
  material.ior = 1.5f;
  material.transmission = 0.0f;
  material.thickness = 0.0f;
  material.attenuation_color = vec3(1.0f);
  material.attenuation_distance = 0.0f;
  material.alpha_mode = kAlphaOpaque;
  material.alpha_cutoff = 0.5f;
  material.double_sided = 1;
  material.unlit = 0;
  material.layers = -1;
  material.base_color_slot = no_texture();
  material.metallic_roughness_slot = no_texture();
  material.normal_slot = no_texture();
  material.emission_slot = no_texture();
  material.transmission_slot = no_texture();
  return material;
}

MaterialLayers default_layers() {
  MaterialLayers layers;
  layers.specular_color = vec3(1.0f);
  layers.specular = 1.0f;
  layers.clearcoat = 0.0f;
  layers.clearcoat_roughness = 0.0f;
  layers.clearcoat_normal_scale = 1.0f;
  layers.sheen_color = vec3(0.0f);
  layers.sheen_roughness = 0.0f;
  layers.anisotropy = 0.0f;
  layers.anisotropy_rotation = 0.0f;
  layers.iridescence = 0.0f;
  layers.iridescence_ior = 1.3f;
  layers.iridescence_thinnest = 100.0f;
  layers.iridescence_thickest = 400.0f;
  layers.dispersion = 0.0f;
  layers.diffuse_transmission = 0.0f;
  layers.diffuse_transmission_color = vec3(1.0f);
  for (TextureSlot* slot :
       {&layers.specular_slot, &layers.specular_color_slot, &layers.clearcoat_slot, &layers.clearcoat_roughness_slot,
        &layers.clearcoat_normal_slot, &layers.sheen_color_slot, &layers.sheen_roughness_slot, &layers.anisotropy_slot,
        &layers.iridescence_slot, &layers.iridescence_thickness_slot, &layers.diffuse_transmission_slot,
        &layers.diffuse_transmission_color_slot}) {
    *slot = no_texture();
  }
  return layers;
}

// Moves a scene's first mesh instead of copying it, unless most of the reserved memory is for other meshes.
template <class T>
static void append(std::vector<T>& list, std::vector<T> added) {
  if (list.empty() && list.capacity() / 2 <= added.size()) {
    list = std::move(added);
  } else {
    list.insert(list.end(), added.begin(), added.end());
  }
}

int add_mesh(Scene& scene, std::vector<Vertex> vertices, std::vector<uvec3> triangles, int material) {
  assert(material >= 0);
  Mesh mesh;
  mesh.first_vertex = static_cast<uint>(scene.vertices.size());
  mesh.vertex_count = static_cast<uint>(vertices.size());
  mesh.first_triangle = static_cast<uint>(scene.triangles.size());
  mesh.triangle_count = static_cast<uint>(triangles.size());
  mesh.material = material;
  mesh.motion = -1;
  append(scene.vertices, std::move(vertices));
  append(scene.triangles, std::move(triangles));
  scene.meshes.push_back(mesh);
  return static_cast<int>(scene.meshes.size()) - 1;
}

void add_instance(Scene& scene, int mesh, const glm::mat4& object_to_world) {
  assert(mesh >= 0 && mesh < static_cast<int>(scene.meshes.size()));
  const glm::mat4 rows = glm::transpose(object_to_world);
  Instance instance;
  instance.row0 = rows[0];
  instance.row1 = rows[1];
  instance.row2 = rows[2];
  instance.mesh = mesh;
  instance.first_light = -1;
  instance.motion = -1;
  instance.role = kOrdinary;
  scene.instances.push_back(instance);
}

bool is_hidden(const Scene& scene, size_t instance) {
  return !scene.hidden.empty() && scene.hidden[instance] != 0;
}

bool has_absences(const Instance& instance) {
  return instance.role == kUnseen || instance.role == kPureLight || instance.role == kOutline;
}

bool is_anything_visible(const Scene& scene) {
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (!is_hidden(scene, i)) return true;
  }
  return false;
}

Bounds scene_bounds(const Scene& scene) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Bounds bounds{vec3(kFar), vec3(-kFar)};
  for (size_t k = 0; k < scene.instances.size(); k++) {
    const Instance& instance = scene.instances[k];
    if (is_hidden(scene, k) || instance.role == kPureLight) continue;
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (uint i = 0; i < mesh.vertex_count; i++) {
      const vec4 p(scene.vertices[mesh.first_vertex + i].position, 1.0f);
      const vec3 world(dot(instance.row0, p), dot(instance.row1, p), dot(instance.row2, p));
      bounds.low = min(bounds.low, world), bounds.high = max(bounds.high, world);
    }
  }
  return bounds.low.x <= bounds.high.x ? bounds : Bounds();
}

bool uses_own_camera(const Scene& scene) {
  return !scene.view_points.empty() && !(scene.viewing && scene.viewing->replaces_cameras);
}

ViewPoint default_view(const Scene& scene) {
  if (uses_own_camera(scene)) return scene.view_points.front();
  if (scene.viewing) return scene.viewing->view;
  const float kEyeHeight = 1.6f;
  const float kElbowRoom = 1.0f;
  const Bounds bounds = scene_bounds(scene);
  const vec3 low = bounds.low, high = bounds.high, middle = 0.5f * (low + high);
  const auto inside = [&](vec3 p) {
    return p.x - kElbowRoom > low.x && p.x + kElbowRoom < high.x && p.z - kElbowRoom > low.z &&
           p.z + kElbowRoom < high.z && p.y > low.y && p.y < high.y;
  };
  ViewPoint view;
  view.position = vec3(0.0f, kEyeHeight, 0.0f);
  view.name = "eye height above the origin";
  if (inside(view.position)) return view;
  view.position = vec3(middle.x, low.y + kEyeHeight, middle.z);
  view.name = "eye height in the middle of the scene";
  if (inside(view.position)) return view;
  const vec3 size = high - low;
  view.position = vec3(middle.x, middle.y, high.z + std::max({size.x, size.y, size.z}));
  view.name = "in front of the scene";
  return view;
}

bool is_emissive(const Material& material) {
  return material.unlit == 0 && luminance(material.emission) > 0.0f;
}

bool has_light(const Scene& scene) {
  if (!scene.lights.empty() || scene.environment.radiance != vec3(0.0f)) return true;
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    return material.unlit != 0 || (is_emissive(material) && material.emission_slot.texture < 0);
  });
}

}  // namespace ods
