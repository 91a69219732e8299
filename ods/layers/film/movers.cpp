// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/movers.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>

#include "ods/kernel/surface.h"
#include "ods/scene/motion.h"

namespace ods {

namespace {

using glm::dmat3, glm::dmat4, glm::dvec3, glm::dvec4;

constexpr double kStill = 1e-4;      // metres
constexpr double kUnsheared = 1e-3;  // cosine between axes

// An instance during the film.
struct Course {
  bool moves = false, deforms = false;
  std::vector<dmat4> matrices;  // by frame
  std::vector<char> shown;
};

// The mesh's corners of an instance at the first frame in which it is visible.
struct Look {
  size_t frame = 0;
  dvec3 low{0.0}, high{0.0};
  std::vector<vec3> vertices;  // of meshes that deform
  Material material{};
  MaterialLayers layers{};
};

std::set<int> deforming_meshes(const Scene& scene) {
  std::set<int> meshes;
  for (const Deformation& deformation : scene.animation.deformations) meshes.insert(deformation.mesh);
  return meshes;
}

Look look_at(const Scene& scene, const Instance& instance, size_t frame, bool keeps_vertices) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  Look look;
  look.frame = frame;
  look.low = dvec3(1e30), look.high = dvec3(-1e30);
  for (uint v = 0; v < mesh.vertex_count; v++) {
    const vec3 position = scene.vertices[mesh.first_vertex + v].position;
    look.low = min(look.low, dvec3(position)), look.high = max(look.high, dvec3(position));
    if (keeps_vertices) look.vertices.push_back(position);
  }
  look.material = scene.materials[static_cast<size_t>(mesh.material)];
  if (look.material.layers >= 0) look.layers = scene.material_layers[static_cast<size_t>(look.material.layers)];
  return look;
}

bool changes_material(const Scene& scene, const Instance& instance, const Look& look) {
  const Material& now = scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)];
  if (std::memcmp(&now, &look.material, sizeof now) != 0) return true;
  return now.layers >= 0 &&
         std::memcmp(&scene.material_layers[static_cast<size_t>(now.layers)], &look.layers, sizeof look.layers) != 0;
}

bool changes_shape(const Scene& scene, const Instance& instance, const Look& look, const dmat4& matrix) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  for (size_t v = 0; v < look.vertices.size(); v++) {
    const dvec3 by = scene.vertices[mesh.first_vertex + v].position - look.vertices[v];
    if (glm::length(dmat3(matrix) * by) > kStill) return true;
  }
  return false;
}

dvec3 corner_of(const Look& look, int i) {
  return {i & 1 ? look.high.x : look.low.x, i & 2 ? look.high.y : look.low.y, i & 4 ? look.high.z : look.low.z};
}

bool changes_place(const Look& look, const dmat4& from, const dmat4& to) {
  for (int i = 0; i < 8; i++) {
    const dvec4 corner(corner_of(look, i), 1.0);
    if (glm::length(dvec3(to * corner) - dvec3(from * corner)) > kStill) return true;
  }
  return false;
}

// The pose of a matrix relative to one of the reference. Returns false if it is sheared or mirrored.
bool pose_of(const dmat4& reference, const dmat4& now, const dvec3& middle, LayerPose& pose) {
  const dmat3 turn = dmat3(now) * glm::inverse(dmat3(reference));
  const dvec3 scale(glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2]));
  const dmat3 axes(turn[0] / scale.x, turn[1] / scale.y, turn[2] / scale.z);
  for (int i = 0; i < 3; i++) {
    if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kUnsheared) return false;
  }
  if (glm::determinant(axes) < 0.0) return false;
  const glm::dquat rotation = glm::normalize(glm::quat_cast(axes));
  pose.place = vec3(dvec3(now * dvec4(middle, 1.0)));
  pose.rotation = vec4(dvec4(rotation.x, rotation.y, rotation.z, rotation.w));
  pose.scale = vec3(scale);
  return true;
}

Mover mover_of(int instance, const Course& course, const Look& look) {
  Mover mover;
  mover.instances = {instance};
  mover.reference = look.frame;
  mover.deforms = course.deforms;
  const dvec3 middle = 0.5 * (look.low + look.high);
  const dmat4& reference = course.matrices[look.frame];
  mover.origin = vec3(dvec3(reference * dvec4(middle, 1.0)));
  for (size_t frame = 0; frame < course.matrices.size(); frame++) {
    LayerPose pose;
    pose.place = mover.origin;
    pose.shown = course.shown[frame] != 0;
    if (pose.shown && !pose_of(reference, course.matrices[frame], middle, pose)) mover.deforms = true;
    mover.poses.push_back(pose);
  }
  if (!mover.deforms) return mover;
  for (LayerPose& pose : mover.poses) pose = {mover.origin, vec4(0, 0, 0, 1), vec3(1.0f), pose.shown};
  return mover;
}

vec3 turned(vec4 q, vec3 v) {
  return vec3(glm::quat(q.w, q.x, q.y, q.z) * glm::vec3(v));
}

// Returns whether both move as one rigid thing.
bool moves_alike(const Mover& a, const Mover& b) {
  if (a.deforms || b.deforms || a.reference != b.reference) return false;
  const vec3 apart = b.origin - a.origin;
  for (size_t frame = 0; frame < a.poses.size(); frame++) {
    const LayerPose &one = a.poses[frame], &other = b.poses[frame];
    if (one.shown != other.shown) return false;
    if (!one.shown) continue;
    const vec3 expected = one.place + turned(one.rotation, one.scale * apart);
    if (length(expected - other.place) > kStill || length(one.scale - other.scale) > 1e-4f) return false;
    if (abs(dot(one.rotation, other.rotation)) < 1.0f - 1e-7f) return false;
  }
  return true;
}

// The next quaternion is the nearer one of the two that turn alike, as linear interpolation needs it, and what is
// hidden waits where it was, or where it will be.
void make_continuous(std::vector<LayerPose>& poses, size_t first_shown) {
  LayerPose last = poses[first_shown];
  for (LayerPose& pose : poses) {
    if (pose.shown) last = pose;
    const bool shown = pose.shown;
    pose = last;
    pose.shown = shown;
  }
  for (size_t i = 1; i < poses.size(); i++) {
    if (dot(poses[i].rotation, poses[i - 1].rotation) < 0.0f) poses[i].rotation = -poses[i].rotation;
  }
}

// Notes an instance at the present frame.
void follow(const Scene& scene, size_t index, size_t frame, bool bends, Course& course, std::map<size_t, Look>& looks) {
  const Instance& instance = scene.instances[index];
  const bool shown = !is_hidden(scene, index);
  course.matrices.push_back(matrix_of(instance));
  course.shown.push_back(shown ? 1 : 0);
  course.moves |= course.shown.front() != course.shown.back();
  if (!shown) return;
  const auto [found, is_new] = looks.try_emplace(index);
  if (is_new) {
    found->second = look_at(scene, instance, frame, bends);
    return;
  }
  const Look& look = found->second;
  const bool changes = changes_shape(scene, instance, look, course.matrices.back());
  course.deforms |= changes;
  course.moves |= changes || changes_place(look, course.matrices[look.frame], course.matrices.back()) ||
                  changes_material(scene, instance, look);
}

}  // namespace

glm::dmat4 matrix_of(const Instance& instance) {
  return glm::transpose(dmat4(dvec4(instance.row0), dvec4(instance.row1), dvec4(instance.row2), dvec4(0, 0, 0, 1)));
}

std::vector<Mover> find_movers(Scene& scene, std::span<const double> times) {
  const std::set<int> bending = deforming_meshes(scene);
  std::vector<Course> courses(scene.instances.size());
  std::map<size_t, Look> looks;
  for (size_t frame = 0; frame < times.size(); frame++) {
    set_time(scene, times[frame]);
    for (size_t i = 0; i < courses.size(); i++) {
      follow(scene, i, frame, bending.contains(scene.instances[i].mesh), courses[i], looks);
    }
  }
  set_time(scene, times.front());
  std::vector<Mover> movers;
  for (size_t i = 0; i < courses.size(); i++) {
    if (!courses[i].moves || !looks.contains(i)) continue;
    Mover mover = mover_of(static_cast<int>(i), courses[i], looks.at(i));
    const auto like = std::ranges::find_if(movers, [&](const Mover& other) { return moves_alike(other, mover); });
    if (like == movers.end()) {
      movers.push_back(std::move(mover));
    } else {
      like->instances.push_back(static_cast<int>(i));
    }
  }
  for (Mover& mover : movers) make_continuous(mover.poses, mover.reference);
  return movers;
}

HiddenMovers hide_movers(Scene& scene, const std::vector<Mover>& movers, bool lamps_remain) {
  HiddenMovers before{scene.animation.instances, scene.hidden};
  scene.hidden.resize(scene.instances.size());
  for (const Mover& mover : movers) {
    for (const int instance : mover.instances) {
      const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[static_cast<size_t>(instance)].mesh)];
      if (lamps_remain && is_emissive(scene.materials[static_cast<size_t>(mesh.material)])) continue;
      scene.hidden[static_cast<size_t>(instance)] = 1;
      std::erase_if(scene.animation.instances,
                    [&](const MovingInstance& moving) { return moving.instance == instance; });
    }
  }
  return before;
}

void show_movers(Scene& scene, HiddenMovers hidden) {
  scene.animation.instances = std::move(hidden.instances);
  scene.hidden = std::move(hidden.hidden);
}

}  // namespace ods
