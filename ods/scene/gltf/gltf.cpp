// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/base/text.h"
#include "ods/scene/gltf/extensions.h"
#include "ods/scene/gltf/nodes.h"
#include "ods/scene/motion.h"
#include "ods/scene/placement.h"

namespace ods {

void fail(const GltfFile& file, const std::string& what) {
  throw Error(ErrorKind::kInput, fmt::format("{}: {}", file.path, what));
}

std::string printable(const std::string& text) {
  constexpr size_t kLongest = 80;
  std::string line = text.substr(0, kLongest);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text.size() > kLongest ? line + "..." : line;
}

void warn(Scene& scene, const std::string& what) {
  constexpr size_t kMax = 100;  // a file can trigger millions
  if (scene.warnings.size() >= kMax) return;
  if (std::find(scene.warnings.begin(), scene.warnings.end(), what) == scene.warnings.end()) {
    scene.warnings.push_back(what);
  }
}

void spend(GltfFile& file, size_t count) {
  if (count > file.budget)
    fail(file, "declares far more geometry than a file of its size can hold; it is probably damaged");
  file.budget -= count;
}

// The strings in a root list of the file.
static std::set<std::string> names_in(const GltfFile& file, const char* key) {
  std::set<std::string> names;
  for (const JsonValue& name : file.json.root()[key]) names.insert(*name.text);
  return names;
}

// Lists in the scene how each of the file's extensions was handled.
static void check_extensions(const GltfFile& file, Scene& scene) {
  const std::set<std::string> required = names_in(file, "extensionsRequired");
  std::set<std::string> used = names_in(file, "extensionsUsed");
  used.insert(required.begin(), required.end());
  used.insert(file.json.extensions.begin(), file.json.extensions.end());  // some files do not list them
  for (const std::string& name : required) {
    const Extension row = find_extension(name);
    if (is_supported(row.state)) continue;
    fail(file, fmt::format("needs the extension {} ({}), which ods does not read; export it again without it",
                           printable(name), row.how));
  }
  constexpr size_t kMax = 100;
  for (const std::string& name : used) {
    if (scene.extensions.size() == kMax) break;
    const Extension row = find_extension(name);
    const std::string_view state = name_in(kExtensionStateTable, row.state);
    scene.extensions.push_back({printable(name), std::string(state), std::string(row.how), required.contains(name)});
    if (row.state != ExtensionState::kNotRendered) continue;
    warn(scene, fmt::format("extension {} is not rendered ({})", printable(name), row.how));
  }
}

// KHR_materials_variants: lists the variants, and notes which one the caller chose.
static void choose_variant(GltfFile& file, Scene& scene, const std::string& chosen) {
  for (const JsonValue& variant : extension(file.json.root(), "KHR_materials_variants")["variants"]) {
    scene.variants.push_back(printable(*variant["name"].text));
  }
  if (chosen.empty()) return;
  const auto found = std::find(scene.variants.begin(), scene.variants.end(), chosen);
  if (found == scene.variants.end()) {
    const std::string near = did_you_mean(chosen, scene.variants);
    const std::string others = scene.variants.empty() ? "; it has no variants"
                               : !near.empty()        ? near
                                                      : fmt::format("; it has {}", fmt::join(scene.variants, ", "));
    throw Error(ErrorKind::kUsage, fmt::format("`variant`: '{}' has no variant '{}'{}", file.path, chosen, others));
  }
  file.variant = static_cast<int>(found - scene.variants.begin());
}

static std::string counted(size_t count, const char* what) {
  return count == 0 ? "" : fmt::format("{} {}", count, what);
}

static void warn_of_undrawn(const GltfFile& file, Scene& scene) {
  const size_t lines = file.lines.size(), points = file.points.size(), all = lines + points;
  if (all == 0) return;
  const char* between = lines > 0 && points > 0 ? " and " : "";
  warn(scene, fmt::format("{}{}{} primitive{} not rendered: ods renders triangles", counted(lines, "line"), between,
                          counted(points, "point"), all == 1 ? " is" : "s are"));
}

static int chosen_scene(const GltfFile& file, const SceneOptions& options) {
  if (options.scene_name.empty()) return options.scene;
  std::vector<std::string> names;
  for (const JsonValue* each : file.scenes) names.push_back(printable(*(*each)["name"].text));
  const auto found = std::find(names.begin(), names.end(), options.scene_name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw Error(ErrorKind::kUsage, fmt::format("`scene`: '{}' has no scene '{}'{}", file.path, options.scene_name,
                                             did_you_mean(options.scene_name, names)));
}

static Scene read_scene(GltfFile& file, const SceneOptions& given) {
  SceneOptions options = given;
  options.scene = chosen_scene(file, given);
  Scene scene;
  scene.name = std::filesystem::path(file.path).stem().string();
  scene.origin = options.origin;
  check_extensions(file, scene);
  warn_renamed(file, scene);
  choose_variant(file, scene, options.variant);
  read_materials(file, scene);
  decode_meshes(file, scene);
  const AnimatedNodes animated = find_animated_nodes(file);
  const Places places = read_nodes(file, scene, options, animated);
  find_losses(file, scene, animated);
  read_image_light(file, scene, options.scene);
  read_clips(file, scene, places);
  warn_of_undrawn(file, scene);
  set_time(scene, 0.0);  // poses skins and morph targets at rest
  if (const std::string far = reach_warning(scene); !far.empty()) warn(scene, far);
  return scene;
}

// Map coordinates are numbers of which single precision keeps metres. So a scene that is far away is read again, with
// its middle subtracted in double precision.
template <typename Open>
static Scene read_near(const Open& open, SceneOptions options) {
  GltfFile file = open();
  Scene scene = read_scene(file, options);
  const vec3 middle = options.finds_origin ? far_middle(scene) : vec3(0.0f);
  if (middle == vec3(0.0f)) return scene;
  options.origin += glm::dvec3(middle);
  GltfFile again = open();
  return read_scene(again, options);
}

Scene load_gltf(const std::string& path, const SceneOptions& options) {
  return read_near([&] { return open_gltf(path, options.confine); }, options);
}

Scene load_gltf_bytes(std::span<const unsigned char> bytes, const std::string& path, const SceneOptions& options) {
  return read_near([&] { return open_gltf_bytes(bytes, path, options.confine); }, options);
}

// --- losses of Blender's glTF exporter, mostly without a warning. Source: its add-on io_scene_gltf2, 3.4 to 4.x ----

namespace {

using Names = std::vector<std::string>;

std::string listed(const Names& names) {
  constexpr size_t kMax = 4;
  const auto end = names.begin() + static_cast<ptrdiff_t>(std::min(names.size(), kMax));
  const std::string rest = names.size() > kMax ? fmt::format(" and {} more", names.size() - kMax) : "";
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

// Neither an object nor a group of objects.
bool is_bare(const GltfFile& file, const JsonValue& node) {
  return node["children"].size() == 0 && index_in(file, node, "mesh") == -1 && index_in(file, node, "camera") == -1 &&
         extension(node, "KHR_lights_punctual").is_null() && !node["name"].text->empty();
}

struct BareNodes {
  Names cameras;  // cameras that move, or whose names suggest a camera
  Names lights;   // all others, except the default names of Blender's empties
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

// Materials with neither a colour nor a texture: their shader nodes are not supported by the exporter.
Names find_plain_materials(const GltfFile& file) {
  Names names;
  for (const JsonValue* material : file.materials) {
    const JsonValue& pbr = (*material)["pbrMetallicRoughness"];
    const bool has_color_or_texture = !pbr["baseColorFactor"].is_null() || !pbr["baseColorTexture"].is_null() ||
                                      !extension(*material, "KHR_materials_transmission").is_null() ||
                                      !extension(*material, "KHR_materials_pbrSpecularGlossiness").is_null() ||
                                      !(*material)["emissiveFactor"].is_null();
    if (!has_color_or_texture) names.push_back(printable(*(*material)["name"].text));
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
        "Blender's export empties panoramic cameras: {} may be one; `camera` '{}' stands there and moves with it",
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
        "Blender's exporter does not support the shader nodes of {}: white or grey, unless you bake their colours "
        "to a texture, or set them in a Principled BSDF",
        listed(plain)));
  }
}

}  // namespace ods
