// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/holes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "ods/base/error.h"
#include "ods/layers/as_scene.h"

namespace ods {

namespace {

constexpr int kEyes = 32;
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

// Returns whether a ray that has met a layer, or none, meets the front of one.
bool meets_front(const FirstHits& layers, vec3 from, vec3 direction, FirstHit seen) {
  for (int passed = 0; passed < kMaxBacks && seen.instance >= 0 && !seen.front; passed++) {
    from += direction * (seen.distance * (1.0f + kPastBack) + kPastBack);
    layers.look(from, &direction, 1, &seen);
  }
  return seen.instance >= 0 && seen.front;
}

// The surfaces that hide what is behind them.
LayeredScene surfaces_of(const LayeredScene& layers) {
  LayeredScene surfaces;
  surfaces.box = layers.box;
  for (const LayerMesh& mesh : layers.meshes) {
    if (mesh.kind == LayerKind::kSky || mesh.kind == LayerKind::kBlended) continue;
    surfaces.meshes.push_back({mesh.kind, mesh.noun, mesh.positions, mesh.uvs, mesh.triangles, {}});
    surfaces.meshes.back().kind = LayerKind::kOpaque;
  }
  return surfaces;
}

// The share of the rays of a grid from a place.
double share_from(const FirstHits& hits, const FirstHits& layers, vec3 place, const PageGrid& grid) {
  std::atomic<size_t> missing = 0;
  tbb::parallel_for(0, grid.pages() * grid.size(), [&](int row) {
    const int width = grid.size();
    std::vector<vec3> directions;
    for (int x = 0; x < width; x++) directions.push_back(grid.texel_ray(row / width, x, row % width));
    std::vector<FirstHit> seen(directions.size()), layer(directions.size());
    hits.look(place, directions.data(), width, seen.data());
    layers.look(place, directions.data(), width, layer.data());
    for (size_t x = 0; x < seen.size(); x++) {
      if (seen[x].instance >= 0 && !meets_front(layers, place, directions[x], layer[x])) missing++;
    }
  });
  return static_cast<double>(missing) / (grid.pages() * grid.size() * grid.size());
}

}  // namespace

LayerHoles find_holes(const FirstHits& hits, const LayeredScene& layers, const Progress& progress) {
  const Scene surfaces = as_scene(surfaces_of(layers));
  const FirstHits of_layers(surfaces);
  const PageGrid grid(kGrid, 1);
  LayerHoles holes;
  double all = 0.0;
  for (int eye = 0; eye < kEyes; eye++) {
    const vec3 place = layers.box.center + spread(eye) * layers.box.size;
    const double share = share_from(hits, of_layers, place, grid);
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
    holes.worst = std::max(holes.worst, share);
    all += share;
    if (progress.report) progress.report(static_cast<double>(eye + 1) / kEyes);
  }
  holes.share = all / kEyes;
  return holes;
}

}  // namespace ods
