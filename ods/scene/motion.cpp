// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "ods/kernel/surface.h"
#include "ods/scene/placement.h"

namespace ods {

using glm::dmat4, glm::dvec2, glm::dvec3, glm::dvec4;

namespace {

// All animated values at one time.
struct Pose {
  std::vector<MovingNode> nodes;
  std::vector<std::vector<double>> weights;
  std::vector<Lamp> lamps;
  std::vector<MovingMaterial> materials;
  std::vector<dmat4> world;  // per node
  std::vector<char> shown;   // per node: whether it and its ancestors are visible

  bool shows(int node) const { return node == -1 || shown[static_cast<size_t>(node)] != 0; }
};

dvec3 three(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

void write_node(Property property, const std::vector<double>& value, MovingNode& node) {
  if (property == Property::kTranslation) node.translation = three(value);
  if (property == Property::kRotation) node.rotation = dvec4(three(value), value[3]);
  if (property == Property::kScale) node.scale = three(value);
  if (property == Property::kVisible) node.visible = value[0] != 0.0;
}

void write_lamp(Property property, const std::vector<double>& value, Lamp& lamp) {
  if (property == Property::kLampColor) lamp.color = three(value);
  if (property == Property::kLampIntensity) lamp.intensity = value[0];
  if (property == Property::kLampRange) lamp.range = value[0];
  if (property == Property::kLampInnerCone) lamp.inner_cone = value[0];
  if (property == Property::kLampOuterCone) lamp.outer_cone = value[0];
}

void write_material(Property property, const std::vector<double>& value, MovingMaterial& material) {
  if (property == Property::kBaseColor) material.base_color = dvec4(three(value), value[3]);
  if (property == Property::kEmission) material.emission = three(value);
  if (property == Property::kEmissionStrength) material.strength = value[0];
  if (property == Property::kMetallic) material.metallic = value[0];
  if (property == Property::kRoughness) material.roughness = value[0];
}

void write_place(Property property, const std::vector<double>& value, UvPlace& place) {
  if (property == Property::kUvOffset) place.offset = {value[0], value[1]};
  if (property == Property::kUvRotation) place.rotation = value[0];
  if (property == Property::kUvScale) place.scale = {value[0], value[1]};
}

void write(const Track& track, double seconds, Pose& pose) {
  std::vector<double> value(track.keys.width);
  evaluate(track.keys, seconds, value);
  const auto target = static_cast<size_t>(track.target);
  switch (track.property) {
    case Property::kTranslation:
    case Property::kRotation:
    case Property::kScale:
    case Property::kVisible:
      return write_node(track.property, value, pose.nodes[target]);
    case Property::kWeights:
      pose.weights[target] = value;
      return;
    case Property::kLampColor:
    case Property::kLampIntensity:
    case Property::kLampRange:
    case Property::kLampInnerCone:
    case Property::kLampOuterCone:
      return write_lamp(track.property, value, pose.lamps[target]);
    case Property::kBaseColor:
    case Property::kEmission:
    case Property::kEmissionStrength:
    case Property::kMetallic:
    case Property::kRoughness:
      return write_material(track.property, value, pose.materials[target]);
    case Property::kLayerNumber:
      pose.materials[target / kLayerNumberCount].layer_numbers[target % kLayerNumberCount] = value[0];
      return;
    case Property::kLayerColor:
      pose.materials[target / kLayerColorCount].layer_colors[target % kLayerColorCount] = three(value);
      return;
    case Property::kUvOffset:
    case Property::kUvRotation:
    case Property::kUvScale:
      return write_place(track.property, value, pose.materials[target / kSlotCount].places[target % kSlotCount]);
  }
}

void place_nodes(Pose& pose) {
  pose.world.reserve(pose.nodes.size());
  for (const MovingNode& node : pose.nodes) {
    assert(node.parent < static_cast<int>(pose.world.size()));
    const dmat4 own = node.before * trs_matrix(node.translation, node.rotation, node.scale);
    pose.world.push_back(node.parent == -1 ? own : pose.world[static_cast<size_t>(node.parent)] * own);
    pose.shown.push_back(node.visible && pose.shows(node.parent) ? 1 : 0);
  }
}

// Returns whether a deformed mesh could be written; if not, it keeps its stored vertices and is hidden.
bool bend(Scene& scene, const Deformation& deformation, const Pose& pose, SceneChange& change) {
  static const std::vector<double> kNoWeights;
  const std::vector<double>& weights =
      deformation.weights == -1 ? kNoWeights : pose.weights[static_cast<size_t>(deformation.weights)];
  std::vector<dmat4> joints;
  if (deformation.skin != -1) {
    const Skin& skin = scene.animation.skins[static_cast<size_t>(deformation.skin)];
    for (size_t i = 0; i < skin.joints.size(); i++) {
      joints.push_back(pose.world[static_cast<size_t>(skin.joints[i])] * skin.inverse_bind[i]);
    }
  }
  const Mesh& mesh = scene.meshes[static_cast<size_t>(deformation.mesh)];
  const std::span<const uvec3> triangles(scene.triangles.data() + mesh.first_triangle, mesh.triangle_count);
  std::vector<Vertex> vertices = deformation.rest;
  const bool sound = deform(deformation, weights, joints, triangles, kFarthest, vertices);
  Vertex* stored = scene.vertices.data() + mesh.first_vertex;
  const auto same = [](const Vertex& a, const Vertex& b) {
    return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
  };
  if (!std::equal(vertices.begin(), vertices.end(), stored, same)) {
    std::copy(vertices.begin(), vertices.end(), stored);
    change.meshes.push_back(deformation.mesh);
  }
  return sound;
}

void place_instance(Scene& scene, const MovingInstance& moving, const Pose& pose, const Bounds& bounds, bool sound,
                    SceneChange& change) {
  const auto i = static_cast<size_t>(moving.instance);
  dmat4 matrix = moving.node == -1 ? moving.local : pose.world[static_cast<size_t>(moving.node)] * moving.local;
  sound =
      sound && pose.shows(moving.shown_by) && is_bounded(matrix) && is_invertible(matrix) && stays_near(matrix, bounds);
  if (!sound) matrix = dmat4(1.0);
  const Instance before = scene.instances[i];
  Instance& instance = scene.instances[i];
  set_matrix(instance, matrix);
  const char hidden = sound ? 0 : 1;
  const bool same = instance.row0 == before.row0 && instance.row1 == before.row1 && instance.row2 == before.row2;
  if (!same || scene.hidden[i] != hidden) change.instances.push_back(moving.instance);
  scene.hidden[i] = hidden;
}

void write_instances(Scene& scene, const Pose& pose, SceneChange& change) {
  const Animation& animation = scene.animation;
  std::vector<char> sound;
  for (const Deformation& deformation : animation.deformations) sound.push_back(bend(scene, deformation, pose, change));
  if (!animation.instances.empty()) scene.hidden.resize(scene.instances.size());
  for (const MovingInstance& moving : animation.instances) {
    const bool bends = moving.deformation != -1;
    const Instance& instance = scene.instances[static_cast<size_t>(moving.instance)];
    const Bounds bounds =
        bends ? mesh_bounds(scene, scene.meshes[static_cast<size_t>(instance.mesh)]) : Bounds{moving.low, moving.high};
    place_instance(scene, moving, pose, bounds, !bends || sound[static_cast<size_t>(moving.deformation)], change);
  }
}

void write_lights(Scene& scene, const Pose& pose, SceneChange& change) {
  for (const MovingLight& moving : scene.animation.lights) {
    PunctualLight& light = scene.lights[static_cast<size_t>(moving.light)];
    const PunctualLight before = light;
    set_light(light, pose.lamps[static_cast<size_t>(moving.lamp)]);
    if (!pose.shows(moving.node)) light.intensity = vec3(0.0f);
    if (moving.node != -1) {
      const dmat4& world = pose.world[static_cast<size_t>(moving.node)];
      place_light(light, is_bounded(world) ? world : dmat4(1.0));
    }
    change.lights |= before.position != light.position || before.direction != light.direction ||
                     before.intensity != light.intensity || before.range != light.range ||
                     before.inner_cone != light.inner_cone || before.outer_cone != light.outer_cone;
  }
}

void write_views(Scene& scene, const Pose& pose, SceneChange& change) {
  for (const MovingView& moving : scene.animation.views) {
    ViewPoint& view = scene.view_points[static_cast<size_t>(moving.view_point)];
    const ViewPoint before = view;
    const dmat4& world = pose.world[static_cast<size_t>(moving.node)];
    place_view(view, is_bounded(world) ? world : dmat4(1.0));
    change.view_points |= before.position != view.position || before.yaw != view.yaw || before.pitch != view.pitch ||
                          before.roll != view.roll;
  }
}

float clamped(double value, double high, double low = 0.0) {
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, low, high) : low);
}

void write_layers(const MovingMaterial& moving, MaterialLayers& layers) {
  for (size_t i = 0; i < std::size(kLayerNumbers); i++) {
    layers.*kLayerNumbers[i].member = clamped(moving.layer_numbers[i], kLayerNumbers[i].high, kLayerNumbers[i].low);
  }
  for (size_t i = 0; i < std::size(kLayerColors); i++) {
    for (int c = 0; c < 3; c++) {
      (layers.*kLayerColors[i].member)[c] = clamped(moving.layer_colors[i][c], kLayerColors[i].high);
    }
  }
  for (size_t i = 0; i < std::size(kLayerTextures); i++) {
    const size_t slot = kFirstLayerSlot + i;
    if (moving.placed[slot]) place_texture(layers.*kLayerTextures[i].member, moving.places[slot]);
  }
}

void write_materials(Scene& scene, const Pose& pose, SceneChange& change) {
  for (const MovingMaterial& moving : pose.materials) {
    Material& material = scene.materials[static_cast<size_t>(moving.material)];
    const Material before = material;
    for (int c = 0; c < 4; c++) material.base_color[c] = clamped(moving.base_color[c], 1.0);
    for (int c = 0; c < 3; c++) material.emission[c] = clamped(moving.emission[c], 1e9);
    material.emission *= clamped(moving.strength, 1e9);
    material.metallic = clamped(moving.metallic, 1.0);
    material.roughness = clamped(moving.roughness, 1.0);
    TextureSlot* slots[kFirstLayerSlot] = {&material.base_color_slot, &material.metallic_roughness_slot,
                                           &material.normal_slot, &material.emission_slot, &material.transmission_slot};
    for (size_t k = 0; k < kFirstLayerSlot; k++) {
      if (moving.placed[k]) place_texture(*slots[k], moving.places[k]);
    }
    change.materials |= std::memcmp(&before, &material, sizeof before) != 0;
    if (material.layers < 0) continue;
    MaterialLayers& layers = scene.material_layers[static_cast<size_t>(material.layers)];
    const MaterialLayers layers_before = layers;
    write_layers(moving, layers);
    change.materials |= std::memcmp(&layers_before, &layers, sizeof layers) != 0;
  }
}

}  // namespace

SceneChange set_time(Scene& scene, double seconds) {
  const Animation& animation = scene.animation;
  Pose pose{animation.nodes, animation.weights, animation.lamps, animation.materials, {}, {}};
  for (const int clip : animation.playing) {
    for (const Track& track : animation.clips[static_cast<size_t>(clip)].tracks) write(track, seconds, pose);
  }
  place_nodes(pose);
  SceneChange change;
  write_instances(scene, pose, change);
  write_lights(scene, pose, change);
  write_views(scene, pose, change);
  write_materials(scene, pose, change);
  return change;
}

void add_change(SceneChange& sum, const SceneChange& change) {
  sum.instances.insert(sum.instances.end(), change.instances.begin(), change.instances.end());
  sum.meshes.insert(sum.meshes.end(), change.meshes.begin(), change.meshes.end());
  sum.lights |= change.lights;
  sum.materials |= change.materials;
  sum.view_points |= change.view_points;
}

// The times of the keys of the playing clips, and those half way between: at most a few hundred, evenly chosen.
static std::vector<double> telling_times(const Animation& animation) {
  std::vector<double> keys;
  for (const int clip : animation.playing) {
    for (const Track& track : animation.clips[static_cast<size_t>(clip)].tracks) {
      keys.insert(keys.end(), track.keys.times.begin(), track.keys.times.end());
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<double> times;
  const size_t step = keys.size() / 200 + 1;
  for (size_t i = 0; i < keys.size(); i += step) {
    times.push_back(keys[i]);
    if (i + 1 < keys.size()) times.push_back(0.5 * (keys[i] + keys[i + 1]));
  }
  return times;
}

// Returns whether a track's keys differ. Some programs write keys for static objects, too.
static bool changes(const Keyframes& keys) {
  const size_t of_key = keys.values.size() / keys.times.size();
  return !std::equal(keys.values.begin() + static_cast<ptrdiff_t>(of_key), keys.values.end(), keys.values.begin());
}

static bool moves_node(const Animation& animation, int node) {
  return std::ranges::any_of(animation.playing, [&](int clip) {
    return std::ranges::any_of(animation.clips[static_cast<size_t>(clip)].tracks, [&](const Track& track) {
      const bool is_place = track.property == Property::kTranslation || track.property == Property::kRotation ||
                            track.property == Property::kScale;
      return is_place && track.target == node && changes(track.keys);
    });
  });
}

bool moves_view(const Animation& animation, int view_point) {
  const auto view = std::ranges::find(animation.views, view_point, &MovingView::view_point);
  if (view == animation.views.end()) return false;
  for (int node = view->node; node != -1; node = animation.nodes[static_cast<size_t>(node)].parent) {
    if (moves_node(animation, node)) return true;
  }
  return false;
}

bool is_ever_visible(const Scene& scene) {
  if (is_anything_visible(scene)) return true;
  Scene moving = scene;
  const auto appears = [&] {
    for (const double time : telling_times(moving.animation)) {
      set_time(moving, time);
      if (is_anything_visible(moving)) return true;
    }
    return false;
  };
  if (play(moving.animation, "") && appears()) return true;
  for (size_t i = 0; i < scene.animation.clips.size(); i++) {
    moving.animation.playing = {static_cast<int>(i)};
    if (appears()) return true;
  }
  return false;
}

vec3 point_of(const Scene& scene, const Hit& hit) {
  const Instance& instance = scene.instances[static_cast<size_t>(hit.instance)];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  const uvec3 corners = scene.triangles[mesh.first_triangle + static_cast<size_t>(hit.triangle)];
  const auto at = [&](uint corner) { return scene.vertices[mesh.first_vertex + size_t{corner}].position; };
  const vec3 a = at(corners.x);
  return to_world(instance, a + (at(corners.y) - a) * hit.u + (at(corners.z) - a) * hit.v);
}

}  // namespace ods
