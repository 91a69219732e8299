// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/load/join.h"

#include <fmt/format.h>

#include <cassert>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "ods/base/angles.h"
#include "ods/base/error.h"
#include "ods/scene/placement.h"

namespace ods {

namespace {

// The sizes of a scene's lists before it was joined: what is added to the object's indices.
struct Offsets {
  explicit Offsets(const Scene& scene)
      : vertices(static_cast<uint>(scene.vertices.size())),
        triangles(static_cast<uint>(scene.triangles.size())),
        texels(static_cast<uint>(scene.texels.size())),
        meshes(static_cast<int>(scene.meshes.size())),
        instances(static_cast<int>(scene.instances.size())),
        materials(static_cast<int>(scene.materials.size())),
        layers(static_cast<int>(scene.material_layers.size())),
        textures(static_cast<int>(scene.textures.size())),
        lights(static_cast<int>(scene.lights.size())),
        nodes(static_cast<int>(scene.animation.nodes.size())),
        weights(static_cast<int>(scene.animation.weights.size())),
        skins(static_cast<int>(scene.animation.skins.size())),
        deformations(static_cast<int>(scene.animation.deformations.size())),
        lamps(static_cast<int>(scene.animation.lamps.size())),
        moving_materials(static_cast<int>(scene.animation.materials.size())) {}

  uint vertices, triangles, texels;
  int meshes, instances, materials, layers, textures, lights;
  int nodes, weights, skins, deformations, lamps, moving_materials;
};

// An index, or -1.
int moved(int index, int by) {
  return index < 0 ? index : index + by;
}

template <class T>
void append_all(std::vector<T>& list, const std::vector<T>& added) {
  list.insert(list.end(), added.begin(), added.end());
}

void add_textures(Scene& scene, const Scene& object, const Offsets& by) {
  append_all(scene.texels, object.texels);
  for (Texture texture : object.textures) {
    texture.first_texel += by.texels;
    scene.textures.push_back(texture);
  }
  const uint reduced = static_cast<uint>(scene.reduced_texels.size());
  append_all(scene.reduced_texels, object.reduced_texels);
  for (Texture texture : object.reduced_textures) {
    texture.first_texel += reduced;
    scene.reduced_textures.push_back(texture);
  }
  if (scene.reduced_textures.size() == scene.textures.size()) return;
  scene.reduced_textures.clear();  // one of the scenes had none: then the full textures are used
  scene.reduced_texels.clear();
}

void add_materials(Scene& scene, const Scene& object, const Offsets& by) {
  for (MaterialLayers layers : object.material_layers) {
    for (const auto& row : kLayerTextures) {
      TextureSlot& slot = layers.*row.member;
      slot.texture = moved(slot.texture, by.textures);
    }
    scene.material_layers.push_back(layers);
  }
  for (Material material : object.materials) {
    material.layers = moved(material.layers, by.layers);
    for (TextureSlot* const slot : {&material.base_color_slot, &material.metallic_roughness_slot, &material.normal_slot,
                                    &material.emission_slot, &material.transmission_slot}) {
      slot->texture = moved(slot->texture, by.textures);
    }
    scene.materials.push_back(material);
  }
  scene.material_names.resize(static_cast<size_t>(by.materials));
  append_all(scene.material_names, object.material_names);
}

glm::dmat4 matrix_of(const Instance& instance) {
  return glm::transpose(glm::dmat4(glm::dvec4(instance.row0), glm::dvec4(instance.row1), glm::dvec4(instance.row2),
                                   glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

// By mesh: skinned meshes are placed by their joints, and their vertices are in the world.
std::vector<char> skinned_meshes(const Scene& object) {
  std::vector<char> skinned(object.meshes.size());
  for (const Deformation& deformation : object.animation.deformations) {
    if (deformation.skin >= 0) skinned[static_cast<size_t>(deformation.mesh)] = 1;
  }
  return skinned;
}

void place_vertices(Scene& scene, const Mesh& mesh, const glm::dmat4& place) {
  const auto turned = [&](vec3 v) { return vec3(place * glm::dvec4(glm::dvec3(v), 0.0)); };
  for (uint i = mesh.first_vertex; i < mesh.first_vertex + mesh.vertex_count; i++) {
    Vertex& vertex = scene.vertices[i];
    vertex.position = vec3(place * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    vertex.normal = turned(vertex.normal);
    vertex.tangent = vec4(turned(vec3(vertex.tangent)), vertex.tangent.w);
  }
}

void add_meshes(Scene& scene, const Scene& object, const Offsets& by, const glm::dmat4& place) {
  append_all(scene.vertices, object.vertices);
  append_all(scene.triangles, object.triangles);
  for (Mesh mesh : object.meshes) {
    mesh.first_vertex += by.vertices;
    mesh.first_triangle += by.triangles;
    mesh.material += by.materials;
    scene.meshes.push_back(mesh);
  }
  const std::vector<char> skinned = skinned_meshes(object);
  for (size_t i = 0; i < skinned.size(); i++) {
    if (skinned[i]) place_vertices(scene, scene.meshes[static_cast<size_t>(by.meshes) + i], place);
  }
}

void add_instances(Scene& scene, const Scene& object, const Offsets& by, const glm::dmat4& place) {
  const std::vector<char> skinned = skinned_meshes(object);
  for (Instance instance : object.instances) {
    if (!skinned[static_cast<size_t>(instance.mesh)]) set_matrix(instance, place * matrix_of(instance));
    instance.mesh += by.meshes;
    scene.instances.push_back(instance);
  }
  if (!scene.hidden.empty() || !object.hidden.empty()) {
    scene.hidden.resize(static_cast<size_t>(by.instances));
    append_all(scene.hidden, object.hidden);
    scene.hidden.resize(scene.instances.size());
  }
  for (NamedObject named : object.objects) {
    named.first_instance += static_cast<size_t>(by.instances);
    scene.objects.push_back(named);
  }
}

void add_lights(Scene& scene, const Scene& object, const glm::dmat4& place) {
  for (PunctualLight light : object.lights) {
    light.position = vec3(place * glm::dvec4(glm::dvec3(light.position), 1.0));
    light.direction = vec3(place * glm::dvec4(glm::dvec3(light.direction), 0.0));
    scene.lights.push_back(light);
  }
}

int target_offset(Property property, const Offsets& by) {
  switch (property) {
    case Property::kTranslation:
    case Property::kRotation:
    case Property::kScale:
    case Property::kVisible:
      return by.nodes;
    case Property::kWeights:
      return by.weights;
    case Property::kLampColor:
    case Property::kLampIntensity:
    case Property::kLampRange:
    case Property::kLampInnerCone:
    case Property::kLampOuterCone:
      return by.lamps;
    default:
      return by.moving_materials * targets_per_material(property);
  }
}

void add_clips(Animation& animation, const Animation& object, const Offsets& by) {
  for (Clip clip : object.clips) {
    for (Track& track : clip.tracks) track.target += target_offset(track.property, by);
    animation.clips.push_back(std::move(clip));
  }
}

void add_nodes(Animation& animation, const Animation& object, const Offsets& by, const glm::dmat4& place) {
  for (MovingNode node : object.nodes) {
    if (node.parent == -1) node.before = place * node.before;
    node.parent = moved(node.parent, by.nodes);
    animation.nodes.push_back(node);
  }
  for (Skin skin : object.skins) {
    for (int& joint : skin.joints) joint += by.nodes;
    animation.skins.push_back(std::move(skin));
  }
}

void add_moving_instances(Animation& animation, const Animation& object, const Offsets& by, const glm::dmat4& place) {
  for (MovingInstance moving : object.instances) {
    const bool skinned =
        moving.deformation >= 0 && object.deformations[static_cast<size_t>(moving.deformation)].skin >= 0;
    if (moving.node == -1 && !skinned) moving.local = place * moving.local;
    moving.instance += by.instances;
    moving.node = moved(moving.node, by.nodes);
    moving.shown_by = moved(moving.shown_by, by.nodes);
    moving.deformation = moved(moving.deformation, by.deformations);
    animation.instances.push_back(moving);
  }
}

void add_deformations(Animation& animation, const Animation& object, const Offsets& by) {
  append_all(animation.weights, object.weights);
  for (Deformation deformation : object.deformations) {
    deformation.mesh += by.meshes;
    deformation.weights = moved(deformation.weights, by.weights);
    deformation.skin = moved(deformation.skin, by.skins);
    animation.deformations.push_back(std::move(deformation));
  }
}

void add_moving_lights_and_materials(Animation& animation, const Animation& object, const Offsets& by) {
  append_all(animation.lamps, object.lamps);
  for (MovingLight light : object.lights) {
    light.light += by.lights;
    light.node = moved(light.node, by.nodes);
    light.lamp += by.lamps;
    animation.lights.push_back(light);
  }
  for (MovingMaterial material : object.materials) {
    material.material += by.materials;
    animation.materials.push_back(material);
  }
}

}  // namespace

glm::dmat4 place_of_object(vec3 at, float turn) {
  const glm::dmat4 moved_to = glm::translate(glm::dmat4(1.0), glm::dvec3(at));
  return glm::rotate(moved_to, double{turn} * kDegree, glm::dvec3(0.0, 1.0, 0.0));
}

void join(Scene& scene, const Scene& object, const glm::dmat4& place) {
  assert(scene.supplied == 0 && object.supplied == 0);
  if (scene.texels.size() + object.texels.size() > std::numeric_limits<uint>::max()) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' has too many texels to be put into '{}': make its textures "
                                               "smaller",
                                               object.name, scene.name));
  }
  const Offsets by(scene);
  add_textures(scene, object, by);
  add_materials(scene, object, by);
  add_meshes(scene, object, by, place);
  add_instances(scene, object, by, place);
  add_lights(scene, object, place);
  Animation& animation = scene.animation;
  add_clips(animation, object.animation, by);
  add_nodes(animation, object.animation, by, place);
  add_moving_instances(animation, object.animation, by, place);
  add_deformations(animation, object.animation, by);
  add_moving_lights_and_materials(animation, object.animation, by);
}

}  // namespace ods
