// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What Blender's glTF exporter leaves out, mostly without a word. Source: its add-on io_scene_gltf2, 3.4 to 4.x.
#include <fmt/format.h>

#include <algorithm>

#include "ods/base/text.h"
#include "ods/scene/gltf/nodes.h"

namespace ods {

namespace {

using Names = std::vector<std::string>;

std::string listed(const Names& names) {
  constexpr size_t kMost = 4;
  const auto end = names.begin() + static_cast<ptrdiff_t>(std::min(names.size(), kMost));
  const std::string rest = names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "";
  return fmt::format("'{}'{}", fmt::join(names.begin(), end, "', '"), rest);
}

// Per node: whether it is a joint of a skin.
std::vector<char> find_joints(const GltfFile& file) {
  std::vector<char> joints(file.nodes.size(), 0);
  for (const JsonValue* skin : file.skins) {
    for (const int joint : indices(file, *skin, "joints")) element(file, joints, joint, "node") = 1;
  }
  return joints;
}

// Neither a thing nor a group of things.
bool is_bare(const GltfFile& file, const JsonValue& node) {
  return node["children"].size() == 0 && index_in(file, node, "mesh") == -1 && index_in(file, node, "camera") == -1 &&
         extension(node, "KHR_lights_punctual").is_null() && !node["name"].text->empty();
}

struct BareNodes {
  Names cameras;  // that move, or are called so
  Names lights;   // all others, but not what Blender calls an empty
};

BareNodes find_bare_nodes(const GltfFile& file, const AnimatedNodes& animated) {
  const std::vector<char> joints = find_joints(file);
  BareNodes found;
  for (size_t i = 0; i < file.nodes.size(); i++) {
    const JsonValue& node = *file.nodes[i];
    if (joints[i] != 0 || !is_bare(file, node)) continue;
    const std::string name = printable(*node["name"].text), small = small_letters(name);
    const bool is_camera = animated.moves[i] != 0 || small.find("camera") != std::string::npos;
    if (is_camera) found.cameras.push_back(name);
    if (!is_camera && !small.starts_with("empty")) found.lights.push_back(name);
  }
  return found;
}

// Materials that say neither a colour nor a texture: their shader nodes are none that the exporter writes.
Names find_plain_materials(const GltfFile& file) {
  Names names;
  for (const JsonValue* material : file.materials) {
    const JsonValue& pbr = (*material)["pbrMetallicRoughness"];
    const bool says_something = !pbr["baseColorFactor"].is_null() || !pbr["baseColorTexture"].is_null() ||
                                !extension(*material, "KHR_materials_transmission").is_null() ||
                                !extension(*material, "KHR_materials_pbrSpecularGlossiness").is_null() ||
                                !(*material)["emissiveFactor"].is_null();
    if (!says_something) names.push_back(printable(*(*material)["name"].text));
  }
  return names;
}

}  // namespace

void find_losses(const GltfFile& file, Scene& scene, const AnimatedNodes& animated) {
  scene.generator = printable(*file.json.root()["asset"]["generator"].text);
  if (scene.generator.find("Blender I/O") == std::string::npos) return;
  const BareNodes bare = find_bare_nodes(file, animated);
  if (file.lights.empty() && file.cameras.empty() && bare.cameras.empty()) {
    scene.losses.push_back(
        "Blender's export has left out all lights and cameras, if there are any: tick Cameras and Punctual Lights "
        "there, "
        "under Include");
  }
  if (scene.view_points.empty() && !bare.cameras.empty()) {
    scene.losses.push_back(fmt::format(
        "Blender's export empties panoramic cameras: {} may be one; --camera '{}' stands there and moves with it",
        listed(bare.cameras), bare.cameras.front()));
  }
  if (!file.lights.empty() && !bare.lights.empty()) {
    scene.losses.push_back(
        fmt::format("Blender's export empties area lights: {} may be some; a plane with an emissive material in "
                    "each one's place lights the scene",
                    listed(bare.lights)));
  }
  if (const Names plain = find_plain_materials(file); !plain.empty()) {
    scene.losses.push_back(fmt::format(
        "Blender's export does not know the shader nodes of {}: white or grey, unless you bake their colours "
        "to a texture, or set them in a Principled BSDF",
        listed(plain)));
  }
}

}  // namespace ods
