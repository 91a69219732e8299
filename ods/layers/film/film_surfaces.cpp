// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/film_surfaces.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "ods/base/memory.h"
#include "ods/kernel/surface.h"
#include "ods/layers/head_room.h"
#include "ods/layers/probe.h"
#include "ods/layers/rays/first_hits.h"
#include "ods/layers/rays/panes.h"
#include "ods/layers/simplify.h"
#include "ods/scene/motion.h"

namespace ods {

namespace {

constexpr size_t kEyes = 8;           // the corners of the box
constexpr size_t kLookFrames = 16;    // frames at which rays find what is seen, at most
constexpr float kSeenAt = 0.004f;     // metres between a ray's hit and the point that it should meet,
constexpr float kSeenShare = 0.002f;  // and as a share of its distance
constexpr float kLarge = 0.01f;  // of the distance's square: twice the area of triangles of which parts may be seen

glm::quat rotation_of(const LayerPose& pose) {
  return {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z};
}

std::vector<vec3> world_positions(const Scene& scene, int index, const std::vector<uint>& welded, vec3 origin) {
  const Instance& instance = scene.instances[static_cast<size_t>(index)];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  std::vector<vec3> positions(welded.size());
  for (uint v = 0; v < mesh.vertex_count; v++) {
    positions[welded[v]] = to_world(instance, scene.vertices[mesh.first_vertex + v].position) - origin;
  }
  return positions;
}

// A side of an instance at the present frame.
WholeSurface side_of(const Scene& scene, int index, bool is_back, vec3 origin) {
  const Instance& instance = scene.instances[static_cast<size_t>(index)];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  WholeSurface whole;
  whole.surface.instance = index;
  whole.surface.is_back = is_back;
  whole.surface.is_masked = scene.materials[static_cast<size_t>(mesh.material)].alpha_mode != kAlphaOpaque;
  std::vector<vec3> local;
  for (uint v = 0; v < mesh.vertex_count; v++) local.push_back(scene.vertices[mesh.first_vertex + v].position);
  const std::vector<uint>& welded = whole.welded = first_equal(local);
  whole.surface.positions = world_positions(scene, index, welded, origin);
  const bool flips = (handedness_of(instance) < 0.0f) != is_back;
  for (uint t = 0; t < mesh.triangle_count; t++) {
    const uvec3 own = scene.triangles[mesh.first_triangle + t];
    uvec3 triangle(welded[own.x], welded[own.y], welded[own.z]);
    if (flips) std::swap(triangle.y, triangle.z);
    if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x) {
      whole.triangles.push_back(triangle);
    }
  }
  return whole;
}

// The point of a triangle that is nearest to p. Source: Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
vec3 nearest_point(vec3 p, vec3 a, vec3 b, vec3 c) {
  const vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
              d6 = dot(ac, cp);
  if (d1 <= 0.0f && d2 <= 0.0f) return a;
  if (d3 >= 0.0f && d4 <= d3) return b;
  if (d6 >= 0.0f && d5 <= d6) return c;
  const float of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_c <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return a + ab * (d1 / (d1 - d3));
  if (of_b <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return a + ac * (d2 / (d2 - d6));
  if (of_a <= 0.0f && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const float sum = of_a + of_b + of_c;
  return sum != 0.0f ? a + ab * (of_b / sum) + ac * (of_c / sum) : a;
}

// The corners of the box and its middle, in the coordinates of a mover at a frame.
std::vector<vec3> eyes_of(const Mover& mover, const LayerPose& pose, const HeadBox& box) {
  std::vector<vec3> eyes;
  for (size_t i = 0; i <= kEyes; i++) {
    const vec3 corner =
        i == kEyes ? vec3(0.0f) : 0.5f * box.size * vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const vec3 from = box.center + corner - (mover.deforms ? mover.origin : pose.place);
    eyes.push_back(mover.deforms ? from : vec3(glm::inverse(rotation_of(pose)) * from) / pose.scale);
  }
  return eyes;
}

void add_shapes(const Scene& scene, const std::vector<Mover>& movers, std::vector<WholeSurface>& surfaces) {
  for (WholeSurface& whole : surfaces) {
    const Mover& mover = movers[whole.surface.mover];
    if (!mover.deforms) continue;
    whole.surface.shapes.push_back(world_positions(scene, whole.surface.instance, whole.welded, mover.origin));
  }
}

size_t bytes_of_shapes(const std::vector<WholeSurface>& surfaces, const std::vector<Mover>& movers, size_t frames) {
  size_t bytes = 0;
  for (const WholeSurface& whole : surfaces) {
    if (movers[whole.surface.mover].deforms) bytes += 2 * frames * whole.surface.positions.size() * sizeof(vec3);
  }
  return bytes;
}

// The positions of a surface at a frame, in the scene.
std::vector<vec3> positions_at(const WholeSurface& whole, const Mover& mover, size_t frame) {
  const std::vector<vec3>& own = mover.deforms ? whole.surface.shapes[frame] : whole.surface.positions;
  std::vector<vec3> positions;
  for (const vec3& position : own) positions.push_back(at_pose(mover.poses[frame], position));
  return positions;
}

// Returns whether a place sees a point of a triangle: its middle, or near a corner.
bool is_seen(const FirstHits& hits, const FilmSurface& surface, const std::vector<vec3>& places,
             const vec3 (&corners)[3]) {
  const vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
  for (const vec3& place : places) {
    for (int i = 0; i < 4; i++) {
      const vec3 to = (i == 3 ? middle : mix(corners[i], middle, 0.1f)) - place, direction = normalize(to);
      FirstHit seen;
      hits.look(place, &direction, 1, &seen);
      if (seen.instance != surface.instance || seen.front == surface.is_back) continue;
      if (abs(seen.distance - length(to)) < kSeenAt + kSeenShare * length(to)) return true;
    }
  }
  return false;
}

void look_at_surface(const FirstHits& hits, const WholeSurface& whole, const std::vector<vec3>& positions,
                     const HeadBox& box, std::vector<char>& seen) {
  std::vector<vec3> places = places_of(box);
  for (vec3& place : places) place += box.center;
  tbb::parallel_for(size_t{0}, whole.triangles.size(), [&](size_t t) {
    if (seen[t]) return;
    const uvec3 triangle = whole.triangles[t];
    const vec3 corners[3] = {positions[triangle.x], positions[triangle.y], positions[triangle.z]};
    const float size = length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const float distance = length(corners[0] - box.center);
    seen[t] = size > kLarge * distance * distance || is_seen(hits, whole.surface, places, corners);
  });
}

void add_neighbours(const WholeSurface& whole, std::vector<char>& seen) {
  std::vector<char> touched(whole.surface.positions.size());
  for (size_t t = 0; t < seen.size(); t++) {
    for (int i = 0; seen[t] && i < 3; i++) touched[whole.triangles[t][i]] = 1;
  }
  for (size_t t = 0; t < seen.size(); t++) {
    for (int i = 0; i < 3; i++) seen[t] |= touched[whole.triangles[t][i]];
  }
}

}  // namespace

std::vector<std::vector<char>> seen_triangles(Scene& scene, const std::vector<WholeSurface>& surfaces,
                                              const std::vector<Mover>& movers, std::span<const double> times,
                                              const HeadBox& box) {
  std::vector<std::vector<char>> seen;
  for (const WholeSurface& whole : surfaces) {
    seen.emplace_back(whole.triangles.size(), whole.surface.is_masked ? char{1} : char{0});
  }
  const float half = 0.5f * std::max({box.size.x, box.size.y, box.size.z});
  const size_t step = (times.size() + kLookFrames - 1) / kLookFrames;
  for (size_t frame = 0; frame < times.size(); frame += step) {
    set_time(scene, times[frame]);
    const FirstHits hits(scene, find_panes(scene, box.center, half + kEyeRoom));
    for (size_t i = 0; i < surfaces.size(); i++) {
      const Mover& mover = movers[surfaces[i].surface.mover];
      if (!mover.poses[frame].shown || surfaces[i].surface.is_masked) continue;
      look_at_surface(hits, surfaces[i], positions_at(surfaces[i], mover, frame), box, seen[i]);
    }
  }
  set_time(scene, times.front());
  for (size_t i = 0; i < surfaces.size(); i++) add_neighbours(surfaces[i], seen[i]);
  return seen;
}

std::vector<WholeSurface> surfaces_of(Scene& scene, const std::vector<Mover>& movers, std::span<const double> times) {
  std::vector<WholeSurface> surfaces;
  for (size_t m = 0; m < movers.size(); m++) {
    set_time(scene, times[movers[m].reference]);
    for (const int instance : movers[m].instances) {
      const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[static_cast<size_t>(instance)].mesh)];
      const bool has_back = scene.materials[static_cast<size_t>(mesh.material)].double_sided != 0;
      for (const bool is_back : {false, true}) {
        if (is_back && !has_back) continue;
        surfaces.push_back(side_of(scene, instance, is_back, movers[m].origin));
        surfaces.back().surface.mover = m;
      }
    }
  }
  check_memory(bytes_of_shapes(surfaces, movers, times.size()),
               fmt::format("the shapes of what deforms in {} frames", times.size()), "fewer frames need less");
  const bool deforms = std::ranges::any_of(movers, &Mover::deforms);
  for (size_t frame = 0; deforms && frame < times.size(); frame++) {
    set_time(scene, times[frame]);
    add_shapes(scene, movers, surfaces);
  }
  set_time(scene, times.front());
  return surfaces;
}

FilmView view_of(const WholeSurface& whole, const Mover& mover, const HeadBox& box) {
  FilmView view;
  view.faces.resize(whole.triangles.size());
  for (size_t frame = 0; frame < mover.poses.size(); frame++) {
    const LayerPose& pose = mover.poses[frame];
    if (!pose.shown) continue;
    const std::vector<vec3>& positions = mover.deforms ? whole.surface.shapes[frame] : whole.surface.positions;
    const std::vector<vec3> eyes = eyes_of(mover, pose, box);
    const float scale = std::max({pose.scale.x, pose.scale.y, pose.scale.z});
    for (size_t t = 0; t < whole.triangles.size(); t++) {
      const uvec3 corners = whole.triangles[t];
      const vec3 a = positions[corners.x], b = positions[corners.y], c = positions[corners.z];
      const vec3 normal = cross(b - a, c - a);
      if (std::none_of(eyes.begin(), eyes.end(), [&](vec3 eye) { return dot(normal, eye - a) > 0.0f; })) continue;
      view.faces[t] = 1;
      const vec3 to = nearest_point(eyes[kEyes], a, b, c) - eyes[kEyes];
      const vec3 away = abs(mover.deforms ? to : vec3(rotation_of(pose) * (pose.scale * to)));
      view.free_half = std::min(view.free_half, std::max({away.x, away.y, away.z}));
      view.nearest = std::min(view.nearest, length(max(away - 0.5f * box.size, vec3(0.0f))) / scale);
    }
  }
  return view;
}

}  // namespace ods
