// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Source: the glTF 2.0 specification, sections 3.7.2 and 3.11.
#include "ods/layers/file/film_glb.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace ods {

namespace {

std::vector<size_t> add_lights(Glb& glb, const FilmTexture& texture) {
  std::vector<size_t> lights;
  for (const std::string& bytes : texture.lights) {
    lights.push_back(add_texture(glb, texture.name, texture.format, bytes));
  }
  return lights;
}

// Adds the material of each texture; returns the number of the first.
size_t add_film_materials(Glb& glb, const std::vector<FilmTexture>& textures) {
  const size_t first = glb.json["materials"].size();
  for (const FilmTexture& texture : textures) {
    const std::vector<size_t> lights = add_lights(glb, texture);
    Json material = unlit_material(texture.name, lights.front());
    material["extras"]["omnistereo"]["lights"] = lights;
    glb.json["materials"].push_back(material);
  }
  return first;
}

// A mesh in the order in which files have it.
struct Ordered {
  MeshOrder order;
  const MoverMesh& mesh;

  std::vector<vec3> some(const std::vector<vec3>& all) const {
    std::vector<vec3> chosen;
    for (const uint vertex : order.vertices) chosen.push_back(all[vertex]);
    return chosen;
  }
};

// The step for a vertex where its mover comes nearest to the box.
float finest_step(const LayeredScene& scene, const LayerMover& mover, float radius) {
  const LayerMesh still;
  float finest = 1e30f;
  for (const LayerPose& pose : mover.poses) {
    if (!pose.shown) continue;
    const vec3 away = pose.place - scene.box.center;
    const float scale = std::max({pose.scale.x, pose.scale.y, pose.scale.z});
    const vec3 nearest = away * std::max(1.0f - scale * radius / std::max(length(away), 1e-6f), 0.0f);
    finest = std::min(finest, rounding_step(scene, still, nearest) / scale);
  }
  return finest;
}

Json primitive_of(Glb& glb, const LayeredScene& scene, const LayerMover& mover, const MoverMesh& mesh,
                  size_t material) {
  const Ordered ordered{drawing_order(mesh.triangles, mesh.positions.size()), mesh};
  float radius = 0.0f;
  for (const vec3& position : mesh.positions) radius = std::max(radius, length(position));
  for (const std::vector<vec3>& shape : mesh.shapes) {
    for (const vec3& position : shape) radius = std::max(radius, length(position));
  }
  const float finest = finest_step(scene, mover, radius);
  const StepOf step = [&](size_t) { return finest; };
  std::vector<vec2> uvs;
  for (const uint vertex : ordered.order.vertices) uvs.push_back(mesh.uvs[vertex]);
  Json primitive;
  primitive["attributes"]["POSITION"] = add_positions(glb, ordered.some(mesh.positions), step);
  primitive["attributes"]["TEXCOORD_0"] = add_uvs(glb, uvs);
  for (size_t frame = 1; frame < mesh.shapes.size(); frame++) {
    std::vector<vec3> moved = ordered.some(mesh.shapes[frame]);
    const std::vector<vec3> first = ordered.some(mesh.positions);
    for (size_t i = 0; i < moved.size(); i++) moved[i] -= first[i];
    primitive["targets"].push_back({{"POSITION", add_positions(glb, moved, step)}});
  }
  primitive["indices"] = add_indices(glb, ordered.order);
  primitive["material"] = material;
  return primitive;
}

// The animation of all movers.
struct FilmAnimation {
  Glb& glb;
  const LayeredScene& scene;
  std::optional<size_t> times;  // their accessor
  Json samplers = Json::array(), channels = Json::array();

  void add(size_t node, const char* path, const std::vector<float>& values, size_t components, bool is_step = false) {
    if (!times) times = add_floats(glb, scene.film.times, "SCALAR", 1);
    const char* type = components == 4 ? "VEC4" : components == 3 ? "VEC3" : "SCALAR";
    samplers.push_back({{"input", *times},
                        {"output", add_floats(glb, values, type, components)},
                        {"interpolation", is_step ? "STEP" : "LINEAR"}});
    channels.push_back({{"sampler", samplers.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  // Adds the channels of those properties that change.
  void add_poses(size_t node, const LayerMover& mover) {
    std::vector<float> places, rotations, scales;
    bool is_hidden = false, moves = false, turns = false, grows = false;
    const LayerPose& first = mover.poses.front();
    for (const LayerPose& pose : mover.poses) {
      const vec3 place = pose.place - scene.box.center, scale = pose.shown ? pose.scale : vec3(0.0f);
      places.insert(places.end(), {place.x, place.y, place.z});
      rotations.insert(rotations.end(), {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w});
      scales.insert(scales.end(), {scale.x, scale.y, scale.z});
      is_hidden |= !pose.shown;
      moves |= pose.place != first.place;
      turns |= pose.rotation != first.rotation;
      grows |= pose.scale != first.scale;
    }
    if (moves) add(node, "translation", places, 3);
    if (turns) add(node, "rotation", rotations, 4);
    if (grows || is_hidden) add(node, "scale", scales, 3, is_hidden);
  }

  // Each frame has a target of its own, but for the first.
  void add_shapes(size_t node, size_t frames) {
    std::vector<float> weights(frames * (frames - 1));
    for (size_t frame = 1; frame < frames; frame++) weights[frame * (frames - 1) + frame - 1] = 1.0f;
    add(node, "weights", weights, 1);
  }
};

}  // namespace

std::vector<size_t> add_film(Glb& glb, const LayeredScene& scene, const FilmTextures& textures) {
  const size_t first_material = add_film_materials(glb, textures.moving);
  FilmAnimation animation{glb, scene, {}};
  for (const LayerMover& mover : scene.film.movers) {
    if (mover.meshes.empty()) continue;
    Json mesh = {{"name", mover.name}, {"primitives", Json::array()}};
    for (const MoverMesh& part : mover.meshes) {
      Json& material = glb.json["materials"][first_material + part.texture];
      if (part.kind == LayerKind::kMasked) material["alphaMode"] = "MASK", material["alphaCutoff"] = 0.5;
      mesh["primitives"].push_back(primitive_of(glb, scene, mover, part, first_material + part.texture));
    }
    const size_t frames = mover.meshes.front().shapes.size();
    if (frames > 1) mesh["weights"] = std::vector<float>(frames - 1);
    const LayerPose& pose = mover.poses.front();
    const vec3 place = pose.place - scene.box.center, scale = pose.shown ? pose.scale : vec3(0.0f);
    const vec4 q = pose.rotation;
    const size_t node = add_to(glb.json["nodes"], {{"name", mover.name},
                                                   {"mesh", add_to(glb.json["meshes"], mesh)},
                                                   {"translation", {place.x, place.y, place.z}},
                                                   {"rotation", {q.x, q.y, q.z, q.w}},
                                                   {"scale", {scale.x, scale.y, scale.z}}});
    animation.add_poses(node, mover);
    if (frames > 1) animation.add_shapes(node, frames);
  }
  if (!animation.channels.empty()) {
    glb.json["animations"] = {{{"name", "film"}, {"samplers", animation.samplers}, {"channels", animation.channels}}};
  }
  return add_lights(glb, textures.change);
}

}  // namespace ods
