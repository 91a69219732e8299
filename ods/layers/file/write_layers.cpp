// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/file/write_layers.h"

#include <fmt/format.h>

#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"
#include "ods/layers/file/layer_parts.h"

namespace ods {

static bool is_usdz(const std::string& path) {
  return small_letters(path).ends_with(".usdz");
}

void check_film_path(const std::string& path) {
  if (!is_usdz(path)) return;
  throw Error(ErrorKind::kUsage, fmt::format("cannot write '{}': a film of layers is a .glb; choose that", path));
}

void check_layers_path(const std::string& path) {
  if (!is_usdz(path) && !small_letters(path).ends_with(".glb")) {
    throw Error(ErrorKind::kUsage,
                fmt::format("cannot write '{}': a layered scene is a .glb or a .usdz; choose one of them", path));
  }
  check_writable(path);
}

static size_t texels_of(const Image& texture) {
  return static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height);
}

LayersCost cost_of(const LayeredScene& scene) {
  LayersCost cost;
  for (const LayerMesh& mesh : scene.meshes) {
    if (mesh.triangles.empty()) continue;
    cost.triangles += mesh.triangles.size();
    cost.vertices += mesh.positions.size();
    cost.draw_calls++;
    cost.texture_bytes += texture_bytes(texels_of(mesh.texture));
  }
  for (const LayerMover& mover : scene.film.movers) {
    for (const MoverMesh& mesh : mover.meshes) {
      cost.triangles += mesh.triangles.size();
      cost.vertices += mesh.positions.size();
      cost.draw_calls++;
    }
  }
  for (const std::vector<Image>& lights : scene.film.lights) {
    for (const Image& light : lights) {
      cost.texture_bytes += texture_bytes(texels_of(light));
    }
  }
  for (const Image& ratios : scene.film.change.ratios) cost.texture_bytes += texture_bytes(texels_of(ratios));
  return cost;
}

uint64_t write_layers(const LayeredScene& scene, const std::string& path, const WriteLayersOptions& options,
                      const Progress& progress) {
  check_layers_path(path);
  if (!scene.film.movers.empty()) check_film_path(path);
  const bool is_webp = !options.plain && !is_usdz(path) && options.textures == LayerTextures::kWebp;
  const FileFormat opaque = is_webp ? FileFormat::kWebp : FileFormat::kJpeg;
  const FileFormat alpha = is_webp ? FileFormat::kWebp : FileFormat::kPng;
  const std::vector<LayerPart> parts = layer_parts(scene, opaque, alpha, options.quality, progress);
  const FilmTextures film = film_textures(scene.film, opaque, alpha, options.quality, {{}, progress.cancelled});
  const std::string bytes =
      is_usdz(path) ? layers_usdz(scene, parts, path) : layers_glb(scene, parts, film, options.plain, path);
  write_file(path, bytes);
  return bytes.size();
}

}  // namespace ods
