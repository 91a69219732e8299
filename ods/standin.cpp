// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
// stand-in until the other parts are merged
#include <unistd.h>

#include <array>

#include "ods/base/error.h"
#include "ods/scene/builtin.h"
#include "ods/scene/environment.h"
#include "ods/scene/load.h"
namespace ods {
Scene load_scene(const std::string& path, const SceneOptions&) {
  if (access(path.c_str(), R_OK) != 0) throw Error(ErrorKind::kInput, path + ": there is no such file");
  throw Error(ErrorKind::kInput, path + " is no glTF");
}
Environment load_environment(const std::string& path) {
  throw Error(ErrorKind::kInput, path + ": there is no such file");
}
static constexpr std::array<BuiltinScene, 1> kScenes{{{"room", "a furnished interior"}}};
std::span<const BuiltinScene> builtin_scenes() { return kScenes; }
bool is_builtin(const std::string& name) { return name == "room" || name == "furnace"; }
Scene make_builtin(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.environment.radiance = vec3(0.5f);
  return scene;
}
}  // namespace ods
