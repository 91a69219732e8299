// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/nodes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ods/base/error.h"
#include "ods/base/memory.h"

namespace ods {

using glm::dmat4, glm::dvec3, glm::dvec4;

namespace {

struct Place {
  dvec3 translation{0.0};
  dvec4 rotation{0.0, 0.0, 0.0, 1.0};
  dvec3 scale{1.0};
};

}  // namespace

static Place read_place(const JsonValue& node) {
  const std::vector<double> t = numbers(node, "translation", {0.0, 0.0, 0.0}),
                            s = numbers(node, "scale", {1.0, 1.0, 1.0}),
                            r = numbers(node, "rotation", {0.0, 0.0, 0.0, 1.0});
  return {{t[0], t[1], t[2]}, {r[0], r[1], r[2], r[3]}, {s[0], s[1], s[2]}};
}

static bool has_matrix(const JsonValue& node) {
  return node["matrix"].size() == 16;
}

static dmat4 local_matrix(const JsonValue& node) {
  if (has_matrix(node)) {
    const std::vector<double> values = numbers(node, "matrix", std::vector<double>(16, 0.0));
    dmat4 matrix;
    for (int i = 0; i < 16; i++) matrix[i / 4][i % 4] = values[static_cast<size_t>(i)];
    return matrix;
  }
  const Place place = read_place(node);
  return trs_matrix(place.translation, place.rotation, place.scale);
}

// --- the hierarchy

namespace {

struct Hierarchy {
  std::vector<std::vector<int>> children;
  std::vector<int> parents;  // -1 for a root
  std::vector<int> order;    // all nodes, parents before children
};

}  // namespace

static Hierarchy read_hierarchy(const GltfFile& file) {
  const Records& nodes = file.nodes;
  constexpr size_t kBytesPerNode = 256;  // memory needed while reading
  check_memory(nodes.size() * kBytesPerNode, file.path + ": its list of nodes", "use a machine with more");
  Hierarchy tree;
  tree.children.resize(nodes.size());
  tree.parents.assign(nodes.size(), -1);
  for (size_t i = 0; i < nodes.size(); i++) {
    tree.children[i] = indices(file, *nodes[i], "children");
    for (const int child : tree.children[i]) {
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
    for (const int child : tree.children[static_cast<size_t>(tree.order[i])]) tree.order.push_back(child);
  }
  if (tree.order.size() < nodes.size()) fail(file, "has nodes that are their own ancestors; the file is damaged");
  return tree;
}

// The parent transform of every root node: glTF's world has y up.
static dmat4 root_matrix(const SceneOptions& options) {
  const dvec4 origin(-options.origin, 1.0);
  if (!options.z_up) return dmat4(dvec4(1, 0, 0, 0), dvec4(0, 1, 0, 0), dvec4(0, 0, 1, 0), origin);
  return dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), origin);
}

// The world matrix of every node.
static std::vector<dmat4> evaluate_nodes(const GltfFile& file, const Hierarchy& tree, const dmat4& root) {
  std::vector<dmat4> world(tree.order.size());
  for (const int node : tree.order) {
    const auto i = static_cast<size_t>(node);
    const int parent = tree.parents[i];
    world[i] = (parent == -1 ? root : world[static_cast<size_t>(parent)]) * local_matrix(*file.nodes[i]);
    if (!is_bounded(world[i])) fail(file, fmt::format("node {} has a matrix that is not finite, or too large", node));
  }
  return world;
}

// The nodes of one scene, in tree order; -1 for the file's default scene, or all nodes if it has no scenes. Some
// exporters list children among the roots; these are placed by their parents as usual, and only once.
static std::vector<int> nodes_of_scene(const GltfFile& file, const Hierarchy& tree, int chosen, Scene& scene) {
  const Records& scenes = file.scenes;
  const bool is_asked_for = chosen != -1;
  if (!is_asked_for) chosen = std::max(0, index_in(file, file.json.root(), "scene"));
  if (scenes.empty() && chosen == 0) return tree.order;
  if (chosen < 0 || static_cast<size_t>(chosen) >= scenes.size()) {
    const std::string what = fmt::format("has no scene {}, only {} (counted from 0)", chosen, scenes.size());
    if (is_asked_for) throw Error(ErrorKind::kUsage, fmt::format("`scene`: '{}' {}", file.path, what));
    fail(file, what);
  }
  std::vector<char> inside(tree.order.size(), 0);
  for (const int root : indices(file, *scenes[static_cast<size_t>(chosen)], "nodes")) {
    element(file, file.nodes, root, "node");
    if (tree.parents[static_cast<size_t>(root)] != -1) {
      warn(scene, "the file lists nodes as roots of the scene that have a parent: their parents place them");
    }
    inside[static_cast<size_t>(root)] = 1;
  }
  std::vector<int> nodes;
  for (const int node : tree.order) {
    const int parent = tree.parents[static_cast<size_t>(node)];
    if (parent != -1 && inside[static_cast<size_t>(parent)]) inside[static_cast<size_t>(node)] = 1;
    if (inside[static_cast<size_t>(node)]) nodes.push_back(node);
  }
  return nodes;
}

// --- hidden nodes

// KHR_node_visibility.
static bool starts_visible(const JsonValue& node) {
  return extension(node, "KHR_node_visibility")["visible"].kind != JsonValue::Kind::kFalse;
}

// For each node, whether it or an ancestor is always hidden.
static std::vector<char> find_hidden(const GltfFile& file, const Hierarchy& tree, const std::vector<char>& blinks) {
  std::vector<char> hidden(tree.order.size(), 0);
  for (const int node : tree.order) {
    const auto i = static_cast<size_t>(node);
    const int parent = tree.parents[i];
    const bool below = parent != -1 && hidden[static_cast<size_t>(parent)] != 0;
    hidden[i] = below || (!starts_visible(*file.nodes[i]) && blinks[i] == 0) ? 1 : 0;
  }
  return hidden;
}

// --- moving nodes

// Adds the file's moving nodes to Animation::nodes, including all descendants of a moving one.
static std::vector<int> read_moving_nodes(const GltfFile& file, const Hierarchy& tree, const std::vector<dmat4>& world,
                                          const std::vector<char>& named, const dmat4& root, Scene& scene) {
  std::vector<int> rows(tree.order.size(), -1);
  for (const int node : tree.order) {
    const auto i = static_cast<size_t>(node);
    const int parent = tree.parents[i];
    const int parent_row = parent == -1 ? -1 : rows[static_cast<size_t>(parent)];
    if (!named[i] && parent_row == -1) continue;
    MovingNode moving;
    moving.parent = parent_row;
    moving.visible = starts_visible(*file.nodes[i]);
    if (parent_row == -1) moving.before = parent == -1 ? root : world[static_cast<size_t>(parent)];
    const JsonValue& source = *file.nodes[i];
    if (has_matrix(source)) {
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

// --- objects at a node

namespace {

class Placer {
 public:
  Placer(GltfFile& file, Scene& scene, Places& places)
      : file_(file), scene_(scene), places_(places), meshes_(file.meshes.size()), skins_(file.skins.size()) {}

  void place_meshes(int node, const dmat4& world);
  void place_light(int node, int light, const dmat4& world);
  void place_camera(int node, const dmat4& world);

 private:
  struct LoadedMesh {
    int index;
    Bounds bounds;
    dvec3 middle{0.0};  // subtracted from its vertices
    int deformation = -1;
    bool skinned = false;  // placed by its joints
  };
  using LoadedMeshes = std::vector<LoadedMesh>;

  void center(LoadedMesh& mesh);
  LoadedMeshes read(int mesh, const Deformers& bending);
  const LoadedMeshes& load_mesh(int node);
  Deformers bending_of(int node);
  void place(const LoadedMesh& mesh, int row, const dmat4& world, const dmat4& at);
  std::vector<dmat4> instance_matrices(const JsonValue& node);
  void set_role(const JsonValue& node, size_t first);

  GltfFile& file_;
  Scene& scene_;
  Places& places_;
  std::vector<std::optional<LoadedMeshes>> meshes_;
  std::vector<std::optional<int>> skins_;
  LoadedMeshes bent_;
};

}  // namespace

// The node's weights, if its mesh has morph targets, and its skin.
Deformers Placer::bending_of(int index) {
  const JsonValue& node = *file_.nodes[static_cast<size_t>(index)];
  const JsonValue& mesh = record(file_, file_.meshes, index_in(file_, node, "mesh"), "mesh");
  Deformers bending;
  size_t targets = 0;
  for (const JsonValue& primitive : mesh["primitives"]) {
    spend(file_, 1);  // many nodes may share a mesh of many primitives
    targets = std::max(targets, primitive["targets"].size());
  }
  if (targets > 0) {
    spend(file_, targets);
    std::vector<double> weights;
    for (const JsonValue& weight : (node["weights"].size() > 0 ? node : mesh)["weights"])
      weights.push_back(weight.number);
    weights.resize(targets);
    bending.weights = static_cast<int>(scene_.animation.weights.size());
    scene_.animation.weights.push_back(std::move(weights));
    places_.weights[static_cast<size_t>(index)] = bending.weights;
  }
  const int skin = index_in(file_, node, "skin");
  if (skin != -1) {
    auto& row = element(file_, skins_, skin, "skin");
    if (!row) row = read_skin(file_, scene_, skin, places_.nodes);
    bending.skin = *row;
  }
  return bending;
}

// Moves the vertices of a mesh that is far from its own origin to it, so that its matrix can move them back in double
// precision, together with its node's.
void Placer::center(LoadedMesh& mesh) {
  const vec3 middle = far_middle(mesh.bounds);
  if (middle == vec3(0.0f)) return;
  const Mesh& record = scene_.meshes[static_cast<size_t>(mesh.index)];
  for (uint i = 0; i < record.vertex_count; i++) scene_.vertices[record.first_vertex + i].position -= middle;
  mesh.bounds = mesh_bounds(scene_, record);
  mesh.middle = dvec3(middle);
}

Placer::LoadedMeshes Placer::read(int mesh, const Deformers& bending) {
  LoadedMeshes loaded;
  const size_t first = scene_.animation.deformations.size();
  for (const int index : read_mesh(file_, scene_, mesh, bending)) {
    loaded.push_back({index, mesh_bounds(scene_, scene_.meshes[static_cast<size_t>(index)])});
    if (bending.weights == -1 && bending.skin == -1) center(loaded.back());
    for (size_t i = first; i < scene_.animation.deformations.size(); i++) {
      const Deformation& deformation = scene_.animation.deformations[i];
      if (deformation.mesh != index) continue;
      loaded.back().deformation = static_cast<int>(i);
      loaded.back().skinned = deformation.skin != -1;
    }
  }
  return loaded;
}

// A deforming mesh cannot be shared, because each node deforms it differently.
const Placer::LoadedMeshes& Placer::load_mesh(int index) {
  const int mesh = index_in(file_, *file_.nodes[static_cast<size_t>(index)], "mesh");
  const Deformers bending = bending_of(index);
  if (bending.weights != -1 || bending.skin != -1) return bent_ = read(mesh, bending);
  auto& loaded = element(file_, meshes_, mesh, "mesh");
  if (!loaded) loaded = read(mesh, bending);
  return *loaded;
}

// row: the node's index in Animation::nodes; -1 if static.
void Placer::place(const LoadedMesh& mesh, int row, const dmat4& world, const dmat4& at) {
  spend(file_, 1);
  const dmat4 local = at * trs_matrix(mesh.middle, dvec4(0.0, 0.0, 0.0, 1.0), dvec3(1.0));
  const int instance = static_cast<int>(scene_.instances.size());
  if (mesh.deformation != -1 || row != -1) {
    MovingInstance moving{instance, row, mesh.deformation, row == -1 ? world * local : local, {}, {}, row};
    if (mesh.skinned) moving.node = -1, moving.local = dmat4(1.0);
    moving.low = mesh.bounds.low, moving.high = mesh.bounds.high;
    scene_.animation.instances.push_back(moving);
    add_instance(scene_, mesh.index, glm::mat4(1.0f));
    return;
  }
  const dmat4 matrix = world * local;
  if (!is_bounded(matrix)) fail(file_, "has an instance whose matrix is not finite, or too large");
  if (!is_invertible(matrix)) {
    warn(scene_, "instances scaled to zero are left out");
    return;
  }
  if (!stays_near(matrix, mesh.bounds)) {
    fail(file_, fmt::format("a mesh is more than {:.0e} m from the origin; the file is damaged", kFarthest));
  }
  add_instance(scene_, mesh.index, glm::mat4(matrix));
}

// EXT_mesh_gpu_instancing: many transforms of the node's mesh, relative to the node.
std::vector<dmat4> Placer::instance_matrices(const JsonValue& node) {
  const JsonValue& instancing = extension(node, "EXT_mesh_gpu_instancing");
  if (instancing.is_null()) return {dmat4(1.0)};
  const JsonValue& attributes = instancing["attributes"];
  const AccessorView translations = open_accessor(file_, index_in(file_, attributes, "TRANSLATION"));
  const AccessorView rotations = open_accessor(file_, index_in(file_, attributes, "ROTATION"));
  const AccessorView scales = open_accessor(file_, index_in(file_, attributes, "SCALE"));
  const size_t count = std::max({translations.count, rotations.count, scales.count});
  for (const AccessorView* attribute : {&translations, &rotations, &scales}) {
    if (attribute->count != 0 &&
        (attribute->count != count || attribute->components < (attribute == &rotations ? 4 : 3))) {
      fail(file_, "has EXT_mesh_gpu_instancing attributes of different lengths; the file is damaged");
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

// ODS_unseen (docs/scenes.md), for the instances from `first` on.
void Placer::set_role(const JsonValue& node, size_t first) {
  const JsonValue& unseen = extension(node, "ODS_unseen");
  if (unseen.is_null()) return;
  for (size_t i = first; i < scene_.instances.size(); i++) {
    scene_.instances[i].role = unseen["onlyLight"].is_true() ? kPureLight : kUnseen;
  }
}

void Placer::place_meshes(int index, const dmat4& world) {
  const JsonValue& node = *file_.nodes[static_cast<size_t>(index)];
  if (index_in(file_, node, "mesh") == -1) return;
  const LoadedMeshes& meshes = load_mesh(index);
  if (meshes.empty()) return;
  const int row = places_.nodes[static_cast<size_t>(index)];
  const size_t first = scene_.instances.size();
  for (const dmat4& matrix : instance_matrices(node)) {
    for (const LoadedMesh& mesh : meshes) place(mesh, row, world, matrix);
  }
  set_role(node, first);
  const std::string& name = *node["name"].text;
  if (!name.empty()) scene_.objects.push_back({printable(name), first, scene_.instances.size() - first});
}

// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_lights_punctual
Lamp read_lamp(const GltfFile& file, int index) {
  const JsonValue& source = record(file, file.lights, index, "light");
  const std::vector<double> color = numbers(source, "color", {1.0, 1.0, 1.0});
  Lamp lamp;
  lamp.color = dvec3(color[0], color[1], color[2]);
  lamp.intensity = number(source, "intensity", lamp.intensity);
  lamp.range = number(source, "range", lamp.range);
  lamp.inner_cone = number(source["spot"], "innerConeAngle", lamp.inner_cone);
  lamp.outer_cone = number(source["spot"], "outerConeAngle", lamp.outer_cone);
  return lamp;
}

// ODS_light_shape (docs/scenes.md). Sizes are in the scene's unit, before the node scales them.
static void read_light_shape(const JsonValue& source, PunctualLight& light) {
  const JsonValue& shape = extension(source, "ODS_light_shape");
  const bool sun = light.kind == kLightDirectional;
  const double size = sun ? 0.5 * number(shape, "angle", 0.0) : number(shape, "radius", 0.0);
  light.size = static_cast<float>(std::clamp(size, 0.0, sun ? 1.5 : double{kFarthest}));
  const std::string& cone = *shape["cone"].text;
  if (cone == "smooth") light.cone = kConeSmooth;
  if (cone == "smooth cosine") light.cone = kConeSmoothCosine;
}

void Placer::place_light(int node, int index, const dmat4& world) {
  const JsonValue& source = record(file_, file_.lights, index, "light");
  const std::string& type = *source["type"].text;
  PunctualLight light;
  if (type == "point") {
    light.kind = kLightPoint;
  } else if (type == "spot") {
    light.kind = kLightSpot;
  } else if (type == "directional") {
    light.kind = kLightDirectional;
  } else {
    warn(scene_, fmt::format("lights of type {} are ignored", printable(type)));
    return;
  }
  read_light_shape(source, light);
  set_light(light, read_lamp(file_, index));
  ods::place_light(light, world);
  places_.lights.push_back({static_cast<int>(scene_.lights.size()), index, node});
  scene_.lights.push_back(light);
}

void Placer::place_camera(int index, const dmat4& world) {
  const JsonValue& node = *file_.nodes[static_cast<size_t>(index)];
  const int camera = index_in(file_, node, "camera");
  std::string name = *node["name"].text;
  const JsonValue& own = camera == -1 ? kNoJson : record(file_, file_.cameras, camera, "camera");
  if (name.empty()) name = *own["name"].text;
  ViewPoint view;
  view.name = printable(name.empty() ? fmt::format("camera {}", camera) : name);
  place_view(view, world);
  const int row = places_.nodes[static_cast<size_t>(index)];
  if (row != -1) scene_.animation.views.push_back({static_cast<int>(scene_.view_points.size()), row});
  scene_.view_points.push_back(view);
}

// Returns whether nodes with the name that the user gave become view points, because no camera has that name.
static bool camera_is_missing(const GltfFile& file, const std::string& wanted) {
  return !wanted.empty() && std::ranges::none_of(file.nodes, [&](const JsonValue* each) {
    return index_in(file, *each, "camera") != -1 && printable(*(*each)["name"].text) == wanted;
  });
}

Places read_nodes(GltfFile& file, Scene& scene, const SceneOptions& options, const AnimatedNodes& animated) {
  const Hierarchy tree = read_hierarchy(file);
  const dmat4 root = root_matrix(options);
  const std::vector<dmat4> world = evaluate_nodes(file, tree, root);
  const std::vector<char> hidden = find_hidden(file, tree, animated.blinks);
  Places places;
  places.nodes = read_moving_nodes(file, tree, world, animated.moves, root, scene);
  places.weights.assign(places.nodes.size(), -1);
  Placer placer(file, scene, places);
  const bool node_is_camera = camera_is_missing(file, options.camera);
  for (const int i : nodes_of_scene(file, tree, options.scene, scene)) {
    const JsonValue& node = *file.nodes[static_cast<size_t>(i)];
    const dmat4& matrix = world[static_cast<size_t>(i)];
    const bool stands_in = node_is_camera && printable(*node["name"].text) == options.camera;
    if (stands_in || index_in(file, node, "camera") != -1) placer.place_camera(i, matrix);
    if (hidden[static_cast<size_t>(i)] != 0) continue;
    placer.place_meshes(i, matrix);
    const JsonValue& light = extension(node, "KHR_lights_punctual");
    if (!light.is_null()) placer.place_light(i, index_in(file, light, "light"), matrix);
  }
  return places;
}

}  // namespace ods
