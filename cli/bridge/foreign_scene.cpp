// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/foreign_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/bridge/assimp.h"
#include "cli/bridge/scene_cache.h"
#include "cli/console/console.h"
#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/claim.h"
#include "ods/files/private_folder.h"
#include "ods/files/read_file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

struct ForeignFormat {
  std::string_view extension;
  bool blender;  // reads it
  bool assimp;   // Assimp converts it
};

constexpr ForeignFormat kFormats[] = {
    {".blend", true, false}, {".fbx", true, true},   {".obj", true, true},  {".dae", true, true},
    {".ply", true, true},    {".stl", true, true},   {".usd", true, false}, {".usda", true, false},
    {".usdc", true, false},  {".usdz", true, false}, {".abc", true, false}, {".3ds", false, true},
    {".3mf", false, true},   {".lwo", false, true},  {".x3d", false, true},
};

constexpr std::chrono::hours kPatience{2};  // for another process that converts the same file

const ForeignFormat* format_of(const std::string& path) {
  const std::string extension = ods::small_letters(fs::path(path).extension().string());
  const auto* const found = std::ranges::find(kFormats, extension, &ForeignFormat::extension);
  return found == std::end(kFormats) ? nullptr : found;
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}' {}", path, why));
}

// The magic bytes of a gzip or zstd stream, or of Blender.
void check_blend(const std::string& path) {
  const std::vector<unsigned char> start = ods::read_start(path, 7);
  const std::string_view words(reinterpret_cast<const char*>(start.data()), start.size());
  const bool known = words == "BLENDER" || words.starts_with("\x1f\x8b") || words.starts_with("\x28\xb5\x2f\xfd");
  if (!known) fail(path, "is not a Blender file, or is damaged");
}

[[noreturn]] void fail_without_program(const std::string& path, const ForeignFormat& format) {
  if (!format.assimp) fail(path, "needs Blender to be read: install it, or name it with --blender PATH");
  if (!format.blender) fail(path, "needs Assimp's command to be read: install it (assimp-utils)");
  fail(path, "needs Blender or Assimp's command to be read: install one (blender, assimp-utils), or --blender PATH");
}

// Assimp converts the formats that it reads if Blender is missing, or cannot read the file.
void convert(const std::string& path, const ForeignFormat& format, const BlenderOptions& options,
             const std::string& kept, const ConversionWatch& watch) {
  const ods::PrivateFolder folder(cache_folder() + "/.new-");
  const bool can_blender = format.blender && !find_blender(options).empty();
  const bool can_assimp = format.assimp && has_assimp();
  if (!can_blender && !can_assimp) fail_without_program(path, format);
  if (can_blender) {
    note(fmt::format("Blender converts '{}'; the result is kept in '{}' until the file changes", path,
                     fs::path(kept).parent_path().native()));
    try {
      run_blender(options, path, folder.path(), watch);
      return keep_scene(folder.path(), kept);
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kInput || !format.assimp) throw;
      if (!can_assimp) {
        throw ods::Error(ods::ErrorKind::kInput, fmt::format("{} (Assimp may: install assimp-utils)", error.what()));
      }
      note(error.what());
    }
  }
  note(fmt::format("Assimp converts '{}': no lights, cameras, node materials or world", path));
  run_assimp(path, folder.path(), options.seconds);
  keep_scene(folder.path(), kept);
}

}  // namespace

ForeignScene read_bridge(const std::string& folder) {
  std::ifstream file(folder + "/bridge.json");
  const json found = json::parse(file, nullptr, false);
  ForeignScene scene;
  scene.file = folder + "/scene.glb";
  if (!found.is_object()) fail(folder, "is damaged; remove it");
  if (found.contains("environment") && found["environment"].is_string()) {
    scene.environment = found["environment"];
    if (scene.environment.ends_with(".exr")) scene.environment = folder + "/world.exr";
  }
  scene.background = found.value("background", "");
  if (scene.background.ends_with(".exr")) scene.background = folder + "/" + scene.background;
  scene.shutter = found.value("shutter", 0.0f);
  scene.unit = found.value("unit", 1.0f);
  if (found.contains("frames")) {
    const json& frames = found["frames"];
    scene.frames = {frames.value("first", 0), frames.value("count", 0), frames.value("saved", 0)};
  }
  if (found.contains("fps") && found["fps"].is_number()) scene.fps = found["fps"];
  for (const json& warning : found.value("warnings", json::array())) {
    if (warning.is_string()) scene.warnings.push_back(warning);
  }
  if (found.contains("camera")) {
    std::vector<std::string> ignored;
    scene.camera = ods::read_sidecar(ods::json_document(found["camera"]), "the scene's camera", ignored);
    scene.has_stereo = found["camera"].contains("merge_top");
  }
  return scene;
}

bool is_blend(const std::string& path) {
  const ForeignFormat* const format = format_of(path);
  return format && format->extension == ".blend";
}

bool is_foreign_scene(const std::string& path) {
  return format_of(path) != nullptr;
}

ForeignScene convert_foreign_scene(const std::string& path, const BlenderOptions& options,
                                   const ConversionWatch& watch) {
  const ForeignFormat& format = *format_of(path);
  const std::string kept = kept_scene(path, describe(options));
  const bool is_blender_file = is_blend(path);
  if (is_blender_file) check_blend(path);
  if (!is_kept(kept)) {
    const auto claim = ods::claim(kept, kPatience);
    if (!is_kept(kept)) convert(path, format, options, kept, watch);
  }
  ForeignScene scene = read_bridge(kept);
  scene.is_blender_file = is_blender_file;
  return scene;
}
