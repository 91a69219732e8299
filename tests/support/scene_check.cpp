// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/scene_check.h"

#include <cmath>

namespace ods {

template <class V>
static bool bounded(const V& v, float limit = 1e9f) {
  for (int i = 0; i < V::length(); i++) {
    if (!(std::abs(v[i]) <= limit)) return false;
  }
  return true;
}

static bool is_unit(const vec3& v) {
  return std::abs(glm::length(v) - 1.0f) < 1e-5f;
}

static bool in_unit(float x) {
  return x >= 0.0f && x <= 1.0f;
}

static std::string check_vertex(const Vertex& v) {
  if (!bounded(v.position)) return "position";
  if (!is_unit(v.normal)) return "normal";
  const vec3 tangent(v.tangent);
  if ((tangent != vec3(0.0f) && !is_unit(tangent)) || std::abs(v.tangent.w) != 1.0f) return "tangent";
  if (!bounded(v.uv0) || !bounded(v.uv1)) return "texture coordinates";
  for (int c = 0; c < 4; c++) {
    if (!in_unit(v.color[c])) return "vertex colour";
  }
  return "";
}

// Triangles of a deformed mesh may temporarily have no area.
static bool is_bent(const Scene& scene, size_t mesh) {
  for (const Deformation& deformation : scene.animation.deformations) {
    if (static_cast<size_t>(deformation.mesh) == mesh) return true;
  }
  return false;
}

static std::string check_mesh(const Scene& scene, const Mesh& mesh, bool bent) {
  if (mesh.triangle_count == 0 || size_t(mesh.first_triangle) + mesh.triangle_count > scene.triangles.size())
    return "triangle range";
  if (size_t(mesh.first_vertex) + mesh.vertex_count > scene.vertices.size()) return "vertex range";
  if (mesh.material < 0 || size_t(mesh.material) >= scene.materials.size()) return "material index";
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 t = scene.triangles[mesh.first_triangle + i];
    if (max(t.x, max(t.y, t.z)) >= mesh.vertex_count) return "corner";
    const Vertex* v = &scene.vertices[mesh.first_vertex];
    const vec3 normal = cross(v[t.y].position - v[t.x].position, v[t.z].position - v[t.x].position);
    if (bent ? std::isnan(dot(normal, normal)) : !(dot(normal, normal) > 0.0f) || !std::isfinite(dot(normal, normal)))
      return "area";
  }
  return "";
}

static std::string check_slots(const Scene& scene, std::initializer_list<TextureSlot> slots) {
  for (const TextureSlot& slot : slots) {
    if (slot.texture < -1 || slot.texture >= static_cast<int>(scene.textures.size())) return "texture index";
    if (slot.uv_set < 0 || slot.uv_set > 1) return "texture coordinate set";
    if (!bounded(slot.offset) || !bounded(slot.axis_u) || !bounded(slot.axis_v)) return "texture transform";
  }
  return "";
}

static std::string check_layers(const Scene& scene, const MaterialLayers& m) {
  for (const float share :
       {m.specular, m.clearcoat, m.clearcoat_roughness, m.sheen_color.x, m.sheen_color.y, m.sheen_color.z,
        m.sheen_roughness, m.anisotropy, m.iridescence, m.diffuse_transmission, m.diffuse_transmission_color.x,
        m.diffuse_transmission_color.y, m.diffuse_transmission_color.z}) {
    if (!in_unit(share)) return "layer's factor";
  }
  const bool film = m.iridescence_ior >= 1.0f && m.iridescence_thinnest >= 0.0f && m.iridescence_thickest >= 0.0f;
  if (!film || !bounded(vec3(m.iridescence_ior, m.iridescence_thinnest, m.iridescence_thickest))) return "film";
  if (!bounded(m.specular_color, 1e9f) || !bounded(vec2(m.anisotropy_rotation, m.dispersion))) return "layer's number";
  return check_slots(scene, {m.specular_slot, m.specular_color_slot, m.clearcoat_slot, m.clearcoat_roughness_slot,
                             m.clearcoat_normal_slot, m.sheen_color_slot, m.sheen_roughness_slot, m.anisotropy_slot,
                             m.iridescence_slot, m.iridescence_thickness_slot, m.diffuse_transmission_slot,
                             m.diffuse_transmission_color_slot});
}

static std::string check_material(const Scene& scene, const Material& m) {
  const std::string slots = check_slots(
      scene, {m.base_color_slot, m.metallic_roughness_slot, m.normal_slot, m.emission_slot, m.transmission_slot});
  if (!slots.empty()) return slots;
  if (m.layers < -1 || m.layers >= static_cast<int>(scene.material_layers.size())) return "layers index";
  if (m.layers >= 0) {
    const std::string layers = check_layers(scene, scene.material_layers[static_cast<size_t>(m.layers)]);
    if (!layers.empty()) return layers;
  }
  for (const float share :
       {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w, m.metallic, m.roughness, m.transmission}) {
    if (!in_unit(share)) return "factor";
  }
  if (!bounded(m.emission, 1e18f) || !(m.ior >= 1.0f && m.ior <= 1e8f)) return "emission or ior";
  return bounded(m.attenuation_color) && m.thickness >= 0.0f && bounded(vec2(m.thickness, m.attenuation_distance))
             ? ""
             : "volume";
}

std::string broken_promise(const Scene& scene) {
  std::string broken;
  for (size_t i = 0; i < scene.vertices.size() && broken.empty(); i++) broken = check_vertex(scene.vertices[i]);
  for (size_t i = 0; i < scene.meshes.size() && broken.empty(); i++)
    broken = check_mesh(scene, scene.meshes[i], is_bent(scene, i));
  for (size_t i = 0; i < scene.materials.size() && broken.empty(); i++)
    broken = check_material(scene, scene.materials[i]);
  if (!broken.empty()) return broken;
  for (const Texture& t : scene.textures) {
    if (t.width <= 0 || t.height <= 0 || t.first_texel + size_t(t.width) * size_t(t.height) > scene.texels.size())
      return "texels";
  }
  for (const Instance& i : scene.instances) {
    if (i.mesh < 0 || size_t(i.mesh) >= scene.meshes.size()) return "mesh index";
    if (!bounded(i.row0) || !bounded(i.row1) || !bounded(i.row2)) return "matrix";
    if (!(std::abs(glm::determinant(glm::dmat3(vec3(i.row0), vec3(i.row1), vec3(i.row2)))) > 0.0))
      return "singular matrix";
  }
  for (const PunctualLight& light : scene.lights) {
    if (!bounded(light.position) || !is_unit(light.direction) || !bounded(light.intensity, 1e18f)) return "light";
    if (!(light.range >= 0.0f && light.inner_cone >= 0.0f && light.inner_cone <= light.outer_cone))
      return "light's cone";
  }
  for (const ViewPoint& view : scene.view_points) {
    if (!bounded(view.position) || !bounded(vec3(view.yaw, view.pitch, view.roll), 180.01f)) return "view point";
  }
  if (!scene.hidden.empty() && scene.hidden.size() != scene.instances.size()) return "hidden";
  const Bounds bounds = scene_bounds(scene);
  return bounded(bounds.low, 1.001e9f) && bounded(bounds.high, 1.001e9f) ? "" : "bounds";
}

}  // namespace ods
