// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of a file that the writers of layered scenes share.
#pragma once
#include <string>
#include <vector>

#include "ods/base/progress.h"
#include "ods/image/format/file_format.h"
#include "ods/layers/layered_scene.h"
#include "ods/scene/gltf/meshopt.h"

namespace ods {

// A mesh as files have it.
struct LayerPart {
  const LayerMesh* mesh = nullptr;
  std::string name;  // "page 0", "charts 1", "sky"; unique in the scene
  FileFormat format = FileFormat::kJpeg;
  std::string texture;  // the bytes of a file of this format
  ChangePlace change;   // of its light in a film
};

// The meshes that have triangles, with encoded textures. opaque, alpha: the format of textures without and with alpha.
// Throws Error(kCancelled).
std::vector<LayerPart> layer_parts(const LayeredScene& scene, FileFormat opaque, FileFormat alpha, int quality,
                                   const Progress& progress);

// A texture of a film: the bytes of a file for each of its lights.
struct FilmTexture {
  std::string name;  // "film 0"
  FileFormat format = FileFormat::kJpeg;
  std::vector<std::string> lights;
};
struct FilmTextures {
  std::vector<FilmTexture> moving;
  FilmTexture change;  // of the still layers' light; without lights if it does not change
};

// Encodes the textures of a film, as layer_parts() does those of still layers.
FilmTextures film_textures(const LayerFilm& film, FileFormat opaque, FileFormat alpha, int quality,
                           const Progress& progress);

// The order in which files have a mesh: what is drawn fastest, but blended triangles keep theirs.
MeshOrder order_of(const LayerMesh& mesh);

// A position as files have it: from the box's centre, or the direction of a sky.
vec3 stored_position(const LayeredScene& scene, const LayerMesh& mesh, size_t vertex);

// The largest step to whose multiples the coordinates of a stored position may be rounded: it moves by a quarter of a
// pixel of the panorama for an eye at the place in the box that is nearest to it.
float rounding_step(const LayeredScene& scene, const LayerMesh& mesh, const vec3& stored);

// The factor by which the sky must be enlarged to enclose everything; 1 without a sky.
float sky_scale(const LayeredScene& scene);

// The greatest distance of a vertex from the box's centre, in metres, with the enlarged sky.
float farthest(const LayeredScene& scene);

// Each returns the bytes of the whole file. Throw Error(kOutput) if the format cannot hold them; `path` is its name.
std::string layers_glb(const LayeredScene& scene, const std::vector<LayerPart>& parts, const FilmTextures& film,
                       bool plain, const std::string& path);
std::string layers_usdz(const LayeredScene& scene, const std::vector<LayerPart>& parts, const std::string& path);

}  // namespace ods
