// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/depth_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>

#include "ods/layers/simplify.h"

namespace ods {

namespace {

constexpr float kPixelsMoved = 0.5f;

// A corner of texels on the cube, whose faces have `across` texels along each side: the same for all faces that meet
// there. Of a corner's up to four surfaces, `first` is the first texel of one.
struct CornerKey {
  uint64_t corner = 0;
  size_t first = 0;
  bool operator==(const CornerKey&) const = default;
};

struct CornerHash {
  size_t operator()(const CornerKey& key) const {
    return (key.corner * 0x9e3779b97f4a7c15u) ^ (key.first * 0xff51afd7ed558ccdu);
  }
};

struct DepthVertex {
  vec3 direction{0.0f};
  float nearness = 0.0f;
};

// A mesh whose vertices are those of corners.
struct CornerMesh {
  std::vector<CornerKey> keys;
  std::vector<DepthVertex> vertices;
  std::vector<uvec3> triangles;
};

// Texels around a corner of a page, clockwise from the upper left one; ~0 if there is no more.
using Around = std::array<size_t, 4>;

// Makes the quadrilaterals of a panorama's texels.
class Mesher {
 public:
  Mesher(const DepthPanorama& panorama, float reach) : panorama_(panorama), grid_(panorama.grid), reach_(reach) {}

  CornerMesh page(int page) const;

 private:
  bool is_border(int i, int j) const { return i == 0 || j == 0 || i == grid_.inner() || j == grid_.inner(); }
  uint64_t corner_key(int page, int i, int j) const;
  Around around(int page, int i, int j) const;
  bool joined_at_border(size_t a, size_t b) const;
  bool joined(const Around& texels, size_t from) const;
  std::array<size_t, 4> surfaces_of(const Around& texels, bool at_border) const;
  uint vertex(int page, int i, int j, size_t texel, std::unordered_map<CornerKey, uint, CornerHash>& index,
              CornerMesh& mesh) const;

  const DepthPanorama& panorama_;
  const PageGrid& grid_;
  float reach_;
};

// The direction, rounded to a part of the smallest angle between corners: on a border, all pages compute it alike but
// for rounding.
uint64_t Mesher::corner_key(int page, int i, int j) const {
  if (!is_border(i, j)) {
    const uint64_t side = static_cast<uint64_t>(grid_.inner()) + 1;
    return (static_cast<uint64_t>(page) * side + static_cast<uint64_t>(j)) * side + static_cast<uint64_t>(i);
  }
  const vec3 direction = from_page(grid_, page, vec2(i, j) + static_cast<float>(PageGrid::kGutter));
  const float largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  uint64_t key = 1;
  for (int axis = 0; axis < 3; axis++) {
    // Even steps of angle on the cube, whose borders and corners are whole numbers.
    const float angle = std::atan(direction[axis] / largest) * 4.0f / 3.14159265f;
    const float steps = 0.5f * (angle + 1.0f) * static_cast<float>(grid_.inner() * grid_.across());
    key = key << 20 | static_cast<uint64_t>(std::lrint(steps));
  }
  return key << 1 | uint64_t{1} << 63;
}

Around Mesher::around(int page, int i, int j) const {
  // Far from the corner, a page's rows do not continue exactly as its neighbour's.
  constexpr float kNear = 0.1f;
  const vec2 corner = vec2(i, j) + static_cast<float>(PageGrid::kGutter);
  Around texels{
      inner_texel(grid_, page, corner + vec2(-kNear, -kNear)), inner_texel(grid_, page, corner + vec2(kNear, -kNear)),
      inner_texel(grid_, page, corner + vec2(kNear, kNear)), inner_texel(grid_, page, corner + vec2(-kNear, kNear))};
  if (!is_border(i, j)) return texels;
  // A corner of the cube has three texels, and the order of a border's is the same for all pages.
  std::ranges::sort(texels);
  const auto end = std::unique(texels.begin(), texels.end());
  std::fill(end, texels.end(), ~size_t{0});
  return texels;
}

// Returns whether two texels at a page's border are one surface: pages see different ones beyond them, so only these
// two count.
bool Mesher::joined_at_border(size_t a, size_t b) const {
  const float from = panorama_.nearness[a], to = panorama_.nearness[b];
  return shows_one_surface(from, to, reach_, grid_.pixel()) || is_one_surface(from, to);
}

// Returns whether the texel at an index around a corner of a page and the next one are one surface.
bool Mesher::joined(const Around& texels, size_t from) const {
  const size_t a = texels[from], b = texels[(from + 1) % 4];
  // Steps from a to b: right, down, left, up.
  const ptrdiff_t row = grid_.size();
  const ptrdiff_t steps[] = {1, row, -1, -row};
  const size_t step = static_cast<size_t>(steps[from]);
  const std::vector<float>& nearness = panorama_.nearness;
  return continues(nearness[a - step], nearness[a], nearness[b], nearness[b + step], reach_, grid_.pixel());
}

// The surface of each texel around a corner, by the index of its first texel there.
std::array<size_t, 4> Mesher::surfaces_of(const Around& texels, bool at_border) const {
  std::array<size_t, 4> surface{0, 1, 2, 3};
  const auto join = [&](size_t a, size_t b) {
    std::ranges::replace(surface, std::max(surface[a], surface[b]), std::min(surface[a], surface[b]));
  };
  for (size_t a = 0; a < 4; a++) {
    if (!at_border && joined(texels, a)) join(a, (a + 1) % 4);
    for (size_t b = a + 1; at_border && b < 4 && texels[b] != ~size_t{0}; b++) {
      if (joined_at_border(texels[a], texels[b])) join(a, b);
    }
  }
  return surface;
}

uint Mesher::vertex(int page, int i, int j, size_t texel, std::unordered_map<CornerKey, uint, CornerHash>& index,
                    CornerMesh& mesh) const {
  const Around texels = around(page, i, j);
  const std::array<size_t, 4> surface = surfaces_of(texels, is_border(i, j));
  const auto own = static_cast<size_t>(std::ranges::find(texels, texel) - texels.begin());
  const CornerKey key{corner_key(page, i, j), texels[surface[own]]};
  const auto [found, is_new] = index.try_emplace(key, static_cast<uint>(mesh.vertices.size()));
  if (!is_new) return found->second;
  float sum = 0.0f, count = 0.0f;
  for (size_t k = 0; k < 4; k++) {
    if (surface[k] != surface[own] || texels[k] == ~size_t{0}) continue;
    sum += panorama_.nearness[texels[k]];
    count += 1.0f;
  }
  mesh.keys.push_back(key);
  mesh.vertices.push_back({from_page(grid_, page, vec2(i, j) + static_cast<float>(PageGrid::kGutter)), sum / count});
  return found->second;
}

CornerMesh Mesher::page(int page) const {
  CornerMesh mesh;
  std::unordered_map<CornerKey, uint, CornerHash> index;
  for (int j = 0; j < grid_.inner(); j++) {
    for (int i = 0; i < grid_.inner(); i++) {
      const size_t texel = index_of(grid_, {page, i + PageGrid::kGutter, j + PageGrid::kGutter});
      if (!(panorama_.nearness[texel] > 0.0f)) continue;
      const uint a = vertex(page, i, j, texel, index, mesh), b = vertex(page, i, j + 1, texel, index, mesh),
                 c = vertex(page, i + 1, j + 1, texel, index, mesh), d = vertex(page, i + 1, j, texel, index, mesh);
      mesh.triangles.emplace_back(a, b, d);
      mesh.triangles.emplace_back(d, b, c);
    }
  }
  return mesh;
}

// Leaves out triangles without moving any point by more than `error`, in the space of the header.
void simplify(CornerMesh& mesh, float reach, float error, Borders borders) {
  std::vector<vec3> points;
  for (const DepthVertex& vertex : mesh.vertices) points.push_back(vertex.direction * (1.0f + reach * vertex.nearness));
  CornerMesh used;
  used.triangles = simplified(points, mesh.triangles, error, borders);
  for (const uint old : leave_out_unused(points, used.triangles)) {
    used.keys.push_back(mesh.keys[old]);
    used.vertices.push_back(mesh.vertices[old]);
  }
  mesh = std::move(used);
}

// One mesh of all pages' meshes, whose vertices at borders are shared.
CornerMesh weld(std::span<const CornerMesh> pages) {
  CornerMesh whole;
  std::unordered_map<CornerKey, uint, CornerHash> index;
  for (const CornerMesh& page : pages) {
    std::vector<uint> place;
    for (size_t i = 0; i < page.keys.size(); i++) {
      const auto [found, is_new] = index.try_emplace(page.keys[i], static_cast<uint>(whole.vertices.size()));
      if (is_new) {
        whole.keys.push_back(page.keys[i]);
        whole.vertices.push_back(page.vertices[i]);
      }
      place.push_back(found->second);
    }
    for (const uvec3& triangle : page.triangles) {
      whole.triangles.emplace_back(place[triangle.x], place[triangle.y], place[triangle.z]);
    }
  }
  return whole;
}

}  // namespace

SeenSurface depth_surface(const DepthPanorama& panorama, float reach) {
  const Mesher mesher(panorama, reach);
  const float error = kPixelsMoved * panorama.grid.pixel();
  std::vector<CornerMesh> pages(static_cast<size_t>(panorama.grid.pages()));
  tbb::parallel_for(size_t{0}, pages.size(), [&](size_t page) {
    pages[page] = mesher.page(static_cast<int>(page));
    simplify(pages[page], reach, 0.5f * error, Borders::kStay);
  });
  CornerMesh whole = weld(pages);
  simplify(whole, reach, error, Borders::kMove);
  SeenSurface surface;
  for (const DepthVertex& vertex : whole.vertices) surface.positions.push_back(vertex.direction / vertex.nearness);
  surface.triangles = std::move(whole.triangles);
  return surface;
}

}  // namespace ods
