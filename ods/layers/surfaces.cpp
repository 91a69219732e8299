// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/surfaces.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "ods/layers/simplify.h"

namespace ods {

namespace {

constexpr float kPixelsMoved = 0.5f;  // pixels by which simplified surfaces may move

bool has_alpha(const Material& material) {
  return material.alpha_mode != kAlphaOpaque;
}

// Adds the triangles that share a corner with one that is kept.
void add_ring(const std::vector<uvec3>& triangles, size_t corners, std::vector<char>& kept) {
  std::vector<char> touched(corners);
  for (size_t i = 0; i < triangles.size(); i++) {
    if (!kept[i]) continue;
    for (int corner = 0; corner < 3; corner++) touched[triangles[i][corner]] = 1;
  }
  for (size_t i = 0; i < triangles.size(); i++) {
    if (touched[triangles[i].x] || touched[triangles[i].y] || touched[triangles[i].z]) kept[i] = 1;
  }
}

// Leaves out the mirrors of an instance, which show another world in their place.
void leave_out_mirrors(const Probe& probe, int instance, std::vector<char>& kept) {
  for (const FlatMirror& mirror : probe.mirrors) {
    if (mirror.instance != instance) continue;
    for (const uint triangle : mirror.triangles) kept[triangle] = 0;
  }
}

// One side of an instance: its triangles that the probe saw, and their neighbours.
SeenSurface collect(const Scene& scene, const Probe& probe, int side) {
  const size_t at = static_cast<size_t>(side / 2);
  const FlatMirror* const mirror = mirror_of(probe, side);
  const Instance& instance = scene.instances[static_cast<size_t>(probe.numbers.real(side / 2))];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  SeenSurface surface;
  surface.side = side;
  surface.masked = has_alpha(scene.materials[static_cast<size_t>(mesh.material)]);
  std::vector<vec3> local;
  for (uint i = 0; i < mesh.vertex_count; i++) local.push_back(scene.vertices[mesh.first_vertex + i].position);
  const std::vector<uint> welded = first_equal(local);
  surface.positions.resize(local.size());
  for (size_t i = 0; i < local.size(); i++) {
    const vec3 world = to_world(instance, local[i]);
    surface.positions[welded[i]] = (mirror ? reflected_point(*mirror, world) : world) - probe.box.center;
  }

  const uint8_t wanted = side % 2 == 0 ? kFrontSeen : kBackSeen;
  const bool flips = ((handedness_of(instance) < 0.0f) != (side % 2 == 1)) != (mirror != nullptr);
  std::vector<char> kept;
  for (uint i = 0; i < mesh.triangle_count; i++) {
    const uvec3 own = scene.triangles[mesh.first_triangle + i];
    uvec3 triangle(welded[own.x], welded[own.y], welded[own.z]);
    if (flips) std::swap(triangle.y, triangle.z);
    surface.triangles.push_back(triangle);
    kept.push_back((probe.sides[probe.first_triangle[at] + i] & wanted) != 0);
  }
  add_ring(surface.triangles, surface.positions.size(), kept);
  if (!mirror) leave_out_mirrors(probe, side / 2, kept);
  size_t count = 0;
  for (size_t i = 0; i < kept.size(); i++) {
    const uvec3 triangle = surface.triangles[i];
    const bool flat = triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x;
    if (kept[i] && !flat) surface.triangles[count++] = triangle;
  }
  surface.triangles.resize(count);
  if (mirror) keep_behind(*mirror, probe.box.center, surface.positions, surface.triangles);
  leave_out_unused(surface.positions, surface.triangles);
  return surface;
}

// The sky in a mirror: a sphere far away, of which only parts are seen.
SeenSurface mirrored_sky(const Probe& probe, int side) {
  constexpr int kCells = 16;  // of a face's side
  const PageGrid grid(kCells + 2 * PageGrid::kGutter, 1);
  SeenSurface surface;
  surface.side = side;
  surface.error = 0.002f * probe.mirrored_sky;  // between the sphere and its triangles
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  for (int face = 0; face < kFaces; face++) {
    const uint first = static_cast<uint>(positions.size()), row = kCells + 1;
    for (uint i = 0; i < row * row; i++) {
      const vec2 at = vec2(i % row, i / row) + static_cast<float>(PageGrid::kGutter);
      positions.push_back(probe.mirrored_sky * from_page(grid, face, at));
      if (i % row == kCells || i / row == kCells) continue;
      const uint corner = first + i;
      triangles.emplace_back(corner, corner + row, corner + 1);
      triangles.emplace_back(corner + 1, corner + row, corner + row + 1);
    }
  }
  surface.positions = std::move(positions);
  surface.triangles = std::move(triangles);
  return surface;
}

}  // namespace

std::vector<SeenSurface> seen_surfaces(const Scene& scene, const Probe& probe, float pixel) {
  std::vector<int> sides;
  for (size_t side = 0; side < probe.nearest.size(); side++) {
    if (probe.nearest[side] < kFarAway) sides.push_back(static_cast<int>(side));
  }
  std::vector<SeenSurface> surfaces(sides.size());
  tbb::parallel_for(size_t{0}, sides.size(), [&](size_t i) {
    if (probe.numbers.is_sky(sides[i] / 2)) {
      surfaces[i] = mirrored_sky(probe, sides[i]);
      return;
    }
    surfaces[i] = collect(scene, probe, sides[i]);
    surfaces[i].error = kPixelsMoved * pixel * probe.nearest[static_cast<size_t>(sides[i])];
    surfaces[i].triangles = simplified(surfaces[i].positions, surfaces[i].triangles, surfaces[i].error);
    leave_out_unused(surfaces[i].positions, surfaces[i].triangles);
  });
  return surfaces;
}

}  // namespace ods
