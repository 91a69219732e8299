// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as pieces that a texture can show: cut where pages meet, and divided until each has one texture. Neighbours
// remain neighbours: an edge is divided for both of its triangles at once, so
// no corner lies within another triangle's edge, where gaps would sparkle.
#pragma once
#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ods/layers/page_grid.h"
#include "ods/layers/surfaces.h"

namespace ods {

enum class PieceState : uint8_t {
  kUnknown,
  kPage,     // all of it is seen from the middle: its page shows it
  kChart,    // other places see it, or only a part is seen from the middle
  kDropped,  // not seen from the box
};

struct Piece {
  uvec3 corners;
  int page = 0;  // the page in which it lies
  PieceState state = PieceState::kUnknown;
};

struct PieceMesh {
  int side = 0;  // as in SeenSurface
  bool masked = false;
  float error = 0.0f;
  std::vector<vec3> positions;  // relative to the middle of the box
  std::vector<Piece> pieces;
  bool is_pane = false;
  int mirror = -1;               // of the probe's, in which it is seen
  const Probe* probe = nullptr;  // set if that has mirrors
};

// The same number for an edge in both directions.
inline uint64_t edge_key(uint a, uint b) {
  return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

// Edges to divide, and the vertex that divides each of them.
using EdgeCuts = std::unordered_map<uint64_t, uint>;

// Marks an edge to be divided at a point between its corners, 0..1 from the one with the smaller index. No effect if it
// is marked already.
void mark_edge(PieceMesh& mesh, EdgeCuts& cuts, uint a, uint b, float at = 0.5f);

// Divides all pieces at the marked edges, and first at their longest edges if those are not marked, so that parts do not
// become thin. Parts keep their piece's page and state.
void divide(PieceMesh& mesh, EdgeCuts cuts);

// The normal of a triangle, of unit length; towards the middle of the box if the triangle has no area.
vec3 normal_of(vec3 a, vec3 b, vec3 c);

// The longest edge of a piece: corner and next corner, 0 to 2.
int longest_edge(const PieceMesh& mesh, const Piece& piece);

// The edges of a piece that an affine map to its page would show more than a texel off: bit i is the edge from corner i
// to the next one.
int bent_edges(const PieceMesh& mesh, const PageGrid& grid, const Piece& piece);

// A surface cut into pieces, each of which lies in one page.
PieceMesh cut_to_pages(SeenSurface surface, const PageGrid& grid);

}  // namespace ods
