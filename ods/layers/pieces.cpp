// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/pieces.h"

#include <algorithm>

namespace ods {

namespace {

constexpr float kOnPlane = 1e-5f;     // a corner on a plane, as a fraction of its distance
constexpr float kAffineError = 1.0f;  // texels
constexpr float kShortEdge = 2.0f;    // texels: not divided

vec3 center_of(const PieceMesh& mesh, const Piece& piece) {
  return (mesh.positions[piece.corners.x] + mesh.positions[piece.corners.y] + mesh.positions[piece.corners.z]) / 3.0f;
}

// The two triangles of a quadrilateral, by its shorter diagonal.
void add_quad(const PieceMesh& mesh, Piece part, uint a, uint b, uint c, uint d, std::vector<Piece>& to) {
  const auto length_of = [&](uint from, uint end) { return length(mesh.positions[from] - mesh.positions[end]); };
  const bool first = length_of(a, c) <= length_of(b, d);
  part.corners = first ? uvec3(a, b, c) : uvec3(b, c, d);
  to.push_back(part);
  part.corners = first ? uvec3(a, c, d) : uvec3(b, d, a);
  to.push_back(part);
}

// The parts of a piece on both sides of a plane. middles: the dividing vertex of each edge, from corner i to corner i + 1;
// ~0 if it is whole. One or two edges are divided.
void add_sides(const PieceMesh& mesh, Piece piece, const uint (&middles)[3], std::vector<Piece>& to) {
  // Turned so that the divided edges come first; of two, they meet at corner b.
  int start = 0;
  for (int i = 0; i < 3; i++) {
    const bool next = middles[(i + 1) % 3] != ~0u, alone = !next && middles[(i + 2) % 3] == ~0u;
    if (middles[i] != ~0u && (next || alone)) start = i;
  }
  const uint a = piece.corners[start], b = piece.corners[(start + 1) % 3], c = piece.corners[(start + 2) % 3];
  const uint ab = middles[start], bc = middles[(start + 1) % 3];
  const auto add = [&](uvec3 corners) {
    piece.corners = corners;
    to.push_back(piece);
  };
  if (bc == ~0u) {
    add({a, ab, c});
    add({ab, b, c});
  } else {
    add({ab, b, bc});
    add_quad(mesh, piece, a, ab, bc, c, to);
  }
}

// The parts of a piece whose longest edge is divided, and others perhaps: the longest is divided first, so parts are
// hardly thinner than the piece.
void add_halves(const PieceMesh& mesh, Piece piece, const uint (&middles)[3], std::vector<Piece>& to) {
  const int start = longest_edge(mesh, piece);
  const uint a = piece.corners[start], b = piece.corners[(start + 1) % 3], c = piece.corners[(start + 2) % 3];
  const uint ab = middles[start], bc = middles[(start + 1) % 3], ca = middles[(start + 2) % 3];
  const auto add = [&](uvec3 corners) {
    piece.corners = corners;
    to.push_back(piece);
  };
  if (bc == ~0u) {
    add({ab, b, c});
  } else {
    add({ab, b, bc});
    add({ab, bc, c});
  }
  if (ca == ~0u) {
    add({a, ab, c});
  } else {
    add({a, ab, ca});
    add({ca, ab, c});
  }
}

// Replaces the pieces that have divided edges by their parts.
template <typename AddParts>
void replace(PieceMesh& mesh, const EdgeCuts& cuts, const AddParts& add_parts) {
  std::vector<Piece> parts;
  parts.reserve(mesh.pieces.size() + 2 * cuts.size());
  for (const Piece& piece : mesh.pieces) {
    uint middles[3];
    for (int i = 0; i < 3; i++) {
      const auto found = cuts.find(edge_key(piece.corners[i], piece.corners[(i + 1) % 3]));
      middles[i] = found == cuts.end() ? ~0u : found->second;
    }
    if ((middles[0] & middles[1] & middles[2]) == ~0u) {
      parts.push_back(piece);
    } else {
      add_parts(mesh, piece, middles, parts);
    }
  }
  mesh.pieces = std::move(parts);
}

// Divides the pieces that a plane through the middle crosses.
void cut_by(PieceMesh& mesh, const PagePlane& plane) {
  std::vector<signed char> signs;
  for (const vec3& position : mesh.positions) {
    const float height = dot(plane.normal, position), near = kOnPlane * length(position);
    signs.push_back(height > near ? 1 : height < -near ? -1 : 0);
  }
  EdgeCuts cuts;
  for (size_t i = 0; i < mesh.pieces.size(); i++) {
    const Piece piece = mesh.pieces[i];
    if (plane.face >= 0 && face_of(center_of(mesh, piece)) != plane.face) continue;
    for (int corner = 0; corner < 3; corner++) {
      const uint a = std::min(piece.corners[corner], piece.corners[(corner + 1) % 3]);
      const uint b = std::max(piece.corners[corner], piece.corners[(corner + 1) % 3]);
      if (signs[a] * signs[b] >= 0) continue;
      const float from = dot(plane.normal, mesh.positions[a]), to = dot(plane.normal, mesh.positions[b]);
      mark_edge(mesh, cuts, a, b, from / (from - to));
    }
  }
  if (!cuts.empty()) replace(mesh, cuts, add_sides);
}

}  // namespace

void mark_edge(PieceMesh& mesh, EdgeCuts& cuts, uint a, uint b, float at) {
  const auto [found, is_new] = cuts.try_emplace(edge_key(a, b), static_cast<uint>(mesh.positions.size()));
  if (is_new) mesh.positions.push_back(mix(mesh.positions[std::min(a, b)], mesh.positions[std::max(a, b)], at));
}

// Source: Rivara, "Algorithms for refining triangular grids suitable for adaptive and multigrid techniques", 1984.
void divide(PieceMesh& mesh, EdgeCuts cuts) {
  for (size_t before = 0; before != cuts.size();) {
    before = cuts.size();
    for (const Piece& piece : mesh.pieces) {
      const auto is_cut = [&](int i) { return cuts.contains(edge_key(piece.corners[i], piece.corners[(i + 1) % 3])); };
      if (!is_cut(0) && !is_cut(1) && !is_cut(2)) continue;
      const int longest = longest_edge(mesh, piece);
      mark_edge(mesh, cuts, piece.corners[longest], piece.corners[(longest + 1) % 3]);
    }
  }
  replace(mesh, cuts, add_halves);
}

vec3 normal_of(vec3 a, vec3 b, vec3 c) {
  const vec3 across = cross(b - a, c - a);
  const float size = length(across);
  return size > 0.0f ? across / size : -normalize(a);
}

int longest_edge(const PieceMesh& mesh, const Piece& piece) {
  int longest = 0;
  float most = -1.0f;
  for (int i = 0; i < 3; i++) {
    const float size = length(mesh.positions[piece.corners[i]] - mesh.positions[piece.corners[(i + 1) % 3]]);
    if (size > most) most = size, longest = i;
  }
  return longest;
}

int bent_edges(const PieceMesh& mesh, const PageGrid& grid, const Piece& piece) {
  vec2 at[3];
  for (int i = 0; i < 3; i++) at[i] = to_page(grid, piece.page, mesh.positions[piece.corners[i]]);
  int bent = 0;
  for (int i = 0; i < 3; i++) {
    const int next = (i + 1) % 3;
    if (length(at[next] - at[i]) < kShortEdge) continue;
    const vec3 middle = 0.5f * (mesh.positions[piece.corners[i]] + mesh.positions[piece.corners[next]]);
    if (length(to_page(grid, piece.page, middle) - 0.5f * (at[i] + at[next])) > kAffineError) bent |= 1 << i;
  }
  return bent;
}

PieceMesh cut_to_pages(SeenSurface surface, const PageGrid& grid) {
  PieceMesh mesh{surface.side, surface.masked, surface.error, std::move(surface.positions), {}};
  for (const uvec3& triangle : surface.triangles) mesh.pieces.push_back({triangle});
  for (int i = 0; i < page_plane_count(grid); i++) cut_by(mesh, page_plane(grid, i));
  for (Piece& piece : mesh.pieces) piece.page = place_in_pages(grid, center_of(mesh, piece)).page;
  return mesh;
}

}  // namespace ods
