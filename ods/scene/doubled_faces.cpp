// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/doubled_faces.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "ods/kernel/surface.h"

namespace ods {

namespace {

// A side of a triangle. Sides between the same corners have the same hash.
struct Side {
  uint32_t hash;
  uint32_t triangle;  // counted through all meshes that may be doubled
  bool operator<(const Side& other) const { return hash != other.hash ? hash < other.hash : triangle < other.triangle; }
};

struct PlacedMesh {
  size_t mesh;
  const Instance* instance;
  uint32_t first;  // number of its first triangle
};

using Corners = std::array<vec3, 3>;

uint32_t hash_of(vec3 p) {
  uint64_t hash = 0;
  for (int axis = 0; axis < 3; axis++) {
    hash = (hash + std::bit_cast<uint32_t>(p[axis] + 0.0f)) * 0x9e3779b97f4a7c15u;  // + 0: -0 becomes 0
    hash ^= hash >> 29u;
  }
  return static_cast<uint32_t>(hash >> 16u);
}

class FaceList {
 public:
  explicit FaceList(const Scene& scene) : scene_(scene) {
    std::vector<char> known(scene.meshes.size(), 0);
    for (size_t i = 0; i < scene.instances.size(); i++) {
      const auto mesh = static_cast<size_t>(scene.instances[i].mesh);
      const Mesh& record = scene.meshes[mesh];
      if (known[mesh] != 0 || is_hidden(scene, i)) continue;
      if (scene.materials[static_cast<size_t>(record.material)].double_sided != 0) continue;
      known[mesh] = 1;
      placed_.push_back({mesh, &scene.instances[i], count_});
      count_ += record.triangle_count;
    }
  }

  uint32_t count() const { return count_; }

  // The mesh of a triangle.
  const PlacedMesh& place_of(uint32_t triangle) const {
    return *(std::ranges::upper_bound(placed_, triangle, {}, &PlacedMesh::first) - 1);
  }

  Corners corners(const PlacedMesh& place, uint32_t triangle) const {
    const Mesh& mesh = scene_.meshes[place.mesh];
    const uvec3 indices = scene_.triangles[mesh.first_triangle + triangle - place.first];
    const auto at = [&](uint corner) {
      return to_world(*place.instance, scene_.vertices[mesh.first_vertex + size_t{corner}].position);
    };
    // The corners of a mirrored instance are reversed, so that its front is still where they run counter-clockwise.
    const Corners found{at(indices.x), at(indices.y), at(indices.z)};
    return handedness_of(*place.instance) < 0.0f ? Corners{found[0], found[2], found[1]} : found;
  }
  Corners corners(uint32_t triangle) const { return corners(place_of(triangle), triangle); }

  std::vector<Side> sorted_sides() const {
    std::vector<Side> sides;
    sides.reserve(3 * size_t{count_});
    for (const PlacedMesh& place : placed_) {
      for (uint32_t i = place.first; i < place.first + scene_.meshes[place.mesh].triangle_count; i++) {
        const Corners p = corners(place, i);
        const uint32_t hashes[3] = {hash_of(p[0]), hash_of(p[1]), hash_of(p[2])};
        for (int k = 0; k < 3; k++) sides.push_back({hashes[k] + hashes[(k + 1) % 3], i});
      }
    }
    tbb::parallel_sort(sides);
    return sides;
  }

 private:
  const Scene& scene_;
  std::vector<PlacedMesh> placed_;
  uint32_t count_ = 0;
};

// Returns whether two triangles in one plane face opposite ways and lie on the same side of a common edge.
bool cover_each_other(const Corners& a, const Corners& b) {
  constexpr float kFlat = 0.9999f;
  const vec3 normal = cross(a[1] - a[0], a[2] - a[0]), other = cross(b[1] - b[0], b[2] - b[0]);
  if (!(dot(normal, other) < -kFlat * length(normal) * length(other))) return false;
  for (size_t i = 0; i < 3; i++) {
    for (size_t k = 0; k < 3; k++) {
      // Seen from one side, triangles that face opposite ways run along a common edge in opposite directions if they
      // lie on the same side of it.
      if (a[i] == b[(k + 1) % 3] && a[(i + 1) % 3] == b[k]) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::vector<char>> find_doubled_faces(const Scene& scene) {
  constexpr size_t kMaxAtEdge = 16;  // so that the time stays linear
  std::vector<std::vector<char>> doubled(scene.meshes.size());
  const FaceList faces(scene);
  const std::vector<Side> sides = faces.sorted_sides();
  const auto mark = [&](uint32_t triangle) {
    const PlacedMesh& place = faces.place_of(triangle);
    doubled[place.mesh].resize(scene.meshes[place.mesh].triangle_count);
    doubled[place.mesh][triangle - place.first] = 1;
  };
  for (size_t i = 0; i < sides.size(); i++) {
    const size_t end = std::min(sides.size(), i + kMaxAtEdge);
    for (size_t k = i + 1; k < end && sides[k].hash == sides[i].hash; k++) {
      if (!cover_each_other(faces.corners(sides[i].triangle), faces.corners(sides[k].triangle))) continue;
      mark(sides[i].triangle), mark(sides[k].triangle);
    }
  }
  return doubled;
}

}  // namespace ods
