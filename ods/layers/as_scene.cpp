// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/as_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ods {

namespace {

uint packed(const float* pixel, int channels) {
  uint texel = 0xff000000u;
  for (int c = 0; c < channels; c++) {
    const auto byte = static_cast<uint>(std::lrint(std::clamp(pixel[c], 0.0f, 1.0f) * 255.0f));
    texel = (texel & ~(0xffu << 8 * c)) | byte << 8 * c;
  }
  return texel;
}

int add_texture(Scene& scene, const Image& image) {
  Texture texture{};
  texture.first_texel = static_cast<uint>(scene.texels.size());
  texture.width = image.width, texture.height = image.height;
  texture.wrap_u = texture.wrap_v = kWrapClamp;
  texture.srgb = 1;
  for (size_t i = 0; i < image.pixels.size(); i += static_cast<size_t>(image.channels)) {
    scene.texels.push_back(packed(&image.pixels[i], image.channels));
  }
  scene.textures.push_back(texture);
  return static_cast<int>(scene.textures.size()) - 1;
}

// Adds the unlit material of a mesh.
int add_unlit(Scene& scene, const LayerMesh& mesh) {
  Material material = default_material();
  material.unlit = 1;
  material.double_sided = 0;
  if (mesh.texture.width > 0) material.base_color_slot.texture = add_texture(scene, mesh.texture);
  if (mesh.kind == LayerKind::kMasked) material.alpha_mode = kAlphaMask, material.alpha_cutoff = 0.5f;
  if (mesh.kind == LayerKind::kBlended) material.alpha_mode = kAlphaBlend;
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

// The distance of the sky from the middle, beyond everything.
float sky_distance(const LayeredScene& layers) {
  float farthest = 100.0f;
  for (const LayerMesh& mesh : layers.meshes) {
    if (mesh.kind == LayerKind::kSky) continue;
    for (const vec3& position : mesh.positions) farthest = std::max(farthest, length(position - layers.box.center));
  }
  return 2.0f * farthest;
}

void add_vertex(std::vector<Vertex>& vertices, vec3 position, vec2 uv) {
  vertices.push_back({position, vec3(0, 1, 0), vec4(0.0f), uv, vec2(0.0f), vec4(1.0f)});
}

// Adds a moving object as it is in the first frame.
void add_mover(Scene& scene, const LayeredScene& layers, const LayerMover& mover) {
  for (const MoverMesh& mesh : mover.meshes) {
    LayerMesh look;
    look.kind = mesh.kind;
    if (!layers.film.lights.empty()) look.texture = layers.film.lights[mesh.texture].front();
    const int material = add_unlit(scene, look);
    std::vector<Vertex> vertices;
    for (size_t i = 0; i < mesh.positions.size(); i++) {
      add_vertex(vertices, at_pose(mover.poses.front(), mesh.positions[i]), mesh.uvs[i]);
    }
    add_instance(scene, add_mesh(scene, std::move(vertices), mesh.triangles, material), glm::mat4(1.0f));
  }
}

}  // namespace

Scene as_scene(const LayeredScene& layers) {
  Scene scene;
  scene.as_painted = true;
  const float far = sky_distance(layers);
  for (const LayerMesh& mesh : layers.meshes) {
    if (mesh.triangles.empty()) continue;
    const int material = add_unlit(scene, mesh);
    std::vector<Vertex> vertices;
    for (size_t i = 0; i < mesh.positions.size(); i++) {
      const vec3 position =
          mesh.kind == LayerKind::kSky ? layers.box.center + far * mesh.positions[i] : mesh.positions[i];
      add_vertex(vertices, position, mesh.uvs[i]);
    }
    add_instance(scene, add_mesh(scene, std::move(vertices), mesh.triangles, material), glm::mat4(1.0f));
  }
  for (const LayerMover& mover : layers.film.movers) {
    if (mover.poses.front().shown) add_mover(scene, layers, mover);
  }
  return scene;
}

}  // namespace ods
