// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/sky_mesh.h"

#include <algorithm>

#include "ods/layers/light/display.h"
#include "ods/layers/light/sky.h"
#include "ods/layers/page_grid.h"

namespace ods {

namespace {

constexpr int kMaxCells = 32;  // of a face's side: affine within half a texel of 2048
constexpr int kColumns = 3;    // of faces in a texture that has all six

// The grid of one face, with its gutters; as sharp as the picture of the background.
PageGrid sky_grid(const Scene& scene, int largest) {
  const Environment& background = scene.background ? *scene.background : scene.environment;
  return {std::clamp(background.width / 4, 4, largest - 2 * PageGrid::kGutter) + 2 * PageGrid::kGutter, 1};
}

// Adds a face to a mesh; corner: of its texels in the texture.
void add_face(const PageGrid& grid, int face, vec2 corner, vec2 texture, LayerMesh& mesh) {
  const int cells = std::clamp(grid.inner() / 32, 2, kMaxCells);
  const uint first = static_cast<uint>(mesh.positions.size()), row = static_cast<uint>(cells) + 1;
  for (int y = 0; y <= cells; y++) {
    for (int x = 0; x <= cells; x++) {
      const vec2 inner = vec2(x, y) / static_cast<float>(cells) * static_cast<float>(grid.inner());
      const vec2 texel = inner + static_cast<float>(PageGrid::kGutter);
      mesh.positions.push_back(from_page(grid, face, texel));
      mesh.uvs.push_back((corner + texel) / texture);
    }
  }
  for (uint y = 0; y + 1 < row; y++) {
    for (uint x = 0; x + 1 < row; x++) {
      const uint at = first + y * row + x;
      mesh.triangles.emplace_back(at, at + row, at + 1);
      mesh.triangles.emplace_back(at + 1, at + row, at + row + 1);
    }
  }
}

// Adds the rays of a face's texels to a table.
void add_rays(const PageGrid& grid, int face, int left, int top, TexelRays& rays) {
  for (int y = 0; y < grid.size(); y++) {
    for (int x = 0; x < grid.size(); x++) {
      const vec2 at = vec2(x, y) + 0.5f;
      const size_t row = static_cast<size_t>(top + y) * static_cast<size_t>(rays.width);
      TexelRay& ray = rays.rays[row + static_cast<size_t>(left + x)];
      ray.direction = grid.texel_ray(face, x, y);
      ray.across = from_page(grid, face, at + vec2(0.5f, 0.0f)) - from_page(grid, face, at - vec2(0.5f, 0.0f));
      ray.down = from_page(grid, face, at + vec2(0.0f, 0.5f)) - from_page(grid, face, at - vec2(0.0f, 0.5f));
    }
  }
}

}  // namespace

std::vector<LayerMesh> make_sky(const Scene& scene, int largest, float exposure, ToneCurve tone) {
  const PageGrid grid = sky_grid(scene, largest);
  const bool together = kColumns * grid.size() <= largest;
  const int columns = together ? kColumns : 1, rows = together ? kFaces / kColumns : 1;
  std::vector<LayerMesh> sky;
  for (int first = 0; first < kFaces; first += columns * rows) {
    LayerMesh& mesh = sky.emplace_back();
    mesh.kind = LayerKind::kSky;
    mesh.noun = "sky";
    TexelRays rays;
    rays.width = columns * grid.size();
    rays.height = rows * grid.size();
    rays.rays.resize(static_cast<size_t>(rays.width) * static_cast<size_t>(rays.height));
    for (int i = 0; i < columns * rows; i++) {
      const int left = i % columns * grid.size(), top = i / columns * grid.size();
      add_rays(grid, first + i, left, top, rays);
      add_face(grid, first + i, {left, top}, {rays.width, rays.height}, mesh);
    }
    mesh.texture = displayed(sky_of(scene, rays), exposure, tone);
  }
  return sky;
}

}  // namespace ods
