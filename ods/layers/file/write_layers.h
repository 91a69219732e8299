// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a layered scene as one file, completely or not at all:
//
// NAME.glb, glTF 2.0. Every mesh is a node, a primitive and a material of its own, unlit (KHR_materials_unlit), clamped
// and mipmapped; a masked one has alpha mode MASK with a cutoff of 0.5, a blended one BLEND.
// The names say what they are: "page 0", "charts 1", "sky". The tree of nodes:
//
//   layers                     at the box's centre, from which all positions are measured
//     page 0, page 1, ...      without a transform of their own
//     sky                      scaled to enclose everything, for viewers that know nothing of it. Its extras,
//                              {"omnistereo": {"sky": true}}, say that it belongs at infinity
//     middle of the box        a camera that looks along the yaw
//
// A moving part of a film is a node "mover 0" beside the pages, with an animation: its translation, rotation and scale,
// linear between frames, and the weights of morph targets if it deforms, one target for each frame after the first. Its
// materials "film 0" show the first light; their extras, {"omnistereo": {"lights": [4, 5, 6]}}, are the numbers of the
// textures with the light at each of the metadata's `film.lights`. Something hidden has a scale of 0. Where the light
// of a still layer changes, the extras of its material are {"omnistereo": {"change": [...]}}, the eight numbers of
// ChangePlace in their order: their place in the textures of the metadata's `film.changes`.
//
// ods/layers/file/layers_info.h has the metadata of the file. By default, meshes are compressed with
// EXT_meshopt_compression and textures are WebP (EXT_texture_webp). Positions are floats with the filter EXPONENTIAL,
// each rounded as its distance from the box allows: it moves by at most a quarter of a pixel of the panorama. A point
// that two meshes share is rounded alike in both, so no cracks open between them, which grids of 16 bits for each mesh
// would not guarantee. Texture coordinates have 16 bits, which moves a texture of 2048 texels by at most 1/64 of a
// texel; those outside 0..1 are clamped.
//
// NAME.usdz, for Quick Look and Vision Pro: a stored .zip whose files start at multiples of 64 bytes. Its first file,
// layers.usda, is text, about 40 bytes a triangle, with as many digits as a quarter of a pixel needs. A material is a
// UsdPreviewSurface that only emits. **Untested on a device of Apple**: three.js's USDLoader reads it.
//
// Meshes without triangles are left out.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "ods/base/names.h"
#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"

namespace ods {

enum class LayerTextures { kWebp, kJpeg };

inline constexpr NameRow<LayerTextures> kLayerTexturesTable[] = {
    {LayerTextures::kWebp, "webp"}, {LayerTextures::kJpeg, "jpeg"},  // PNG where there is alpha
};
static_assert(has_every_member(kLayerTexturesTable));

struct WriteLayersOptions {
  bool plain = false;  // requires no extension: exact floats, JPEG and PNG; for Blender and every other viewer of glTF
  LayerTextures textures = LayerTextures::kWebp;  // of a .glb that is not plain
  int quality = 90;                               // of WebP and JPEG, 1 to 100
};

// The load on the graphics card that shows a layered scene.
struct LayersCost {
  size_t triangles = 0;
  size_t vertices = 0;
  size_t draw_calls = 0;     // one for each mesh that has triangles
  size_t texture_bytes = 0;  // on the graphics card
};
LayersCost cost_of(const LayeredScene& scene);

// Throws Error(kUsage) if the name is neither .glb nor .usdz, Error(kOutput) if no file can be written there.
void check_layers_path(const std::string& path);

// Throws Error(kUsage) if such a file cannot hold a film: a .usdz.
void check_film_path(const std::string& path);

// Writes the file that its extension names; returns its size in bytes. Preconditions: every mesh has a texture, of the
// channels that LayerMesh says, and finite positions; every corner exists. Throws as check_layers_path(),
// Error(kCancelled), Error(kOutput) if the format cannot hold it: 4 GB.
uint64_t write_layers(const LayeredScene& scene, const std::string& path, const WriteLayersOptions& options = {},
                      const Progress& progress = {});

}  // namespace ods
