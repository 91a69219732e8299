// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/layers/footprint.h"
#include "ods/layers/rays/panes.h"

namespace ods {

namespace {

constexpr float kLift = 1e-3f;  // metres in front of a surface that the probe's own ray has met
constexpr float kFlatness = 1e-3f;
constexpr int kSeveral = 4;              // texels of a piece that is dropped if none has a ray
constexpr float kGrazingJitter = 0.02f;  // cosine: steps on steeper surfaces become no longer

// A step beside a ray, along it until the step lies on the surface: so the origin stays in front of the surface.
vec3 on_surface(vec3 step, vec3 direction, vec3 normal) {
  return step - direction * (dot(step, normal) / std::min(dot(direction, normal), -kGrazingJitter));
}

// The way to a point that a mirror shows, from just in front of the mirror. Both are relative to the middle.
struct MirroredStart {
  vec3 origin;
  float distance;  // from there to the point
  float share;     // of the whole way: what a step beside the point is beside this one
};

MirroredStart start_at_mirror(const FlatMirror& mirror, vec3 middle, vec3 point, vec3 direction) {
  const float behind = height_above(mirror, middle + point) / std::min(dot(mirror.normal, direction), -1e-6f);
  const float beyond = std::max(behind, 0.0f);
  const vec3 crossing = point - direction * beyond;
  const float lift = std::min(kLift + kFlatness * length(crossing), 0.5f * length(crossing));
  return {crossing - direction * lift, beyond + lift, length(crossing) / length(point)};
}

// A step beside a point that a mirror shows, as one beside the crossing on the mirror: rays are parallel within a texel,
// and larger steps would leave the mirror.
vec3 on_mirror(const FlatMirror& mirror, const MirroredStart& start, vec3 step, vec3 direction) {
  return on_surface(start.share * step, direction, mirror.normal);
}

// Returns whether all of a texel's rays meet the mirror before which they start.
bool starts_in(const FlatMirror& mirror, const TexelRay& ray) {
  for (const vec2& at : {vec2(-0.5f, -0.5f), vec2(-0.5f, 0.5f), vec2(0.5f, -0.5f), vec2(0.5f, 0.5f)}) {
    if (!is_in_outline(mirror, ray.origin + at.x * ray.across + at.y * ray.down, 0.0f)) return false;
  }
  return true;
}

// The ray of a page's texel. It is jittered only where its neighbours lie on the same plane.
TexelRay page_ray(const PanoramaPages& pages, size_t texel, int page, int x, int y) {
  const PageGrid& grid = pages.grid();
  const Probe& probe = pages.probe();
  const vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const vec3 point = pages.point(texel), direction = normalize(point);
  TexelRay ray{};
  ray.origin = probe.box.center + point - direction * std::min(kLift + kFlatness * length(point), 0.5f * length(point));
  ray.direction = direction;
  const FlatMirror* const mirror = mirror_of(probe, probe.instances[texel]);
  MirroredStart start{};
  if (mirror) {
    start = start_at_mirror(*mirror, probe.box.center, point, direction);
    ray.origin = probe.box.center + start.origin;
  }
  const vec3 normal = unpack_direction(probe.normals[texel]);
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= grid.size() || y + dy >= grid.size()) return ray;
    const size_t beside = texel_index(grid.size(), page, x + dx, y + dy);
    if (pages.source(beside) != beside || probe.instances[beside] != probe.instances[texel]) return ray;
    if (!pages.shows(beside, point, normal, kLift)) return ray;
  }
  const auto step = [&](vec2 half) {
    const vec3 on_sphere =
        (from_page(grid, page, center + half) - from_page(grid, page, center - half)) * length(point);
    return mirror ? on_mirror(*mirror, start, on_sphere, direction) : on_surface(on_sphere, direction, normal);
  };
  ray.across = step({0.5f, 0.0f});
  ray.down = step({0.0f, 0.5f});
  return ray;
}

// A chart's corner positions in texels, and in space.
struct ChartTriangle {
  vec2 at[3];
  vec3 corners[3];
  vec3 normal;

  // The point of the triangle's plane at a position in the chart.
  vec3 point(vec2 position) const {
    const vec2 u = at[1] - at[0], v = at[2] - at[0], to = position - at[0];
    const float area = u.x * v.y - u.y * v.x;
    if (abs(area) < 1e-6f) return (corners[0] + corners[1] + corners[2]) / 3.0f;
    const float b = (to.x * v.y - to.y * v.x) / area, c = (u.x * to.y - u.y * to.x) / area;
    return corners[0] + b * (corners[1] - corners[0]) + c * (corners[2] - corners[0]);
  }
};

// Shoots at points of one chart's surface.
struct ChartShooter {
  const FirstHits& hits;
  const Probe& probe;
  const PieceMesh& mesh;
  vec3 place;  // relative to the middle

  // The ray that arrives at a point from just in front of it; direction 0 if it does not meet the surface. The scene's own
  // surface may lie in front of the simplified one, so it starts as far away as the tolerance allows, or nearer if
  // something else is there. Where no place sees the surface, as below a thing that stands on it, it is dark: the colour
  // beside it is better.
  TexelRay ray(vec3 point, vec3 normal) const {
    TexelRay ray{};
    const auto sees_it = [&](const DistanceMap& map) { return sees(map, mesh, point, normal, 0); };
    if (std::none_of(probe.maps.begin(), probe.maps.end(), sees_it)) return ray;
    vec3 direction = normalize(point - place);
    if (dot(direction, normal) > -0.05f) direction = normalize(direction - normal * (0.1f + dot(direction, normal)));
    const float most = depth_tolerance(mesh, -dot(direction, normal));
    if (mesh.mirror >= 0) return mirrored_ray(point, direction, most);
    for (const float share : {1.0f, 0.3f, 0.1f}) {
      const float lift = std::min(std::max(share * most, kLift), 0.5f * length(point));
      ray.origin = probe.box.center + point - direction * lift;
      FirstHit seen;
      hits.look(ray.origin, &direction, 1, &seen);
      if (seen.instance != mesh.side / 2 || seen.front != (mesh.side % 2 == 0) || seen.distance > lift + most) continue;
      ray.direction = direction;
      break;
    }
    return ray;
  }

  // The same through a mirror.
  TexelRay mirrored_ray(vec3 point, vec3 direction, float most) const {
    TexelRay ray{};
    const MirroredStart start = start_at_mirror(*mirror_of(probe, mesh.side), probe.box.center, point, direction);
    ray.origin = probe.box.center + start.origin;
    FirstHit seen;
    hits.look(ray.origin, &direction, 1, &seen);
    const bool is_it = seen.instance == mesh.side / 2 && seen.front == (mesh.side % 2 == 0);
    const bool is_there = probe.numbers.is_sky(mesh.side / 2) || abs(seen.distance - start.distance) <= most;
    if (is_it && is_there) ray.direction = direction;
    return ray;
  }
};

// The ray that finds what a pane reflects to the middle at a point.
TexelRay pane_ray(const Probe& probe, const ChartTriangle& triangle, vec3 point) {
  TexelRay ray{};
  const vec3 direction = normalize(point);
  ray.origin = probe.box.center + point + triangle.normal * (kLift + 0.1f * kFlatness * length(point));
  ray.direction = direction - triangle.normal * (2.0f * dot(direction, triangle.normal));
  return ray;
}

// Sets what a texel of a pane needs beside its light.
void set_glass(const Scene& scene, int side, float cosine, size_t at, LayerGeometry& geometry) {
  const Instance& instance = scene.instances[static_cast<size_t>(side / 2)];
  const Material& glass =
      scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)];
  geometry.coverage[at] = pane_alpha(glass, cosine);
  geometry.reflectance[at] = pane_reflectance(glass, cosine);
}

}  // namespace

void mark_read(const PageGrid& grid, const PieceMesh& mesh, std::vector<char>& read) {
  for (const Piece& piece : mesh.pieces) {
    if (piece.state != PieceState::kPage) continue;
    vec2 at[3];
    for (int i = 0; i < 3; i++) at[i] = to_page(grid, piece.page, mesh.positions[piece.corners[i]]);
    for_each_texel(at, grid.size(), [&](int x, int y, bool) {
      read[texel_index(grid.size(), piece.page, x, y)] = 1;
      return true;
    });
  }
}

void add_page_rays(const PanoramaPages& pages, const std::vector<char>& read, const std::vector<int>& texture_of,
                   LayerGeometry& geometry) {
  const PageGrid& grid = pages.grid();
  const size_t size = static_cast<size_t>(grid.size()), page_texels = size * size;
  const auto in_textures = [&](size_t texel) {
    return static_cast<size_t>(texture_of[texel / page_texels]) * page_texels + texel % page_texels;
  };
  std::vector<char> lit(read.size());
  for (size_t texel = 0; texel < read.size(); texel++) {
    if (!read[texel]) continue;
    const size_t from = pages.source(texel);
    lit[from] = 1;
    if (from != texel) geometry.pushed.push_back({in_textures(texel), in_textures(from)});
  }
  tbb::parallel_for(size_t{0}, read.size() / size, [&](size_t row) {
    for (size_t x = 0; x < size; x++) {
      const size_t texel = row * size + x;
      if (!lit[texel]) continue;
      const size_t to = in_textures(texel);
      geometry.rays.rays[to] =
          page_ray(pages, texel, static_cast<int>(row / size), static_cast<int>(x), static_cast<int>(row % size));
      geometry.rays.owners[to] = pages.probe().instances[texel];
    }
  });
}

void add_chart_rays(const FirstHits& hits, const Probe& probe, PieceMesh& mesh, const Chart& chart, int owner,
                    LayerGeometry& geometry) {
  const ChartShooter shooter{hits, probe, mesh, probe.maps[static_cast<size_t>(chart.place)].place};
  const FlatMirror* const mirror = mirror_of(probe, mesh.side);
  const int size = geometry.texture_size;
  std::vector<char> inside(static_cast<size_t>(chart.width) * static_cast<size_t>(chart.height));
  for (const size_t index : chart.pieces) {
    ChartTriangle triangle;
    for (int i = 0; i < 3; i++) {
      triangle.corners[i] = mesh.positions[mesh.pieces[index].corners[i]];
      triangle.at[i] = in_chart(chart, triangle.corners[i]);
    }
    triangle.normal = normal_of(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    int contained_texels = 0, lit_texels = 0;
    for_each_texel(triangle.at, size, [&](int x, int y, bool contained) {
      if (x < chart.x || y < chart.y || x >= chart.x + chart.width || y >= chart.y + chart.height) return true;
      const size_t at = texel_index(size, chart.texture, x, y);
      const vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      char& done = inside[static_cast<size_t>(y - chart.y) * static_cast<size_t>(chart.width) +
                          static_cast<size_t>(x - chart.x)];
      const char level = contained ? 2 : 1;
      if (done >= level) return true;
      done = level;
      const vec3 point = triangle.point(center);
      const auto shoot = [&](vec2 offset) { return shooter.ray(triangle.point(center + offset), triangle.normal); };
      TexelRay ray = mesh.is_pane  ? pane_ray(probe, triangle, point)
                     : mesh.masked ? covered_ray(shoot, geometry.coverage[at])
                                   : shooter.ray(point, triangle.normal);
      if (mesh.is_pane) set_glass(hits.scene(), mesh.side, -dot(normalize(point), triangle.normal), at, geometry);
      if ((!mesh.masked || mesh.is_pane) && level == 2 && ray.direction != vec3(0.0f)) {
        const vec3 seen_along = mesh.is_pane ? normalize(point) : ray.direction;
        const auto step = [&](vec3 axis) {
          const vec3 beside = axis / dot(axis, axis);
          if (!mirror) return on_surface(beside, seen_along, triangle.normal);
          const MirroredStart start = start_at_mirror(*mirror, probe.box.center, point, seen_along);
          return on_mirror(*mirror, start, beside, seen_along);
        };
        ray.across = step(chart.across);
        ray.down = step(chart.down);
        if (mirror && !starts_in(*mirror, ray)) ray.across = ray.down = vec3(0.0f);
      }
      geometry.rays.rays[at] = ray;
      const bool lit = ray.direction != vec3(0.0f);
      geometry.rays.owners[at] = lit ? owner : -1;
      geometry.claims[at] = lit ? -1 : owner;
      if (contained) contained_texels++;
      if (lit) lit_texels++;
      return true;
    });
    const bool is_hidden = contained_texels >= kSeveral && lit_texels == 0;
    if (is_hidden && !mirror) mesh.pieces[index].state = PieceState::kDropped;
  }
}

}  // namespace ods
