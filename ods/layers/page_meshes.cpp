// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/page_meshes.h"

namespace ods {

std::vector<int> textures_of_pages(const PageGrid& grid, const std::vector<PieceMesh>& meshes, int& count) {
  std::vector<int> texture_of(static_cast<size_t>(grid.pages()), -1);
  for (const PieceMesh& mesh : meshes) {
    for (const Piece& piece : mesh.pieces) {
      if (piece.state == PieceState::kPage) texture_of[static_cast<size_t>(piece.page)] = 0;
    }
  }
  for (int& texture : texture_of) texture = texture < 0 ? -1 : count++;
  return texture_of;
}

void add_page_meshes(const PageGrid& grid, const std::vector<PieceMesh>& meshes, const std::vector<int>& texture_of,
                     LayeredScene& scene) {
  std::vector<MeshBuilder> builders;
  for (LayerMesh& mesh : scene.meshes) builders.emplace_back(mesh);
  for (size_t m = 0; m < meshes.size(); m++) {
    for (const Piece& piece : meshes[m].pieces) {
      if (piece.state != PieceState::kPage) continue;
      MeshBuilder& builder = builders[static_cast<size_t>(texture_of[static_cast<size_t>(piece.page)])];
      uvec3 corners;
      for (int i = 0; i < 3; i++) {
        const vec3 position = meshes[m].positions[piece.corners[i]];
        const vec2 uv = to_page(grid, piece.page, position) / static_cast<float>(grid.size());
        corners[i] = builder.vertex(uint64_t{m} << 32 | piece.corners[i], position + scene.box.center, uv);
      }
      builder.triangle(corners);
    }
  }
}

}  // namespace ods
