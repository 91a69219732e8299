// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/scene_file.h"

#include <algorithm>

#include "tests/support/png_files.h"

namespace ods {
namespace {

GltfJson json_of(vec3 v) {
  return GltfJson::array({v.x, v.y, v.z});
}

GltfJson json_of(const TextureSlot& slot) {
  return GltfJson{{"index", slot.texture}};
}

void add_textures(GltfBuilder& file, const Scene& scene) {
  for (const Texture& texture : scene.textures) {
    const auto texel = [&](int x, int y, int c) {
      const uint packed = scene.texels[texture.first_texel + static_cast<size_t>(y * texture.width + x)];
      return static_cast<float>(packed >> (8 * c) & 255u) / 255.0f;
    };
    add_texture(file, make_png(texture.width, texture.height, "RGB", SampleType::kUint8, texel));
  }
}

GltfJson json_of(const Material& material) {
  GltfJson json, extensions;
  GltfJson& surface = json["pbrMetallicRoughness"];
  const vec4 color = material.base_color;
  surface["baseColorFactor"] = {color.x, color.y, color.z, color.w};
  surface["metallicFactor"] = material.metallic;
  surface["roughnessFactor"] = material.roughness;
  if (material.base_color_slot.texture >= 0) surface["baseColorTexture"] = json_of(material.base_color_slot);
  json["doubleSided"] = material.double_sided == 1;
  const float strength = std::max({material.emission.x, material.emission.y, material.emission.z, 1.0f});
  json["emissiveFactor"] = json_of(material.emission / strength);
  if (material.emission_slot.texture >= 0) json["emissiveTexture"] = json_of(material.emission_slot);
  if (strength > 1.0f) extensions["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
  extensions["KHR_materials_ior"] = {{"ior", material.ior}};
  if (material.transmission > 0.0f) {
    extensions["KHR_materials_transmission"] = {{"transmissionFactor", material.transmission}};
    GltfJson& volume = extensions["KHR_materials_volume"];
    volume["thicknessFactor"] = material.thickness;
    if (material.attenuation_distance > 0.0f) {
      volume["attenuationDistance"] = material.attenuation_distance;
      volume["attenuationColor"] = json_of(material.attenuation_color);
    }
  }
  json["extensions"] = extensions;
  return json;
}

void add_meshes(GltfBuilder& file, const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    const TextureSlot& slot = scene.materials[static_cast<size_t>(mesh.material)].base_color_slot;
    std::vector<vec3> positions, normals;
    std::vector<vec2> places;
    for (uint i = 0; i < mesh.vertex_count; i++) {
      const Vertex& vertex = scene.vertices[mesh.first_vertex + i];
      positions.push_back(vertex.position);
      normals.push_back(vertex.normal);
      places.push_back(slot.offset + slot.axis_u * vertex.uv0.x + slot.axis_v * vertex.uv0.y);
    }
    const auto first = scene.triangles.begin() + static_cast<ptrdiff_t>(mesh.first_triangle);
    const std::vector<uvec3> triangles(first, first + static_cast<ptrdiff_t>(mesh.triangle_count));
    const auto add = [&](const auto& values, size_t width, int component, const char* type) {
      Binary bytes(values.size() * sizeof values[0]);
      std::memcpy(bytes.data(), values.data(), bytes.size());
      return file.add_bytes(bytes, values.size() * width, component, type);
    };
    GltfJson primitive;
    primitive["attributes"]["POSITION"] = add(positions, 3, kFloat, "VEC3");
    primitive["attributes"]["NORMAL"] = add(normals, 3, kFloat, "VEC3");
    primitive["attributes"]["TEXCOORD_0"] = add(places, 2, kFloat, "VEC2");
    primitive["indices"] = add(triangles, 3, kUint, "SCALAR");
    primitive["material"] = mesh.material;
    GltfJson json;
    json["primitives"].push_back(primitive);
    file.json["meshes"].push_back(json);
  }
}

// Appends a node to the scene.
GltfJson& add_node(GltfBuilder& file) {
  file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
  return file.json["nodes"].emplace_back(GltfJson::object());
}

void add_lamps(GltfBuilder& file, const Scene& scene) {
  for (const PunctualLight& light : scene.lights) {
    GltfJson& lamps = file.json["extensions"]["KHR_lights_punctual"]["lights"];
    GltfJson& node = add_node(file);
    node["translation"] = json_of(light.position);
    node["extensions"]["KHR_lights_punctual"]["light"] = lamps.size();
    const float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z, 1e-9f});
    GltfJson lamp;
    lamp["type"] = "point";
    lamp["color"] = json_of(light.intensity / strength);
    lamp["intensity"] = strength;
    lamps.push_back(lamp);
  }
}

}  // namespace

Binary glb_of(const Scene& scene) {
  GltfBuilder file;
  file.json["asset"]["version"] = "2.0";
  file.json["scenes"].push_back(GltfJson::object());
  file.json["nodes"] = GltfJson::array();
  add_textures(file, scene);
  for (size_t i = 0; i < scene.materials.size(); i++) {
    GltfJson& material = file.json["materials"].emplace_back(json_of(scene.materials[i]));
    if (i < scene.material_names.size()) material["name"] = scene.material_names[i];
  }
  add_meshes(file, scene);
  for (const Instance& instance : scene.instances) {
    GltfJson& node = add_node(file);
    node["mesh"] = instance.mesh;
    GltfJson& matrix = node["matrix"];
    for (int column = 0; column < 4; column++) {
      for (const vec4& row : {instance.row0, instance.row1, instance.row2}) matrix.push_back(row[column]);
      matrix.push_back(column == 3 ? 1.0f : 0.0f);
    }
  }
  add_lamps(file, scene);
  return file.glb();
}

}  // namespace ods
