// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/light_layers.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "ods/layers/light/display.h"
#include "ods/layers/light/push.h"
#include "ods/layers/light/sky_mesh.h"

namespace ods {

namespace {


// Copies light to the texels beside silhouettes, then fills all others.
void fill(const LayerGeometry& geometry, const std::vector<int>& lit, Image& light) {
  std::vector<int> owners = lit;
  for (const PushedTexel& push : geometry.pushed) {
    std::copy_n(&light.pixels[3 * push.from], 3, &light.pixels[3 * push.to]);
    owners[push.to] = owners[push.from];
  }
  push_outwards(light, owners, geometry.claims, kPushedRings);
}

// Reduces the light of a texture to what panes reflect of it.
void reflect(const LayerGeometry& geometry, size_t texture, Image& light) {
  const size_t texels = static_cast<size_t>(geometry.texture_size) * static_cast<size_t>(geometry.texture_size);
  for (size_t i = texture * texels; i < (texture + 1) * texels; i++) {
    for (size_t c = 0; c < 3; c++) light.pixels[3 * i + c] *= geometry.reflectance[i];
  }
}

// Turns a displayed colour that is added to what is behind into one with straight alpha. Where the colour is brighter
// than the alpha, as of a lamp that a window reflects, alpha grows to hold it.
void divide_by_alpha(float* texel) {
  const vec3 added(srgb_decode(texel[0]), srgb_decode(texel[1]), srgb_decode(texel[2]));
  texel[3] = std::clamp(std::max({texel[3], added.x, added.y, added.z}), 0.0f, 1.0f);
  for (int c = 0; c < 3; c++) texel[c] = texel[3] > 0.0f ? srgb_encode(std::min(added[c] / texel[3], 1.0f)) : 0.0f;
}

// One texture of those below each other, with its coverage if it is masked.
Image cut_texture(const Image& all, const std::vector<float>& coverage, int size, size_t index, LayerKind kind) {
  const bool masked = has_alpha(kind);
  Image texture(size, size, masked ? 4 : 3);
  const size_t texels = static_cast<size_t>(size) * static_cast<size_t>(size), first = index * texels;
  const size_t channels = static_cast<size_t>(texture.channels);
  for (size_t i = 0; i < texels; i++) {
    std::copy_n(&all.pixels[3 * (first + i)], 3, &texture.pixels[channels * i]);
    if (masked) texture.pixels[channels * i + 3] = coverage[first + i];
    if (kind == LayerKind::kBlended) divide_by_alpha(&texture.pixels[channels * i]);
  }
  return texture;
}

}  // namespace

LayeredScene light_layers(LayerGeometry geometry, const Scene& scene, const Renderer& renderer, const LayerLight& light,
                          const Progress& progress) {
  BakeOptions options = light.bake;
  options.viewer = geometry.scene.box.center;
  const auto rays = std::make_shared<const TexelRays>(std::move(geometry.rays));
  Image all = bake(renderer, rays, options, progress);
  fill(geometry, rays->owners, all);
  for (size_t i = 0; i < geometry.scene.meshes.size(); i++) {
    if (geometry.scene.meshes[i].kind == LayerKind::kBlended) reflect(geometry, i, all);
  }
  all = displayed(std::move(all), light.exposure, light.tone);
  std::vector<LayerMesh>& meshes = geometry.scene.meshes;
  for (size_t i = 0; i < meshes.size(); i++) {
    meshes[i].texture = cut_texture(all, geometry.coverage, geometry.texture_size, i, meshes[i].kind);
  }
  if (geometry.sees_sky) {
    std::vector<LayerMesh> sky = make_sky(scene, geometry.texture_size, light.exposure, light.tone);
    std::move(sky.begin(), sky.end(), std::back_inserter(meshes));
  }
  geometry.scene.light.exposure = light.exposure;
  geometry.scene.light.tone = light.tone;
  return std::move(geometry.scene);
}

}  // namespace ods
