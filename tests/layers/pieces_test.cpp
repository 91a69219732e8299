// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/pieces.h"

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <random>
#include <utility>

namespace ods::pieces_test {

double area_of(const std::vector<vec3>& positions, uvec3 corners) {
  const glm::dvec3 a = positions[corners.x], b = positions[corners.y], c = positions[corners.z];
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double area_of(const PieceMesh& mesh) {
  double sum = 0.0;
  for (const Piece& piece : mesh.pieces) sum += area_of(mesh.positions, piece.corners);
  return sum;
}

// A closed box around the middle, whose faces are large triangles.
SeenSurface box_around() {
  SeenSurface surface;
  for (int i = 0; i < 8; i++)
    surface.positions.emplace_back(i & 1 ? 3.0f : -2.0f, i & 2 ? 1.5f : -1.0f, i & 4 ? 2.0f : -5.0f);
  surface.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 2, 6}, {0, 6, 4},
                       {1, 5, 7}, {1, 7, 3}, {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6}};
  return surface;
}

// Every edge of a closed surface belongs to two pieces, in opposite directions: no corner lies within an edge.
void expect_closed(const PieceMesh& mesh) {
  std::map<std::pair<uint, uint>, int> edges;
  for (const Piece& piece : mesh.pieces) {
    for (int i = 0; i < 3; i++) edges[{piece.corners[i], piece.corners[(i + 1) % 3]}]++;
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(Pieces, LieInOnePageEach) {
  const PageGrid grid = page_grid(1024);
  const SeenSurface box = box_around();
  double whole = 0.0;
  for (const uvec3& triangle : box.triangles) whole += area_of(box.positions, triangle);
  const PieceMesh mesh = cut_to_pages(box, grid);
  EXPECT_GT(mesh.pieces.size(), box.triangles.size());
  EXPECT_NEAR(area_of(mesh), whole, 1e-4 * whole);
  expect_closed(mesh);
  for (const Piece& piece : mesh.pieces) {
    for (int i = 0; i < 3; i++) {
      const vec2 at = to_page(grid, piece.page, mesh.positions[piece.corners[i]]);
      EXPECT_GE(std::min(at.x, at.y), static_cast<float>(PageGrid::kGutter) - 0.01f);
      EXPECT_LE(std::max(at.x, at.y), static_cast<float>(grid.size() - PageGrid::kGutter) + 0.01f);
    }
  }
}

// Texture coordinates that are interpolated on a piece without bent edges are those of the panorama within a texel or
// little more.
TEST(Pieces, AreAffineWithoutBentEdges) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> any(0.0f, 1.0f);
  for (const int width : {1024, 10000}) {
    const PageGrid grid = page_grid(width);
    PieceMesh mesh = cut_to_pages(box_around(), grid);
    for (EdgeCuts cuts; true; divide(mesh, std::exchange(cuts, {}))) {
      for (const Piece& piece : std::vector(mesh.pieces)) {
        const int bent = bent_edges(mesh, grid, piece);
        for (int i = 0; i < 3; i++) {
          if (bent >> i & 1) mark_edge(mesh, cuts, piece.corners[i], piece.corners[(i + 1) % 3]);
        }
      }
      if (cuts.empty()) break;
    }
    expect_closed(mesh);
    for (const Piece& piece : mesh.pieces) {
      vec3 corners[3];
      vec2 at[3];
      for (int i = 0; i < 3; i++) {
        corners[i] = mesh.positions[piece.corners[i]];
        at[i] = to_page(grid, piece.page, corners[i]);
      }
      for (int k = 0; k < 8; k++) {
        float u = any(random), v = any(random);
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        const vec3 point = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
        const vec2 mapped = at[0] + u * (at[1] - at[0]) + v * (at[2] - at[0]);
        EXPECT_LT(length(mapped - to_page(grid, piece.page, point)), 2.5f);
      }
    }
  }
}

// The longest edge of each divided piece is divided, too: here, the one that both share.
TEST(Pieces, DivideAllAlongAMarkedEdge) {
  PieceMesh mesh;
  mesh.positions = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {1, 1, -1}};
  mesh.pieces = {{{0, 1, 2}, 0, PieceState::kPage}, {{1, 3, 2}, 0, PieceState::kChart}};
  for (const float at : {0.5f, 0.25f}) {
    for (int marks = 1; marks < 8; marks++) {
      PieceMesh cut = mesh;
      EdgeCuts cuts;
      const std::pair<uint, uint> edges[] = {{1, 2}, {0, 1}, {2, 0}};
      for (int i = 0; i < 3; i++) {
        if (marks >> i & 1) mark_edge(cut, cuts, edges[i].first, edges[i].second, at);
      }
      divide(cut, cuts);
      EXPECT_NEAR(area_of(cut), 1.0, 1e-6);
      size_t pages = 0;
      for (const Piece& piece : cut.pieces) {
        EXPECT_GT(area_of(cut.positions, piece.corners), 0.0);
        pages += piece.state == PieceState::kPage ? 1 : 0;
      }
      EXPECT_EQ(pages, 1u + static_cast<size_t>(std::popcount(static_cast<unsigned>(marks | 1))));
      EXPECT_EQ(cut.pieces.size() - pages, 2u);
    }
  }
}

}  // namespace ods::pieces_test
