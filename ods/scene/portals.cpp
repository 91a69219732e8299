// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/portals.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ods/kernel/light.h"
#include "ods/kernel/random.h"
#include "ods/scene/placement.h"
#include "ods/scene/sheet_glass.h"

namespace ods {

namespace {

constexpr float kThickest = 0.1f;   // thickness of a pane over its shorter side
constexpr float kMinFilled = 0.8f;  // fraction of the rectangle that the pane fills
constexpr float kSmallest = 0.02f;  // minimum area over the area of the largest pane
constexpr int kLooks = 1024;        // rays from the viewer
constexpr float kMaxSky = 0.25f;    // maximum fraction that leaves the scene, in a room,
constexpr float kMinShare = 0.9f;   // and minimum fraction of these that leaves through portals

struct Triangle {
  vec3 corner[3];
  vec3 area() const { return 0.5f * cross(corner[1] - corner[0], corner[2] - corner[0]); }
};

bool may_be_pane(const Material& material) {
  return is_smooth_glass(material) && !(material.thickness > 0.0f) && material.metallic < 1.0f;
}

// The connected parts of an instance, as triangles in the world.
std::vector<std::vector<Triangle>> parts_of(const Scene& scene, const Instance& instance) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const std::vector<uint> merged = merge_positions(scene, mesh);
  std::vector<uint> leader = merged;
  const auto find = [&](uint i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  const Vertex* vertices = scene.vertices.data() + mesh.first_vertex;
  const uvec3* corners = scene.triangles.data() + mesh.first_triangle;
  for (uint t = 0; t < mesh.triangle_count; t++) {
    const uint first = find(merged[corners[t].x]);
    leader[find(merged[corners[t].y])] = first;
    leader[find(merged[corners[t].z])] = first;
  }
  std::map<uint, std::vector<Triangle>> parts;
  for (uint t = 0; t < mesh.triangle_count; t++) {
    Triangle triangle;
    for (int c = 0; c < 3; c++) triangle.corner[c] = to_world(instance, vertices[corners[t][c]].position);
    parts[find(merged[corners[t].x])].push_back(triangle);
  }
  std::vector<std::vector<Triangle>> list;
  for (auto& [first, part] : parts) list.push_back(std::move(part));
  return list;
}

// The rectangle that a flat part nearly fills, in its middle plane. Its directions are those of the largest triangle.
std::vector<Portal> rectangle_of(const std::vector<Triangle>& part) {
  const Triangle& largest = *std::max_element(part.begin(), part.end(), [](const Triangle& a, const Triangle& b) {
    return length(a.area()) < length(b.area());
  });
  if (!(length(largest.area()) > 0.0f)) return {};
  // The sides of the rectangle start at the corner whose angle is closest to a right angle.
  vec3 along(0.0f);
  float best = 2.0f;
  for (int c = 0; c < 3; c++) {
    const vec3 a = largest.corner[(c + 1) % 3] - largest.corner[c], b = largest.corner[(c + 2) % 3] - largest.corner[c];
    const float cosine = std::abs(dot(a, b)) / std::max(length(a) * length(b), 1e-30f);
    if (cosine < best) best = cosine, along = normalize(a);
  }
  const vec3 normal = normalize(largest.area()), across = cross(normal, along);
  const vec3 axes[3] = {along, across, normal};
  float low[3], high[3], facing = 0.0f;
  std::fill_n(low, 3, 1e30f), std::fill_n(high, 3, -1e30f);
  for (const Triangle& triangle : part) {
    facing += std::abs(dot(triangle.area(), normal));
    for (const vec3& corner : triangle.corner) {
      for (int i = 0; i < 3; i++) {
        low[i] = std::min(low[i], dot(corner, axes[i]));
        high[i] = std::max(high[i], dot(corner, axes[i]));
      }
    }
  }
  const float wide = high[0] - low[0], tall = high[1] - low[1], thick = high[2] - low[2];
  if (!(thick <= kThickest * std::min(wide, tall)) || facing < kMinFilled * wide * tall) return {};
  const vec3 corner = along * low[0] + across * low[1] + normal * (0.5f * (low[2] + high[2]));
  return {{corner, along * wide, across * tall}};
}

float area_of(const Portal& portal) {
  return length(cross(portal.along, portal.across));
}

}  // namespace

std::vector<Portal> find_portals(const Scene& scene) {
  std::vector<Portal> portals;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    if (is_hidden(scene, i) || !may_be_pane(scene.materials[static_cast<size_t>(mesh.material)])) continue;
    for (const std::vector<Triangle>& part : parts_of(scene, scene.instances[i])) {
      for (const Portal& portal : rectangle_of(part)) portals.push_back(portal);
    }
  }
  std::stable_sort(portals.begin(), portals.end(),
                   [](const Portal& a, const Portal& b) { return area_of(a) > area_of(b); });
  std::erase_if(portals, [&](const Portal& portal) { return area_of(portal) < kSmallest * area_of(portals.front()); });
  portals.resize(std::min(portals.size(), kMaxPortals));
  return portals;
}

bool show_the_sky(const std::vector<Portal>& portals, vec3 viewer, const std::function<bool(vec3 direction)>& escapes) {
  if (portals.empty()) return false;
  LightSampler sampler;
  int out = 0, by_portal = 0;
  for (uint i = 0; i < kLooks; i++) {
    const vec2 at = random_pair(0u, i, 0u);
    const float height = 1.0f - 2.0f * at.x, r = std::sqrt(std::max(1.0f - height * height, 0.0f));
    const vec3 direction(r * std::cos(2.0f * kPi * at.y), height, r * std::sin(2.0f * kPi * at.y));
    if (!escapes(direction)) continue;
    out++;
    const auto passes = [&](const Portal& portal) { return sampler.portal_distance(portal, viewer, direction) > 0.0f; };
    by_portal += std::any_of(portals.begin(), portals.end(), passes);
  }
  return out > 0 && static_cast<float>(out) <= kMaxSky * kLooks &&
         static_cast<float>(by_portal) >= kMinShare * static_cast<float>(out);
}

}  // namespace ods
