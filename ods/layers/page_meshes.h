// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The meshes of textures, put together from pieces of surfaces.
#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ods/layers/layered_scene.h"
#include "ods/layers/pieces.h"

namespace ods {

// Collects the vertices of one texture's mesh.
class MeshBuilder {
 public:
  explicit MeshBuilder(LayerMesh& mesh) : mesh_(mesh) {}

  // key: of the vertex among those of the mesh.
  uint vertex(uint64_t key, vec3 position, vec2 uv) {
    const auto [found, is_new] = index_.try_emplace(key, static_cast<uint>(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.push_back(position);
      mesh_.uvs.push_back(uv);
    }
    return found->second;
  }
  void triangle(uvec3 corners) { mesh_.triangles.push_back(corners); }

 private:
  LayerMesh& mesh_;
  std::unordered_map<uint64_t, uint> index_;
};

// The texture of each page, counted up from `count`; -1 for pages that no piece of the state kPage is in.
std::vector<int> textures_of_pages(const PageGrid& grid, const std::vector<PieceMesh>& meshes, int& count);

// Adds the pieces of the state kPage to the scene's meshes. texture_of: by page, the index of its mesh. Precondition:
// the scene has these meshes.
void add_page_meshes(const PageGrid& grid, const std::vector<PieceMesh>& meshes, const std::vector<int>& texture_of,
                     LayeredScene& scene);

}  // namespace ods
