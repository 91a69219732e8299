// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/layer_views.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "ods/layers/as_scene.h"
#include "ods/layers/page_grid.h"

namespace ods {

namespace {

constexpr int kGrid = 96;           // texels of a face, with gutters
constexpr int kMaxBacks = 64;       // surfaces seen from behind that a ray passes
constexpr float kPastBack = 1e-4f;  // of the distance

// Evenly spread in the cube of -1/2 to 1/2. Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences",
// 2018: the powers of the root of x^4 = x + 1.
vec3 spread(int index) {
  constexpr double kRoot = 1.22074408460575947536;
  vec3 place;
  for (int axis = 0; axis < 3; axis++) {
    const double at = 0.5 + (index + 1) / std::pow(kRoot, axis + 1);
    place[axis] = static_cast<float>(at - std::floor(at) - 0.5);
  }
  return place;
}

bool is_surface_of_scene(const LayerMesh& mesh) {
  return mesh.kind != LayerKind::kSky && mesh.kind != LayerKind::kBlended && !mesh.triangles.empty();
}

std::vector<int> surfaces_of(const LayeredScene& layers) {
  std::vector<int> meshes;
  for (size_t i = 0; i < layers.meshes.size(); i++) {
    if (is_surface_of_scene(layers.meshes[i])) meshes.push_back(static_cast<int>(i));
  }
  return meshes;
}

// The surfaces without their textures.
LayeredScene without_textures(const LayeredScene& layers) {
  LayeredScene surfaces;
  surfaces.box = layers.box;
  for (const LayerMesh& mesh : layers.meshes) {
    if (!is_surface_of_scene(mesh)) continue;
    surfaces.meshes.push_back({LayerKind::kOpaque, mesh.noun, mesh.positions, mesh.uvs, mesh.triangles, {}});
  }
  return surfaces;
}

// Continues a ray past the backs that it meets, until it meets a front or leaves the scene.
FirstHit first_front(const FirstHits& hits, vec3 from, vec3 direction, FirstHit seen) {
  for (int passed = 0; passed < kMaxBacks && seen.instance >= 0 && !seen.front; passed++) {
    from += direction * (seen.distance * (1.0f + kPastBack) + kPastBack);
    hits.look(from, &direction, 1, &seen);
  }
  return seen;
}

}  // namespace

LayerViews::LayerViews(const LayeredScene& layers)
    : box_(layers.box),
      mesh_of_(surfaces_of(layers)),
      surfaces_(as_scene(without_textures(layers))),
      hits_(surfaces_) {}

LayerViews::View LayerViews::from_eye(int eye) const {
  const PageGrid grid(kGrid, 1);
  View view;
  view.place = box_.center + spread(eye) * box_.size;
  view.directions.resize(static_cast<size_t>(grid.pages() * kGrid * kGrid));
  view.meshes.resize(view.directions.size());
  tbb::parallel_for(0, grid.pages() * kGrid, [&](int row) {
    const size_t first = static_cast<size_t>(row) * kGrid;
    FirstHit seen[kGrid];
    for (int x = 0; x < kGrid; x++) {
      view.directions[first + static_cast<size_t>(x)] = grid.texel_ray(row / kGrid, x, row % kGrid);
    }
    hits_.look(view.place, &view.directions[first], kGrid, seen);
    for (size_t x = 0; x < kGrid; x++) {
      const FirstHit front = first_front(hits_, view.place, view.directions[first + x], seen[x]);
      view.meshes[first + x] = front.instance >= 0 && front.front ? mesh_of_[static_cast<size_t>(front.instance)] : -1;
    }
  });
  return view;
}

}  // namespace ods
