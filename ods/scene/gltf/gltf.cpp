// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/gltf.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "ods/base/error.h"
#include "ods/scene/gltf/parts.h"
#include "ods/scene/motion.h"

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
  if (count > file.budget) fail(file, "asks for far more geometry than a file of its size can hold; it looks damaged");
  file.budget -= count;
}

// Supported, or understood enough to use the fallback beside it.
static constexpr std::array kRendered = {
    "EXT_meshopt_compression", "KHR_draco_mesh_compression",      "KHR_meshopt_compression", "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",        "KHR_animation_pointer",           "KHR_lights_punctual",     "KHR_materials_ior",
    "KHR_materials_unlit",     "KHR_materials_emissive_strength", "KHR_texture_transform",   "KHR_materials_volume",
    "KHR_mesh_quantization",   "KHR_materials_transmission",
};

static bool contains(std::span<const char* const> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_read(std::string_view extension) {
  return contains(kRendered, extension) || extension == "KHR_materials_specular" || extension == kBasis;
}

// The strings in a root list of the file.
static std::set<std::string> names_in(const GltfFile& file, const char* key) {
  std::set<std::string> names;
  for (const JsonValue& name : file.json.root()[key]) names.insert(*name.text);
  return names;
}

static void check_extensions(const GltfFile& file, Scene& scene) {
  for (const std::string& name : names_in(file, "extensionsRequired")) {
    if (contains(kRendered, name)) continue;
    if (name == kBasis) {
      fail(file,
           fmt::format("its textures are in the KTX2 format ({}), which ods does not read; convert them first: {}",
                       kBasis, kBasisCure));
    }
    fail(file, fmt::format("needs the extension {}, which ods does not support; export it again without it",
                           printable(name)));
  }
  constexpr size_t kMax = 50;
  for (const std::string& name : names_in(file, "extensionsUsed")) {
    if (contains(kRendered, name) || name == kBasis) continue;  // a texture without a fallback warns
    if (scene.warnings.size() == kMax) break;
    warn(scene, fmt::format("extension {} is ignored", printable(name)));
  }
}

static void check_reach(Scene& scene) {
  const Bounds bounds = scene_bounds(scene);
  const vec3 corner = max(abs(bounds.low), abs(bounds.high));
  const float reach = std::max({corner.x, corner.y, corner.z});
  if (reach <= kFirmReach) return;
  warn(scene, fmt::format("the scene extends {:.3g} km from the origin, where light leaks through walls thinner than "
                          "{:.2g} m; move it nearer",
                          reach * 1e-3f, reach * kThinnestWall));
}

static Scene read_scene(GltfFile& file, const SceneOptions& options) {
  Scene scene;
  scene.name = std::filesystem::path(file.path).stem().string();
  check_extensions(file, scene);
  warn_renamed(file, scene);
  read_materials(file, scene);
  decode_meshes(file, scene);
  const Places places = read_nodes(file, scene, options.scene, named_nodes(file));
  read_clips(file, scene, places);
  set_time(scene, 0.0);  // poses skins and morph targets at rest
  check_reach(scene);
  return scene;
}

Scene load_gltf(const std::string& path, const SceneOptions& options) {
  GltfFile file = open_gltf(path, options.confine);
  return read_scene(file, options);
}

Scene load_gltf_bytes(std::span<const unsigned char> bytes, const std::string& path, const SceneOptions& options) {
  GltfFile file = open_gltf_bytes(bytes, path, options.confine);
  return read_scene(file, options);
}

}  // namespace ods
