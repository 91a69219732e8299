// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "ods/scene/gltf/parts.h"

namespace ods {

using glm::dmat4, glm::dvec3, glm::dvec4;
using tinygltf::Node;

static bool is_finite(const dmat4& m) {
  for (int column = 0; column < 4; column++) {
    for (int row = 0; row < 4; row++) {
      if (!(std::abs(m[column][row]) <= static_cast<double>(kFarthest))) return false;
    }
  }
  return true;
}

static dvec3 unit(const dvec3& v, const dvec3& fallback) {
  const double size = glm::length(v);
  return std::isfinite(size) && size > 1e-100 ? v / size : fallback;
}

static dmat4 trs_matrix(const dvec3& translation, const dvec4& rotation, const dvec3& scale) {
  const double size = glm::length(rotation);
  const dvec4 q = std::isfinite(size) && size > 1e-100 ? rotation / size : dvec4(0.0, 0.0, 0.0, 1.0);
  dmat4 matrix = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z));
  for (int i = 0; i < 3; i++) matrix[i] *= scale[i];
  matrix[3] = dvec4(translation, 1.0);
  return matrix;
}

static dmat4 local_matrix(const Node& node) {
  if (node.matrix.size() == 16) {
    dmat4 matrix;
    for (int i = 0; i < 16; i++) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
    return matrix;
  }
  dvec3 translation(0.0), scale(1.0);
  dvec4 rotation(0.0, 0.0, 0.0, 1.0);
  if (node.translation.size() == 3) translation = dvec3(node.translation[0], node.translation[1], node.translation[2]);
  if (node.scale.size() == 3) scale = dvec3(node.scale[0], node.scale[1], node.scale[2]);
  if (node.rotation.size() == 4)
    rotation = dvec4(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
  return trs_matrix(translation, rotation, scale);
}

// --- the hierarchy

struct Hierarchy {
  std::vector<int> parents;  // -1: a root
  std::vector<int> order;    // every node, parents before their children
};

static Hierarchy read_hierarchy(const GltfFile& file) {
  const std::vector<Node>& nodes = file.model->nodes;
  Hierarchy tree;
  tree.parents.assign(nodes.size(), -1);
  for (size_t i = 0; i < nodes.size(); i++) {
    for (const int child : nodes[i].children) {
      element(file, nodes, child, "node");
      int& parent = tree.parents[static_cast<size_t>(child)];
      if (parent != -1)
        fail(file, fmt::format("node {} is the child of both {} and {}; the file is damaged", child, parent, i));
      parent = static_cast<int>(i);
    }
  }
  for (size_t i = 0; i < nodes.size(); i++) {
    if (tree.parents[i] == -1) tree.order.push_back(static_cast<int>(i));
  }
  for (size_t i = 0; i < tree.order.size(); i++) {
    for (const int child : nodes[static_cast<size_t>(tree.order[i])].children) tree.order.push_back(child);
  }
  if (tree.order.size() < nodes.size()) fail(file, "has nodes that are their own ancestors; the file is damaged");
  return tree;
}

// Where every node stands in the world.
static std::vector<dmat4> evaluate_nodes(const GltfFile& file, const Hierarchy& tree) {
  std::vector<dmat4> world(tree.order.size());
  for (const int node : tree.order) {
    const auto i = static_cast<size_t>(node);
    const int parent = tree.parents[i];
    world[i] = local_matrix(file.model->nodes[i]);
    if (parent != -1) world[i] = world[static_cast<size_t>(parent)] * world[i];
    if (!is_finite(world[i])) fail(file, fmt::format("node {} has a matrix that is not finite, or too large", node));
  }
  return world;
}

// The nodes of one scene of the file, in the order of the tree; -1 for its default, or all where it has no scenes.
static std::vector<int> nodes_of_scene(const GltfFile& file, const Hierarchy& tree, int chosen) {
  const std::vector<tinygltf::Scene>& scenes = file.model->scenes;
  if (chosen == -1) chosen = std::max(0, file.model->defaultScene);
  if (scenes.empty() && chosen == 0) return tree.order;
  if (chosen < 0 || static_cast<size_t>(chosen) >= scenes.size()) {
    fail(file, fmt::format("has no scene {}, only {} (counted from 0)", chosen, scenes.size()));
  }
  std::vector<char> inside(tree.order.size(), 0);
  for (const int root : scenes[static_cast<size_t>(chosen)].nodes) {
    element(file, file.model->nodes, root, "node");
    if (tree.parents[static_cast<size_t>(root)] != -1) {
      fail(file, fmt::format("node {} is a root of the scene and has a parent; the file is damaged", root));
    }
    inside[static_cast<size_t>(root)] = 1;
  }
  std::vector<int> nodes;
  for (const int node : tree.order) {
    const int parent = tree.parents[static_cast<size_t>(node)];
    if (parent != -1) inside[static_cast<size_t>(node)] = inside[static_cast<size_t>(parent)];
    if (inside[static_cast<size_t>(node)]) nodes.push_back(node);
  }
  return nodes;
}

// --- what stands at a node

class Placer {
 public:
  Placer(GltfFile& file, Scene& scene) : file_(file), scene_(scene), meshes_(file.model->meshes.size()) {}

  void place_meshes(const Node& node, const dmat4& world);
  void place_light(int light, const dmat4& world);
  void place_camera(const Node& node, const dmat4& world);

 private:
  struct LoadedMesh {
    int index;
    Bounds bounds;
  };

  const std::vector<LoadedMesh>& load_mesh(int mesh);
  void place(const std::vector<LoadedMesh>& meshes, const dmat4& world);
  std::vector<dmat4> instance_matrices(const Node& node);

  GltfFile& file_;
  Scene& scene_;
  std::vector<std::optional<std::vector<LoadedMesh>>> meshes_;
};

const std::vector<Placer::LoadedMesh>& Placer::load_mesh(int mesh) {
  static const std::vector<LoadedMesh> kNone;
  if (mesh == -1) return kNone;
  auto& loaded = element(file_, meshes_, mesh, "mesh");
  if (loaded) return *loaded;
  loaded.emplace();
  for (const int index : read_mesh(file_, scene_, mesh)) {
    const Mesh& record = scene_.meshes[static_cast<size_t>(index)];
    Bounds bounds{scene_.vertices[record.first_vertex].position, scene_.vertices[record.first_vertex].position};
    for (uint i = 0; i < record.vertex_count; i++) {
      bounds.low = min(bounds.low, scene_.vertices[record.first_vertex + i].position);
      bounds.high = max(bounds.high, scene_.vertices[record.first_vertex + i].position);
    }
    loaded->push_back({index, bounds});
  }
  return *loaded;
}

// Whether the three axes span a volume, however small.
static bool is_invertible(const dmat4& m) {
  const dvec3 x(m[0]), y(m[1]), z(m[2]);
  const double sizes = glm::length(x) * glm::length(y) * glm::length(z);
  return sizes > 1e-24 && std::abs(glm::dot(x, glm::cross(y, z))) > 1e-7 * sizes;
}

void Placer::place(const std::vector<LoadedMesh>& meshes, const dmat4& world) {
  if (!is_invertible(world)) {
    warn(scene_, "instances that are scaled to nothing are left out");
    return;
  }
  spend(file_, meshes.size());
  for (const LoadedMesh& mesh : meshes) {
    for (int corner = 0; corner < 8; corner++) {
      const vec3 low = mesh.bounds.low, high = mesh.bounds.high;
      const dvec4 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z, 1.0);
      const dvec3 q = glm::abs(dvec3(world * p));
      if (!(std::max({q.x, q.y, q.z}) <= static_cast<double>(kFarthest))) {
        fail(file_, fmt::format("a mesh stands more than {:.0e} m from the origin; the file is damaged", kFarthest));
      }
    }
    add_instance(scene_, mesh.index, glm::mat4(world));
  }
}

// EXT_mesh_gpu_instancing: many places for the node's mesh, relative to the node.
std::vector<dmat4> Placer::instance_matrices(const Node& node) {
  const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
  if (found == node.extensions.end()) return {dmat4(1.0)};
  const tinygltf::Value& attributes = object(found->second, "attributes");
  const AccessorView translations = open_accessor(file_, integer(attributes, "TRANSLATION", -1));
  const AccessorView rotations = open_accessor(file_, integer(attributes, "ROTATION", -1));
  const AccessorView scales = open_accessor(file_, integer(attributes, "SCALE", -1));
  const size_t count = std::max({translations.count, rotations.count, scales.count});
  for (const AccessorView* attribute : {&translations, &rotations, &scales}) {
    if (attribute->count != 0 &&
        (attribute->count != count || attribute->components < (attribute == &rotations ? 4 : 3))) {
      fail(file_, "has EXT_mesh_gpu_instancing attributes that do not fit each other; the file is damaged");
    }
  }
  spend(file_, count);
  std::vector<dmat4> matrices(count);
  for (size_t i = 0; i < count; i++) {
    const dvec3 translation = translations.count == 0 ? dvec3(0.0) : dvec3(translations.at(i));
    const dvec4 rotation = rotations.count == 0 ? dvec4(0.0, 0.0, 0.0, 1.0) : dvec4(rotations.at(i));
    const dvec3 scale = scales.count == 0 ? dvec3(1.0) : dvec3(scales.at(i));
    matrices[i] = trs_matrix(translation, rotation, scale);
  }
  return matrices;
}

void Placer::place_meshes(const Node& node, const dmat4& world) {
  const std::vector<LoadedMesh>& meshes = load_mesh(node.mesh);
  if (meshes.empty()) return;
  for (const dmat4& matrix : instance_matrices(node)) {
    const dmat4 placed = world * matrix;
    if (!is_finite(placed)) fail(file_, "has an instance whose matrix is not finite, or too large");
    place(meshes, placed);
  }
}

static float finite_or(double value, float fallback) {
  return std::isfinite(value) ? static_cast<float>(std::clamp(value, -1e15, 1e15)) : fallback;
}

// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_lights_punctual
void Placer::place_light(int index, const dmat4& world) {
  const tinygltf::Light& source = element(file_, file_.model->lights, index, "light");
  PunctualLight light;
  if (source.type == "point") {
    light.kind = kLightPoint;
  } else if (source.type == "spot") {
    light.kind = kLightSpot;
  } else if (source.type == "directional") {
    light.kind = kLightDirectional;
  } else {
    warn(scene_, fmt::format("lights of type {} are ignored", printable(source.type)));
    return;
  }
  light.position = vec3(world[3]);
  light.direction = vec3(unit(-dvec3(world[2]), dvec3(0.0, 0.0, -1.0)));
  for (int c = 0; c < 3; c++) {
    const double color = source.color.size() == 3 ? source.color[static_cast<size_t>(c)] : 1.0;
    light.intensity[c] = std::max(0.0f, finite_or(color * source.intensity, 0.0f));
  }
  light.range = std::max(0.0f, finite_or(source.range, 0.0f));
  light.outer_cone = std::clamp(finite_or(source.spot.outerConeAngle, 0.7853982f), 1e-3f, 1.5707963f);
  light.inner_cone = std::clamp(finite_or(source.spot.innerConeAngle, 0.0f), 0.0f, light.outer_cone);
  scene_.lights.push_back(light);
}

void Placer::place_camera(const Node& node, const dmat4& world) {
  const std::string& own = element(file_, file_.model->cameras, node.camera, "camera").name;
  ViewPoint view;
  view.name = printable(!node.name.empty() ? node.name : !own.empty() ? own : fmt::format("camera {}", node.camera));
  view.position = vec3(world[3]);
  const dvec3 forward = unit(-dvec3(world[2]), dvec3(0.0, 0.0, -1.0));
  // A scaled parent may have sheared the axes: up is what is left of it across the line of sight.
  const dvec3 up(world[1]);
  const dvec3 any_across = std::abs(forward.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(0.0, 0.0, 1.0);
  const dvec3 fallback = unit(any_across - forward * glm::dot(forward, any_across), any_across);
  const ViewAngles angles = view_angles(forward, unit(up - forward * glm::dot(forward, up), fallback));
  view.yaw = angles.yaw;
  view.pitch = angles.pitch;
  view.roll = angles.roll;
  scene_.view_points.push_back(view);
}

void read_nodes(GltfFile& file, Scene& scene, int chosen) {
  const Hierarchy tree = read_hierarchy(file);
  const std::vector<dmat4> world = evaluate_nodes(file, tree);
  Placer placer(file, scene);
  for (const int i : nodes_of_scene(file, tree, chosen)) {
    const Node& node = file.model->nodes[static_cast<size_t>(i)];
    const dmat4& matrix = world[static_cast<size_t>(i)];
    placer.place_meshes(node, matrix);
    if (node.camera != -1) placer.place_camera(node, matrix);
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end()) placer.place_light(integer(light->second, "light", -1), matrix);
  }
}

}  // namespace ods
