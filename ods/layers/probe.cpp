// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/probe.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/kernel/camera/texel_ray.h"

namespace ods {

namespace {

constexpr int kTile = 4;  // rays of a packet: a square, so that they meet the same surfaces
static_assert(kTile * kTile == RayPacket::kMax);

// Packs a component in 15 bits.
uint32_t pack_component(float value) {
  return static_cast<uint32_t>(std::lrint((std::clamp(value, -1.0f, 1.0f) + 1.0f) * 16383.5f));
}

float unpack_component(uint32_t packed) {
  return static_cast<float>(packed & 0x7fffu) / 16383.5f - 1.0f;
}

void mark(std::vector<uint8_t>& sides, size_t triangle, uint8_t side) {
  std::atomic_ref<uint8_t> seen(sides[triangle]);
  if ((seen.load(std::memory_order_relaxed) & side) == 0) seen.fetch_or(side, std::memory_order_relaxed);
}

void lower(float& smallest, float value) {
  std::atomic_ref<float> now(smallest);
  for (float before = now.load(std::memory_order_relaxed); value < before;) {
    if (now.compare_exchange_weak(before, value, std::memory_order_relaxed)) return;
  }
}

}  // namespace

std::vector<vec3> places_of(const HeadBox& box) {
  const vec3 half = 0.5f * box.size;
  std::vector<vec3> places = {vec3(0.0f)};
  for (int i = 0; i < 8; i++) {
    const vec3 corner(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
    places.push_back(corner);
  }
  for (int i = 0; i < 6; i++) {
    vec3 face(0.0f);
    face[i / 2] = i % 2 == 0 ? half[i / 2] : -half[i / 2];
    places.push_back(face);
  }
  return places;
}

// The components' sum of magnitudes is 1 on an octahedron, which unfolds into a square.
// Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014.
uint32_t pack_direction(vec3 normal) {
  const float sum = abs(normal.x) + abs(normal.y) + abs(normal.z);
  vec2 flat(normal.x / sum, normal.y / sum);
  if (normal.z < 0.0f) {
    flat = vec2(std::copysign(1.0f - abs(flat.y), flat.x), std::copysign(1.0f - abs(flat.x), flat.y));
  }
  return pack_component(flat.x) | pack_component(flat.y) << 15;
}

vec3 unpack_direction(uint32_t packed) {
  const vec2 flat(unpack_component(packed), unpack_component(packed >> 15));
  vec3 normal(flat.x, flat.y, 1.0f - abs(flat.x) - abs(flat.y));
  if (normal.z < 0.0f) {
    normal.x = std::copysign(1.0f - abs(flat.y), flat.x);
    normal.y = std::copysign(1.0f - abs(flat.x), flat.y);
  }
  return normalize(normal);
}

namespace {

// Looks from a place at all texels of a grid and calls visit(texel, seen).
template <typename Visit>
void look_around(const FirstHits& hits, vec3 place, const PageGrid& grid, const Progress& progress,
                 const Visit& visit) {
  const int tiles = grid.size() / kTile;
  tbb::parallel_for(0, grid.pages() * tiles, [&](int row) {
    if (progress.cancelled && progress.cancelled()) return;
    const int page = row / tiles;
    for (int tile = 0; tile < tiles; tile++) {
      vec3 directions[RayPacket::kMax];
      FirstHit seen[RayPacket::kMax];
      const int x0 = tile * kTile, y0 = row % tiles * kTile;
      for (int i = 0; i < RayPacket::kMax; i++) {
        directions[i] = grid.texel_ray(page, x0 + i % kTile, y0 + i / kTile);
      }
      hits.look(place, directions, RayPacket::kMax, seen);
      const size_t size = static_cast<size_t>(grid.size());
      for (int i = 0; i < RayPacket::kMax; i++) {
        const size_t y = static_cast<size_t>(page) * size + static_cast<size_t>(y0 + i / kTile);
        visit(y * size + static_cast<size_t>(x0 + i % kTile), seen[i]);
      }
    }
  });
  if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "cancelled");
}

size_t texels_of(const PageGrid& grid) {
  return static_cast<size_t>(grid.pages()) * static_cast<size_t>(grid.size()) * static_cast<size_t>(grid.size());
}

void count_triangles(const Scene& scene, Probe& probe) {
  size_t count = 0;
  for (int i = 0; i < probe.numbers.total(); i++) {
    probe.first_triangle.push_back(count);
    const auto mesh_of = [&](int real) { return scene.instances[static_cast<size_t>(real)].mesh; };
    count +=
        probe.numbers.is_sky(i) ? 1 : scene.meshes[static_cast<size_t>(mesh_of(probe.numbers.real(i)))].triangle_count;
  }
  probe.sides.resize(count);
  probe.nearest.assign(2 * static_cast<size_t>(probe.numbers.total()), kFarAway);
}

}  // namespace

Probe probe_scene(const FirstHits& hits, const HeadBox& box, int width, const Progress& progress) {
  Probe probe;
  probe.box = box;
  probe.grid = page_grid(width);
  const size_t bytes =
      sizeof(float) + sizeof(uint32_t) + sizeof(int) + sizeof(TexelRay) + 2 * sizeof(int) + sizeof(int8_t);
  check_memory(texels_of(probe.grid) * bytes +
                   (kPlaces - 1) * texels_of(page_grid(width / 2)) * (sizeof(float) + sizeof(int8_t)),
               fmt::format("a layered scene {} pixels around", width), "a smaller `width` needs less");
  probe.numbers = hits.numbers();
  probe.mirrors = hits.mirrors();
  probe.mirrored_sky = hits.sky_distance();
  count_triangles(hits.scene(), probe);
  probe.normals.resize(texels_of(probe.grid));
  probe.instances.assign(texels_of(probe.grid), -1);
  std::atomic<bool> sky = false;
  const std::vector<vec3> places = places_of(box);
  for (int place = 0; place < kPlaces; place++) {
    const PageGrid grid = place == kMiddle ? probe.grid : page_grid(width / 2);
    DistanceMap& map = probe.maps.emplace_back(DistanceMap{places[static_cast<size_t>(place)], grid, {}, {}});
    map.distances.resize(texels_of(grid));
    if (probe.numbers.mirrors > 0) map.mirrors.assign(texels_of(grid), -1);
    look_around(hits, box.center + map.place, grid, progress, [&](size_t texel, const FirstHit& seen) {
      if (seen.instance < 0) {
        map.distances[texel] = kFarAway;
        if (!sky) sky = true;
        return;
      }
      map.distances[texel] = seen.distance;
      if (!map.mirrors.empty()) map.mirrors[texel] = static_cast<int8_t>(probe.numbers.mirror_of(seen.instance));
      const size_t instance = static_cast<size_t>(seen.instance);
      mark(probe.sides, probe.first_triangle[instance] + static_cast<size_t>(seen.triangle),
           seen.front ? kFrontSeen : kBackSeen);
      lower(probe.nearest[2 * instance + (seen.front ? 0 : 1)], seen.distance);
      if (place != kMiddle) return;
      probe.normals[texel] = pack_direction(seen.normal);
      probe.instances[texel] = 2 * seen.instance + (seen.front ? 0 : 1);
    });
    if (progress.report) progress.report(static_cast<double>(place + 1) / kPlaces);
  }
  probe.sees_sky = sky;
  return probe;
}

}  // namespace ods
