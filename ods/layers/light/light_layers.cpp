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

constexpr int kRings = 16;  // texels of a chart without light that are that far from lit ones

// Copies light to the texels beside silhouettes, then fills all others.
void fill(const LayerGeometry& geometry, const std::vector<int>& lit, Image& light) {
  std::vector<int> owners = lit;
  for (const PushedTexel& push : geometry.pushed) {
    std::copy_n(&light.pixels[3 * push.from], 3, &light.pixels[3 * push.to]);
    owners[push.to] = owners[push.from];
  }
  push_outwards(light, owners, geometry.claims, kRings);
}

// One texture of those below each other, with its coverage if it is masked.
Image cut_texture(const Image& all, const std::vector<float>& coverage, int size, size_t index, bool masked) {
  Image texture(size, size, masked ? 4 : 3);
  const size_t texels = static_cast<size_t>(size) * static_cast<size_t>(size), first = index * texels;
  const size_t channels = static_cast<size_t>(texture.channels);
  for (size_t i = 0; i < texels; i++) {
    std::copy_n(&all.pixels[3 * (first + i)], 3, &texture.pixels[channels * i]);
    if (masked) texture.pixels[channels * i + 3] = coverage[first + i];
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
  all = displayed(std::move(all), light.exposure, light.tone);
  std::vector<LayerMesh>& meshes = geometry.scene.meshes;
  for (size_t i = 0; i < meshes.size(); i++) {
    meshes[i].texture =
        cut_texture(all, geometry.coverage, geometry.texture_size, i, meshes[i].kind == LayerKind::kMasked);
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
