// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "ods/base/unit_vector.h"

namespace ods {

using glm::dmat4, glm::dvec3, glm::dvec4;

dmat4 trs_matrix(const dvec3& translation, const dvec4& rotation, const dvec3& scale) {
  const double size = glm::length(rotation);
  const dvec4 q = std::isfinite(size) && size > 1e-100 ? rotation / size : dvec4(0.0, 0.0, 0.0, 1.0);
  dmat4 matrix = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z));
  for (int i = 0; i < 3; i++) matrix[i] *= scale[i];
  matrix[3] = dvec4(translation, 1.0);
  return matrix;
}

bool is_bounded(const dmat4& m) {
  for (int column = 0; column < 4; column++) {
    for (int row = 0; row < 4; row++) {
      if (!(std::abs(m[column][row]) <= static_cast<double>(kFarthest))) return false;  // also for NaN
    }
  }
  return true;
}

bool is_invertible(const dmat4& m) {
  const dvec3 x(m[0]), y(m[1]), z(m[2]);
  const double sizes = glm::length(x) * glm::length(y) * glm::length(z);
  return sizes > 1e-24 && std::abs(glm::dot(x, glm::cross(y, z))) > 1e-7 * sizes;
}

bool stays_near(const dmat4& matrix, const Bounds& box) {
  for (int corner = 0; corner < 8; corner++) {
    const vec3 low = box.low, high = box.high;
    const dvec4 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z, 1.0);
    const dvec3 q = glm::abs(dvec3(matrix * p));
    if (!(std::max({q.x, q.y, q.z}) <= static_cast<double>(kFarthest))) return false;
  }
  return true;
}

Bounds mesh_bounds(const Scene& scene, const Mesh& mesh) {
  Bounds bounds;
  if (mesh.vertex_count == 0) return bounds;
  bounds.low = bounds.high = scene.vertices[mesh.first_vertex].position;
  for (uint i = 0; i < mesh.vertex_count; i++) {
    bounds.low = min(bounds.low, scene.vertices[mesh.first_vertex + i].position);
    bounds.high = max(bounds.high, scene.vertices[mesh.first_vertex + i].position);
  }
  return bounds;
}

vec3 far_middle(const Bounds& box) {
  const vec3 middle = glm::round(0.5f * (box.low + box.high)), half = 0.5f * (box.high - box.low);
  const float distance = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
  const bool is_far = distance > kFirmReach && distance > 8.0f * std::max({half.x, half.y, half.z});
  return is_far ? middle : vec3(0.0f);
}

vec3 far_middle(const Scene& scene) {
  return far_middle(scene_bounds(scene));
}

std::string reach_warning(const Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  const vec3 corner = max(abs(bounds.low), abs(bounds.high));
  const float reach = std::max({corner.x, corner.y, corner.z});
  if (reach <= kFirmReach) return "";
  return fmt::format(
      "the scene extends {:.3g} km from the origin, where light leaks through walls thinner than {:.2g} m; move it "
      "nearer",
      reach * 1e-3f, reach * kThinnestWall);
}

void set_matrix(Instance& instance, const dmat4& object_to_world) {
  const glm::mat4 rows = glm::transpose(glm::mat4(object_to_world));
  instance.row0 = rows[0];
  instance.row1 = rows[1];
  instance.row2 = rows[2];
}

static float bounded(double value, float fallback) {
  return std::isfinite(value) ? static_cast<float>(std::clamp(value, -1e15, 1e15)) : fallback;
}

void set_light(PunctualLight& light, const Lamp& lamp) {
  for (int c = 0; c < 3; c++) light.intensity[c] = std::max(0.0f, bounded(lamp.color[c] * lamp.intensity, 0.0f));
  light.range = std::max(0.0f, bounded(lamp.range, 0.0f));
  light.outer_cone = std::clamp(bounded(lamp.outer_cone, 0.7853982f), 1e-3f, 1.5707963f);
  light.inner_cone = std::clamp(bounded(lamp.inner_cone, 0.0f), 0.0f, light.outer_cone);
}

void place_light(PunctualLight& light, const dmat4& node) {
  light.position = vec3(node[3]);
  light.direction = vec3(unit(-dvec3(node[2]), dvec3(0.0, 0.0, -1.0)));
}

void place_view(ViewPoint& view, const dmat4& node) {
  view.position = vec3(node[3]);
  const dvec3 forward = unit(-dvec3(node[2]), dvec3(0.0, 0.0, -1.0));
  // A scaled parent may have sheared the axes: up is made perpendicular to the line of sight.
  const dvec3 up(node[1]);
  const dvec3 any_across = std::abs(forward.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(0.0, 0.0, 1.0);
  const dvec3 fallback = unit(any_across - forward * glm::dot(forward, any_across), any_across);
  const ViewAngles angles = view_angles(forward, unit(up - forward * glm::dot(forward, up), fallback));
  view.yaw = angles.yaw + 0.0f;  // avoids -0
  view.pitch = angles.pitch;
  view.roll = angles.roll;
}

void place_texture(TextureSlot& slot, const UvPlace& place) {
  const double c = std::cos(place.rotation), s = std::sin(place.rotation);
  const auto legal = [](double value) {
    const double limit = static_cast<double>(kLargestUv);
    return static_cast<float>(std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0);
  };
  slot.offset = vec2(legal(place.offset.x), legal(place.offset.y));
  slot.axis_u = vec2(legal(c * place.scale.x), legal(-s * place.scale.x));
  slot.axis_v = vec2(legal(s * place.scale.y), legal(c * place.scale.y));
}

}  // namespace ods
