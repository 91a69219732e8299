// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ods/base/error.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

using glm::dmat4, glm::dvec3, glm::dvec4;
using tinygltf::Node;

namespace {

struct Place {
  dvec3 translation{0.0};
  dvec4 rotation{0.0, 0.0, 0.0, 1.0};
  dvec3 scale{1.0};
};

}  // namespace

static Place read_place(const Node& node) {
  Place place;
  const auto &t = node.translation, &r = node.rotation, &s = node.scale;
  if (t.size() == 3) place.translation = dvec3(t[0], t[1], t[2]);
  if (r.size() == 4) place.rotation = dvec4(r[0], r[1], r[2], r[3]);
  if (s.size() == 3) place.scale = dvec3(s[0], s[1], s[2]);
  return place;
}

static dmat4 local_matrix(const Node& node) {
  if (node.matrix.size() == 16) {
    dmat4 matrix;
    for (int i = 0; i < 16; i++) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
    return matrix;
  }
  const Place place = read_place(node);
  return trs_matrix(place.translation, place.rotation, place.scale);
}

// --- the hierarchy

namespace {

struct Hierarchy {
  std::vector<int> parents;  // -1: a root
  std::vector<int> order;    // every node, parents before their children
};

}  // namespace

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
    if (!is_bounded(world[i])) fail(file, fmt::format("node {} has a matrix that is not finite, or too large", node));
  }
  return world;
}

// The nodes of one scene of the file, in the order of the tree; -1 for its default, or all where it has no scenes.
static std::vector<int> nodes_of_scene(const GltfFile& file, const Hierarchy& tree, int chosen) {
  const std::vector<tinygltf::Scene>& scenes = file.model->scenes;
  const bool is_asked_for = chosen != -1;
  if (!is_asked_for) chosen = std::max(0, file.model->defaultScene);
  if (scenes.empty() && chosen == 0) return tree.order;
  if (chosen < 0 || static_cast<size_t>(chosen) >= scenes.size()) {
    const std::string what = fmt::format("has no scene {}, only {} (counted from 0)", chosen, scenes.size());
    if (is_asked_for) throw Error(ErrorKind::kUsage, fmt::format("--scene: '{}' {}", file.path, what));
    fail(file, what);
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

// --- what moves

// The rows of the file's nodes that move, in Animation::nodes; those below one that moves go with it.
static std::vector<int> read_moving_nodes(const GltfFile& file, const Hierarchy& tree, const std::vector<dmat4>& world,
                                          const std::vector<char>& named, Scene& scene) {
  std::vector<int> rows(tree.order.size(), -1);
  for (const int node : tree.order) {
    const auto i = static_cast<size_t>(node);
    const int parent = tree.parents[i];
    const int parent_row = parent == -1 ? -1 : rows[static_cast<size_t>(parent)];
    if (!named[i] && parent_row == -1) continue;
    MovingNode moving;
    moving.parent = parent_row;
    if (parent != -1 && parent_row == -1) moving.before = world[static_cast<size_t>(parent)];
    const Node& source = file.model->nodes[i];
    if (source.matrix.size() == 16) {
      moving.before *= local_matrix(source);
    } else {
      const Place place = read_place(source);
      moving.translation = place.translation;
      moving.rotation = place.rotation;
      moving.scale = place.scale;
    }
    rows[i] = static_cast<int>(scene.animation.nodes.size());
    scene.animation.nodes.push_back(moving);
  }
  return rows;
}

// --- what stands at a node

namespace {

class Placer {
 public:
  Placer(GltfFile& file, Scene& scene, Places& places)
      : file_(file),
        scene_(scene),
        places_(places),
        meshes_(file.model->meshes.size()),
        skins_(file.model->skins.size()) {}

  void place_meshes(int node, const dmat4& world);
  void place_light(int node, int light, const dmat4& world);
  void place_camera(int node, const dmat4& world);

 private:
  struct LoadedMesh {
    int index;
    Bounds bounds;
    int deformation = -1;
    bool skinned = false;  // stands where its joints are
  };
  using LoadedMeshes = std::vector<LoadedMesh>;

  LoadedMeshes read(int mesh, const Bending& bending);
  const LoadedMeshes& load_mesh(int node);
  Bending bending_of(int node);
  void place(const LoadedMesh& mesh, int row, const dmat4& world, const dmat4& local);
  std::vector<dmat4> instance_matrices(const Node& node);

  GltfFile& file_;
  Scene& scene_;
  Places& places_;
  std::vector<std::optional<LoadedMeshes>> meshes_;
  std::vector<std::optional<int>> skins_;
  LoadedMeshes bent_;
};

}  // namespace

// A row of weights for a node whose mesh has morph targets, and of a skin where it has one.
Bending Placer::bending_of(int index) {
  const Node& node = file_.model->nodes[static_cast<size_t>(index)];
  const tinygltf::Mesh& mesh = element(file_, file_.model->meshes, node.mesh, "mesh");
  Bending bending;
  size_t targets = 0;
  for (const tinygltf::Primitive& primitive : mesh.primitives) targets = std::max(targets, primitive.targets.size());
  if (targets > 0) {
    std::vector<double> weights = node.weights.empty() ? mesh.weights : node.weights;
    weights.resize(targets);
    for (double& weight : weights) weight = std::isfinite(weight) ? weight : 0.0;
    bending.weights = static_cast<int>(scene_.animation.weights.size());
    scene_.animation.weights.push_back(std::move(weights));
    places_.weights[static_cast<size_t>(index)] = bending.weights;
  }
  if (node.skin != -1) {
    auto& row = element(file_, skins_, node.skin, "skin");
    if (!row) row = read_skin(file_, scene_, node.skin, places_.nodes);
    bending.skin = *row;
  }
  return bending;
}

Placer::LoadedMeshes Placer::read(int mesh, const Bending& bending) {
  LoadedMeshes loaded;
  const size_t first = scene_.animation.deformations.size();
  for (const int index : read_mesh(file_, scene_, mesh, bending)) {
    loaded.push_back({index, mesh_bounds(scene_, scene_.meshes[static_cast<size_t>(index)])});
    for (size_t i = first; i < scene_.animation.deformations.size(); i++) {
      const Deformation& deformation = scene_.animation.deformations[i];
      if (deformation.mesh != index) continue;
      loaded.back().deformation = static_cast<int>(i);
      loaded.back().skinned = deformation.skin != -1;
    }
  }
  return loaded;
}

// Meshes that bend are the node's own: each bends in its own way.
const Placer::LoadedMeshes& Placer::load_mesh(int index) {
  const Node& node = file_.model->nodes[static_cast<size_t>(index)];
  const Bending bending = bending_of(index);
  if (bending.weights != -1 || bending.skin != -1) return bent_ = read(node.mesh, bending);
  auto& loaded = element(file_, meshes_, node.mesh, "mesh");
  if (!loaded) loaded = read(node.mesh, bending);
  return *loaded;
}

// row: of the node among those that move, -1: it stands still.
void Placer::place(const LoadedMesh& mesh, int row, const dmat4& world, const dmat4& local) {
  spend(file_, 1);
  const int instance = static_cast<int>(scene_.instances.size());
  if (mesh.deformation != -1 || row != -1) {
    MovingInstance moving{instance, row, mesh.deformation, row == -1 ? world * local : local, {}, {}};
    if (mesh.skinned) moving.node = -1, moving.local = dmat4(1.0);
    moving.low = mesh.bounds.low, moving.high = mesh.bounds.high;
    scene_.animation.instances.push_back(moving);
    add_instance(scene_, mesh.index, glm::mat4(1.0f));
    return;
  }
  const dmat4 matrix = world * local;
  if (!is_bounded(matrix)) fail(file_, "has an instance whose matrix is not finite, or too large");
  if (!is_invertible(matrix)) {
    warn(scene_, "instances that are scaled to nothing are left out");
    return;
  }
  if (!stays_near(matrix, mesh.bounds)) {
    fail(file_, fmt::format("a mesh stands more than {:.0e} m from the origin; the file is damaged", kFarthest));
  }
  add_instance(scene_, mesh.index, glm::mat4(matrix));
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

void Placer::place_meshes(int index, const dmat4& world) {
  const Node& node = file_.model->nodes[static_cast<size_t>(index)];
  if (node.mesh == -1) return;
  const LoadedMeshes& meshes = load_mesh(index);
  if (meshes.empty()) return;
  const int row = places_.nodes[static_cast<size_t>(index)];
  const size_t first = scene_.instances.size();
  for (const dmat4& matrix : instance_matrices(node)) {
    for (const LoadedMesh& mesh : meshes) place(mesh, row, world, matrix);
  }
  if (!node.name.empty()) scene_.objects.push_back({printable(node.name), first, scene_.instances.size() - first});
}

// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_lights_punctual
Lamp read_lamp(const GltfFile& file, int index) {
  const tinygltf::Light& source = element(file, file.model->lights, index, "light");
  Lamp lamp;
  if (source.color.size() == 3) lamp.color = dvec3(source.color[0], source.color[1], source.color[2]);
  lamp.intensity = source.intensity;
  lamp.range = source.range;
  lamp.inner_cone = source.spot.innerConeAngle;
  lamp.outer_cone = source.spot.outerConeAngle;
  return lamp;
}

void Placer::place_light(int node, int index, const dmat4& world) {
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
  set_lamp(light, read_lamp(file_, index));
  ods::place_light(light, world);
  places_.lights.push_back({static_cast<int>(scene_.lights.size()), index, node});
  scene_.lights.push_back(light);
}

void Placer::place_camera(int index, const dmat4& world) {
  const Node& node = file_.model->nodes[static_cast<size_t>(index)];
  const std::string& own = element(file_, file_.model->cameras, node.camera, "camera").name;
  ViewPoint view;
  view.name = printable(!node.name.empty() ? node.name : !own.empty() ? own : fmt::format("camera {}", node.camera));
  place_view(view, world);
  const int row = places_.nodes[static_cast<size_t>(index)];
  if (row != -1) scene_.animation.views.push_back({static_cast<int>(scene_.view_points.size()), row});
  scene_.view_points.push_back(view);
}

Places read_nodes(GltfFile& file, Scene& scene, int chosen, const std::vector<char>& moves) {
  const Hierarchy tree = read_hierarchy(file);
  const std::vector<dmat4> world = evaluate_nodes(file, tree);
  Places places;
  places.nodes = read_moving_nodes(file, tree, world, moves, scene);
  places.weights.assign(places.nodes.size(), -1);
  Placer placer(file, scene, places);
  for (const int i : nodes_of_scene(file, tree, chosen)) {
    const Node& node = file.model->nodes[static_cast<size_t>(i)];
    const dmat4& matrix = world[static_cast<size_t>(i)];
    placer.place_meshes(i, matrix);
    if (node.camera != -1) placer.place_camera(i, matrix);
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end()) placer.place_light(i, integer(light->second, "light", -1), matrix);
  }
  return places;
}

}  // namespace ods
