// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/load/load.h"

#include <fmt/core.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/reduced_textures.h"

namespace ods {

Scene load_scene(const std::string& name, const SceneOptions& options) {
  if (const BuiltinScene* builtin = find_builtin(name)) {
    if (options.scene > 0 || !options.scene_name.empty()) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("`scene`: '{}' has no scene {}: a built-in scene has only one", name,
                              options.scene_name.empty() ? std::to_string(options.scene) : options.scene_name));
    }
    if (!options.variant.empty()) {
      throw Error(ErrorKind::kUsage, fmt::format("`variant`: '{}' is a built-in scene, which has no variants", name));
    }
    Scene scene = builtin->make();
    scene.name = name;
    reduce_textures(scene);
    return scene;
  }
  std::error_code error;
  // If confined, load_gltf() gives the same message whether or not a file outside exists.
  if (options.confine.empty() && !std::filesystem::exists(name, error)) {
    throw Error(ErrorKind::kInput, fmt::format("{}: no such file, and no built-in scene{}", name,
                                               did_you_mean(name, names_of(builtin_scenes()))));
  }
  Scene scene = load_gltf(name, options);
  reduce_textures(scene);
  return scene;
}

}  // namespace ods
