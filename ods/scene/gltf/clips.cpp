// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "ods/scene/gltf/nodes.h"

namespace ods {

// --- targets of channels

namespace {

enum class List { kNodes, kLights, kMaterials };

struct Target {
  List list;
  int index;
  Property property;
  int slot = 0;  // for materials: a texture slot, or a row of kLayerNumbers or kLayerColors
};

struct PointerForm {
  std::string_view member;
  Property property;
};

}  // namespace

static constexpr std::array kNodeForms = {
    PointerForm{"/translation", Property::kTranslation}, PointerForm{"/rotation", Property::kRotation},
    PointerForm{"/scale", Property::kScale}, PointerForm{"/weights", Property::kWeights},
    PointerForm{"/extensions/KHR_node_visibility/visible", Property::kVisible}};

static constexpr std::array kLightForms = {
    PointerForm{"/color", Property::kLampColor}, PointerForm{"/intensity", Property::kLampIntensity},
    PointerForm{"/range", Property::kLampRange}, PointerForm{"/spot/innerConeAngle", Property::kLampInnerCone},
    PointerForm{"/spot/outerConeAngle", Property::kLampOuterCone}};

static constexpr std::array kMaterialForms = {
    PointerForm{"/pbrMetallicRoughness/baseColorFactor", Property::kBaseColor},
    PointerForm{"/pbrMetallicRoughness/metallicFactor", Property::kMetallic},
    PointerForm{"/pbrMetallicRoughness/roughnessFactor", Property::kRoughness},
    PointerForm{"/emissiveFactor", Property::kEmission},
    PointerForm{"/extensions/KHR_materials_emissive_strength/emissiveStrength", Property::kEmissionStrength}};

static const std::string kExtensionsPath = "/extensions/";

static constexpr std::array kTextureForms = {
    PointerForm{"/extensions/KHR_texture_transform/offset", Property::kUvOffset},
    PointerForm{"/extensions/KHR_texture_transform/rotation", Property::kUvRotation},
    PointerForm{"/extensions/KHR_texture_transform/scale", Property::kUvScale}};

static constexpr std::array<std::string_view, kFirstLayerSlot> kSlots = {
    "/pbrMetallicRoughness/baseColorTexture", "/pbrMetallicRoughness/metallicRoughnessTexture", "/normalTexture",
    "/emissiveTexture", "/extensions/KHR_materials_transmission/transmissionTexture"};

static std::optional<Target> find_format(List list, int index, std::span<const PointerForm> forms,
                                         std::string_view member) {
  for (const PointerForm& form : forms) {
    if (member == form.member) return Target{list, index, form.property};
  }
  return std::nullopt;
}

static std::string texture_name(int slot) {
  if (slot < kFirstLayerSlot) return std::string(kSlots[static_cast<size_t>(slot)]);
  return kExtensionsPath + std::string(kLayerTextures[slot - kFirstLayerSlot].name);
}

static std::optional<Target> find_texture_form(int index, std::string_view member) {
  for (int slot = 0; slot < kSlotCount; slot++) {
    const std::string texture = texture_name(slot);
    if (!member.starts_with(texture)) continue;
    auto target = find_format(List::kMaterials, index, kTextureForms, member.substr(texture.size()));
    if (target) target->slot = slot;
    return target;
  }
  return std::nullopt;
}

static std::optional<Target> find_layer_form(int index, std::string_view member) {
  if (!member.starts_with(kExtensionsPath)) return std::nullopt;
  member.remove_prefix(kExtensionsPath.size());
  for (int i = 0; i < kLayerNumberCount; i++) {
    if (member == kLayerNumbers[i].name) return Target{List::kMaterials, index, Property::kLayerNumber, i};
  }
  for (int i = 0; i < kLayerColorCount; i++) {
    if (member == kLayerColors[i].name) return Target{List::kMaterials, index, Property::kLayerColor, i};
  }
  return std::nullopt;
}

// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_animation_pointer
static std::optional<Target> parse_pointer(std::string_view text) {
  struct Start {
    std::string_view words;
    List list;
    std::span<const PointerForm> forms;
  };
  const Start kStarts[] = {{"/nodes/", List::kNodes, kNodeForms},
                           {"/extensions/KHR_lights_punctual/lights/", List::kLights, kLightForms},
                           {"/materials/", List::kMaterials, kMaterialForms}};
  for (const Start& start : kStarts) {
    if (!text.starts_with(start.words)) continue;
    text.remove_prefix(start.words.size());
    int index = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || index < 0) return std::nullopt;
    const std::string_view member = text.substr(static_cast<size_t>(end - text.data()));
    const auto target = find_format(start.list, index, start.forms, member);
    if (target || start.list != List::kMaterials) return target;
    const auto layer = find_layer_form(index, member);
    return layer ? layer : find_texture_form(index, member);
  }
  return std::nullopt;
}

static std::optional<Target> target_of(const ChannelSource& channel) {
  if (channel.path.starts_with('/')) return parse_pointer(channel.path);
  if (channel.node == -1) return std::nullopt;
  return find_format(List::kNodes, channel.node, kNodeForms, "/" + channel.path);
}

AnimatedNodes find_animated_nodes(const GltfFile& file) {
  const Records& nodes = file.nodes;
  AnimatedNodes animated{std::vector<char>(nodes.size(), 0), std::vector<char>(nodes.size(), 0)};
  for (const ClipSource& clip : file.clips) {
    for (const ChannelSource& channel : clip.channels) {
      const auto target = target_of(channel);
      if (!target || target->list != List::kNodes) continue;
      element(file, nodes, target->index, "node");
      if (target->property != Property::kWeights) animated.moves[static_cast<size_t>(target->index)] = 1;
      if (target->property == Property::kVisible) animated.blinks[static_cast<size_t>(target->index)] = 1;
    }
  }
  std::vector<char> seen(file.skins.size(), 0);  // several nodes may share a skin
  for (const JsonValue* node : nodes) {
    const int skin = index_in(file, *node, "skin");
    if (skin == -1 || std::exchange(element(file, seen, skin, "skin"), 1) == 1) continue;
    for (const int joint : indices(file, *file.skins[static_cast<size_t>(skin)], "joints")) {
      element(file, nodes, joint, "node");
      animated.moves[static_cast<size_t>(joint)] = 1;
    }
  }
  return animated;
}

std::vector<char> find_moving_layers(const GltfFile& file) {
  std::vector<char> moving(file.materials.size(), 0);
  for (const ClipSource& clip : file.clips) {
    for (const ChannelSource& channel : clip.channels) {
      const auto target = target_of(channel);
      if (!target || (target->property != Property::kLayerNumber && target->property != Property::kLayerColor))
        continue;
      element(file, moving, target->index, "material") = 1;
    }
  }
  return moving;
}

// --- keys

static std::optional<Interpolation> interpolation_of(const std::string& name) {
  if (name.empty() || name == "LINEAR") return Interpolation::kLinear;
  if (name == "STEP") return Interpolation::kStep;
  if (name == "CUBICSPLINE") return Interpolation::kCubicSpline;
  return std::nullopt;
}

// The channel's keys. Returns nullopt if they are invalid. width: deduced from the values if 0.
static std::optional<Keyframes> read_keys(GltfFile& file, const ChannelSource& channel, Property property,
                                          size_t width) {
  const auto interpolation = interpolation_of(channel.interpolation);
  if (!interpolation) return std::nullopt;
  Keyframes keys;
  keys.interpolation = *interpolation;
  keys.rotation = property == Property::kRotation;
  keys.width = width;
  const AccessorView times = open_accessor(file, channel.times), values = open_accessor(file, channel.values);
  if (times.count == 0 || values.count == 0 || times.components != 1 || width == 0) return std::nullopt;
  const size_t numbers = values.count * static_cast<size_t>(values.components);
  const size_t per_key = width * (keys.interpolation == Interpolation::kCubicSpline ? 3 : 1);
  // Several channels may read the same buffer view, so every read counts.
  spend(file, times.count + numbers);
  if (numbers / per_key != times.count || numbers % per_key != 0) return std::nullopt;
  for (size_t i = 0; i < times.count; i++) {
    const float time = times.number_at(i, 0);
    if (!std::isfinite(time) || (i > 0 && time < keys.times.back())) return std::nullopt;
    keys.times.push_back(time);
  }
  for (size_t i = 0; i < values.count; i++) {
    for (int c = 0; c < values.components; c++) {
      keys.values.push_back(values.number_at(i, c));
      if (!std::isfinite(keys.values.back())) return std::nullopt;
    }
  }
  return keys;
}

// --- rows

namespace {

class TargetRows {
 public:
  TargetRows(const GltfFile& file, Scene& scene, const Places& places)
      : file_(file),
        animation_(scene.animation),
        scene_(scene),
        places_(places),
        lamps_(file.lights.size(), -1),
        materials_(file.materials.size(), -1) {}

  // The index that a track writes to; -1 if its target is not in the Scene.
  int row(const Target& target);
  void add_lights();

 private:
  int lamp(int light) {
    int& row = element(file_, lamps_, light, "light");
    if (row != -1) return row;
    animation_.lamps.push_back(read_lamp(file_, light));
    return row = static_cast<int>(animation_.lamps.size()) - 1;
  }

  int material(int index) {
    int& row = element(file_, materials_, index, "material");
    if (row != -1) return row;
    animation_.materials.push_back(read_moving_material(file_, scene_, index));
    return row = static_cast<int>(animation_.materials.size()) - 1;
  }

  const GltfFile& file_;
  Animation& animation_;
  const Scene& scene_;
  const Places& places_;
  std::vector<int> lamps_, materials_;  // indexed like the file's lists
};

}  // namespace

int TargetRows::row(const Target& target) {
  if (target.list == List::kLights) return lamp(target.index);
  if (target.list == List::kNodes) {
    const bool weights = target.property == Property::kWeights;
    return element(file_, weights ? places_.weights : places_.nodes, target.index, "node");
  }
  const int row = material(target.index), width = targets_per_material(target.property);
  if (width == kSlotCount) animation_.materials[static_cast<size_t>(row)].placed[target.slot] = true;
  return row * width + target.slot;
}

// Adds lights whose properties or node are animated.
void TargetRows::add_lights() {
  for (const Places::PlacedLight& placed : places_.lights) {
    const int node = places_.nodes[static_cast<size_t>(placed.node)];
    if (node == -1 && lamps_[static_cast<size_t>(placed.source)] == -1) continue;
    animation_.lights.push_back({placed.light, node, lamp(placed.source)});
  }
}

void read_clips(GltfFile& file, Scene& scene, const Places& places) {
  Animation& animation = scene.animation;
  TargetRows rows(file, scene, places);
  for (const ClipSource& source : file.clips) {
    Clip clip{printable(source.name), 0.0, {}};
    for (const ChannelSource& channel : source.channels) {
      const auto target = target_of(channel);
      if (!target) {
        if (!channel.path.empty()) warn(scene, fmt::format("an animation of {} is ignored", printable(channel.path)));
        continue;
      }
      const int row = rows.row(*target);
      if (row == -1) continue;
      const size_t width = target->property == Property::kWeights ? animation.weights[static_cast<size_t>(row)].size()
                                                                  : property_width(target->property);
      auto keys = read_keys(file, channel, target->property, width);
      if (!keys) {
        warn(scene, "animation channels with invalid keys are ignored");
        continue;
      }
      clip.end = std::max(clip.end, static_cast<double>(keys->times.back()));
      clip.tracks.push_back({target->property, row, std::move(*keys)});
    }
    if (!clip.tracks.empty()) animation.clips.push_back(std::move(clip));
  }
  rows.add_lights();
}

}  // namespace ods
