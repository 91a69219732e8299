// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/build_layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "ods/base/error.h"
#include "ods/layers/head_room.h"
#include "ods/layers/light_rays.h"
#include "ods/layers/page_meshes.h"
#include "ods/layers/rays/panes.h"
#include "ods/layers/rays/seen_mirrors.h"

namespace ods {

namespace {

constexpr double kShareOfProbe = 0.4;  // of the time

// Half the side of the largest cube around the middle without a surface in it. Nothing in such a cube is hidden from the
// middle, so its own map is enough.
float free_half(const Probe& probe) {
  const DistanceMap& map = probe.maps[kMiddle];
  const size_t size = static_cast<size_t>(map.grid.size());
  float half = kFarAway;
  for (size_t row = 0; row < map.distances.size() / size; row++) {
    for (size_t x = 0; x < size; x++) {
      const vec3 ray =
          abs(map.grid.texel_ray(static_cast<int>(row / size), static_cast<int>(x), static_cast<int>(row % size)));
      half = std::min(half, map.distances[row * size + x] * std::max({ray.x, ray.y, ray.z}));
    }
  }
  return half;
}

// The metres at which the sky in mirrors lies: behind all that they show.
float mirrored_sky_distance(const Scene& scene, vec3 middle) {
  float farthest = 1.0f;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    for (uint v = 0; v < mesh.vertex_count; v++) {
      const vec3 at = to_world(scene.instances[i], scene.vertices[mesh.first_vertex + v].position);
      farthest = std::max(farthest, length(at - middle));
    }
  }
  return 4.0f * farthest;
}

// The sides of panes as surfaces. Not simplified further than to half a pixel.
std::vector<SeenSurface> pane_surfaces(const Scene& scene, const std::vector<char>& panes, vec3 middle, float pixel) {
  std::vector<SeenSurface> surfaces;
  for (size_t i = 0; i < 2 * panes.size(); i++) {
    if (!panes[i / 2]) continue;
    PaneTriangles pane = pane_triangles(scene, static_cast<int>(i / 2), i % 2 == 1, middle);
    if (pane.triangles.empty()) continue;
    surfaces.push_back(
        {static_cast<int>(i), true, 0.5f * pixel * pane.nearest, std::move(pane.positions), std::move(pane.triangles)});
  }
  return surfaces;
}

std::vector<PieceMesh> make_pieces(const Scene& scene, const PanoramaPages& pages, const std::vector<char>& panes,
                                   float pixel, LayerCounts& counts, const Progress& progress) {
  const Probe& probe = pages.probe();
  std::vector<SeenSurface> surfaces = seen_surfaces(scene, probe, pixel);
  const size_t first_pane = surfaces.size();
  std::vector<SeenSurface> glass = pane_surfaces(scene, panes, probe.box.center, pixel);
  std::move(glass.begin(), glass.end(), std::back_inserter(surfaces));
  for (const SeenSurface& surface : surfaces) counts.simplified_triangles += surface.triangles.size();
  std::vector<PieceMesh> meshes(surfaces.size());
  tbb::parallel_for(size_t{0}, surfaces.size(), [&](size_t i) {
    if (progress.cancelled && progress.cancelled()) return;
    meshes[i] = cut_to_pages(std::move(surfaces[i]), pages.grid());
    meshes[i].is_pane = i >= first_pane;
    meshes[i].mirror = probe.numbers.mirror_of(meshes[i].side / 2);
    meshes[i].probe = &probe;
    decide_pieces(pages, meshes[i], pixel);
  });
  if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
  return meshes;
}

void add_chart_meshes(const std::vector<PieceMesh>& meshes, const std::vector<Chart>& charts, int size,
                      LayeredScene& scene) {
  for (size_t c = 0; c < charts.size(); c++) {
    const Chart& chart = charts[c];
    MeshBuilder builder(scene.meshes[static_cast<size_t>(chart.texture)]);
    for (const size_t piece : chart.pieces) {
      if (meshes[chart.mesh].pieces[piece].state == PieceState::kDropped) continue;
      uvec3 corners;
      for (int i = 0; i < 3; i++) {
        const uint corner = meshes[chart.mesh].pieces[piece].corners[i];
        const vec3 position = meshes[chart.mesh].positions[corner];
        corners[i] =
            builder.vertex(corner, position + scene.box.center, in_chart(chart, position) / static_cast<float>(size));
      }
      builder.triangle(corners);
    }
  }
}

LayerKind kind_of(const PieceMesh& mesh) {
  return mesh.is_pane ? LayerKind::kBlended : mesh.masked ? LayerKind::kMasked : LayerKind::kOpaque;
}

const char* noun_of(LayerKind kind) {
  return kind == LayerKind::kBlended ? "panes" : kind == LayerKind::kMasked ? "masked charts" : "charts";
}

// Puts the triangles of blended meshes in the order in which they are drawn: the farthest first.
void sort_blended(LayeredScene& scene) {
  for (LayerMesh& mesh : scene.meshes) {
    if (mesh.kind != LayerKind::kBlended) continue;
    const auto distance = [&](const uvec3& corners) {
      const vec3 sum = mesh.positions[corners.x] + mesh.positions[corners.y] + mesh.positions[corners.z];
      return length(sum / 3.0f - scene.box.center);
    };
    std::ranges::stable_sort(mesh.triangles, [&](const uvec3& a, const uvec3& b) { return distance(a) > distance(b); });
  }
}

// Packs charts of each kind in textures of their own.
void pack(const std::vector<PieceMesh>& meshes, std::vector<Chart>& charts, int size, LayeredScene& scene) {
  for (const LayerKind kind : {LayerKind::kOpaque, LayerKind::kMasked, LayerKind::kBlended}) {
    std::vector<Chart*> some;
    for (Chart& chart : charts) {
      if (kind_of(meshes[chart.mesh]) == kind) some.push_back(&chart);
    }
    const int first = static_cast<int>(scene.meshes.size());
    LayerMesh mesh;
    mesh.kind = kind;
    mesh.noun = noun_of(kind);
    scene.meshes.resize(scene.meshes.size() + static_cast<size_t>(pack_charts(std::move(some), size, first)), mesh);
  }
}

void count_sizes(const LayerGeometry& geometry, int page_count, LayerCounts& counts) {
  for (const LayerMesh& mesh : geometry.scene.meshes) counts.triangles += mesh.triangles.size();
  const size_t size = static_cast<size_t>(geometry.texture_size),
               in_pages = static_cast<size_t>(page_count) * size * size;
  for (size_t i = 0; i < geometry.rays.owners.size(); i++) {
    if (geometry.rays.owners[i] >= 0) (i < in_pages ? counts.page_texels : counts.chart_texels)++;
  }
}

}  // namespace

LayerGeometry build_layers(const Scene& scene, const HeadBox& box, int width, LayerCounts* report,
                           const Progress& progress) {
  LayerCounts counts;
  LayerGeometry geometry;
  geometry.scene.box = box;
  geometry.scene.width = width;
  const float half = 0.5f * std::max({box.size.x, box.size.y, box.size.z});
  const std::vector<char> panes = find_panes(scene, box.center, half + kEyeRoom);
  FirstHits hits(scene, panes);
  std::vector<FlatMirror> mirrors = seen_mirrors(hits, box.center, box.size);
  counts.mirrors = mirrors.size();
  counts.panes = static_cast<size_t>(std::ranges::count(panes, 1));
  if (!mirrors.empty()) hits.set_mirrors(std::move(mirrors), mirrored_sky_distance(scene, box.center));
  const Probe probe = probe_scene(hits, box, width, part_of(progress, 0.0, kShareOfProbe));
  check_head_room(free_half(probe), box.size, ", or another `position`");
  geometry.sees_sky = probe.sees_sky;
  for (const uint8_t side : probe.sides) counts.seen_triangles += side != 0 ? 1 : 0;
  const PanoramaPages pages(probe);
  const float pixel = pixel_angle(width);
  std::vector<PieceMesh> meshes = make_pieces(scene, pages, panes, pixel, counts, progress);

  const int size = geometry.texture_size = probe.grid.size();
  int page_count = 0;
  const std::vector<int> texture_of = textures_of_pages(probe.grid, meshes, page_count);
  geometry.scene.meshes.resize(static_cast<size_t>(page_count));
  add_page_meshes(probe.grid, meshes, texture_of, geometry.scene);
  std::vector<Chart> charts = make_charts(probe, meshes, pixel, size);
  pack(meshes, charts, size, geometry.scene);
  counts.charts = charts.size();

  geometry.rays.width = size;
  geometry.rays.height = size * static_cast<int>(geometry.scene.meshes.size());
  const size_t texels = static_cast<size_t>(size) * static_cast<size_t>(geometry.rays.height);
  geometry.rays.rays.resize(texels);
  geometry.rays.owners.assign(texels, -1);
  geometry.claims.assign(texels, -1);
  if (std::any_of(meshes.begin(), meshes.end(), [](const PieceMesh& mesh) { return mesh.masked; })) {
    geometry.coverage.resize(texels);
  }
  if (counts.panes > 0) geometry.reflectance.resize(texels);
  std::vector<char> read(probe.instances.size());
  for (const PieceMesh& mesh : meshes) mark_read(probe.grid, mesh, read);
  add_page_rays(pages, read, texture_of, geometry);
  const int first_owner = 2 * probe.numbers.total();
  tbb::parallel_for(size_t{0}, charts.size(), [&](size_t i) {
    add_chart_rays(hits, probe, meshes[charts[i].mesh], charts[i], first_owner + static_cast<int>(i), geometry);
  });
  add_chart_meshes(meshes, charts, size, geometry.scene);
  sort_blended(geometry.scene);
  if (report) {
    count_sizes(geometry, page_count, counts);
    counts.holes = find_holes(hits, geometry.scene, {{}, progress.cancelled});
    *report = counts;
  }
  if (progress.report) progress.report(1.0);
  return geometry;
}

}  // namespace ods
