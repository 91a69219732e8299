// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/upright.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ods/kernel/surface.h"
#include "ods/stage/gravity.h"

namespace ods {

namespace {

constexpr size_t kMinInstances = 8;
constexpr float kSlack = 0.01f;  // relative to the scene's height: tolerance for equal heights

// The lowest floor along an axis and the objects on it.
struct Ground {
  float standing = 0.0f;  // share of the instances
  float floor = 0.0f;     // area of the level triangles there, over the area of the scene's base
};

// The box of each visible instance.
std::vector<Bounds> boxes_of(const Scene& scene) {
  std::vector<Bounds> boxes;
  for (const std::optional<Bounds>& box : instance_boxes(scene)) {
    if (box) boxes.push_back(*box);
  }
  return boxes;
}

// The height at which most boxes stand, and their fraction.
std::pair<float, float> common_height(const std::vector<Bounds>& boxes, int axis, float slack) {
  std::vector<float> lows;
  for (const Bounds& box : boxes) lows.push_back(box.low[axis]);
  std::ranges::sort(lows);
  size_t maximum = 0, first = 0;
  float height = 0.0f;
  for (size_t last = 0; last < lows.size(); last++) {
    while (lows[last] - lows[first] > slack) first++;
    if (last - first + 1 <= maximum) continue;
    maximum = last - first + 1;
    height = lows[last];
  }
  return {height, static_cast<float>(maximum) / static_cast<float>(lows.size())};
}

float floor_area(const Scene& scene, int axis, float height, float slack) {
  double area = 0.0;
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (is_hidden(scene, i)) continue;
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (uint k = 0; k < mesh.triangle_count; k++) {
      const uvec3 t = scene.triangles[mesh.first_triangle + k];
      const auto at = [&](uint corner) {
        return to_world(instance, scene.vertices[mesh.first_vertex + size_t{corner}].position);
      };
      const vec3 a = at(t.x), across = cross(at(t.y) - a, at(t.z) - a);
      const bool level = std::abs(across[axis]) > 0.99f * length(across);
      if (level && std::abs(a[axis] - height) < 2.0f * slack) area += 0.5 * static_cast<double>(length(across));
    }
  }
  return static_cast<float>(area);
}

Ground ground_along(const Scene& scene, const std::vector<Bounds>& boxes, const Bounds& bounds, int axis) {
  const vec3 size = bounds.high - bounds.low;
  const float slack = kSlack * std::max({size.x, size.y, size.z});
  const auto [height, share] = common_height(boxes, axis, slack);
  const float base = size.x * (axis == 1 ? size.z : size.y);
  return {share, base > 0.0f ? floor_area(scene, axis, height, slack) / base : 0.0f};
}

// Returns whether enough of the boxes that stand at a height are tall: what is stuck on an upright board is flat.
bool are_tall(const std::vector<Bounds>& boxes, const Bounds& bounds) {
  constexpr float kTall = 0.75f;  // of the longer side of the base
  const vec3 whole = bounds.high - bounds.low;
  const float slack = kSlack * std::max({whole.x, whole.y, whole.z});
  const float height = common_height(boxes, 2, slack).first;
  size_t standing = 0, tall = 0;
  for (const Bounds& box : boxes) {
    const vec3 size = box.high - box.low;
    if (box.low.z > height || box.low.z < height - slack) continue;
    standing++;
    tall += size.z >= kTall * std::max(size.x, size.y) ? 1 : 0;
  }
  return 2 * tall >= kMinInstances && 3 * tall >= standing;
}

bool stands_along_z(const Scene& scene) {
  constexpr float kMax = 0.5f, kFew = 0.2f, kFloor = 0.5f;
  constexpr int kY = 1, kZ = 2;
  const std::vector<Bounds> boxes = boxes_of(scene);
  if (boxes.size() < kMinInstances) return false;
  const Bounds bounds = scene_bounds(scene);
  const Ground z = ground_along(scene, boxes, bounds, kZ);
  if (z.standing < kMax || z.floor < kFloor || !are_tall(boxes, bounds)) return false;
  return ground_along(scene, boxes, bounds, kY).standing < kFew;
}

}  // namespace

std::string why_on_its_back(const Scene& scene) {
  // Our own exporter imports other formats into Blender and keeps their axes.
  const bool is_of_blender = scene.generator.find("Blender") != std::string::npos;
  if (is_of_blender && !scene.generator.starts_with("Omnistereo")) return "";
  if (stands_along_z(scene)) return "things in the file stand on a floor with z up";
  return sign_of_z_up(scene);
}

}  // namespace ods
