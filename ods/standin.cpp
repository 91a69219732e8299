// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
// stand-in until the other parts are merged
#include <array>

#include "ods/scene/builtin.h"
namespace ods {
static constexpr std::array<BuiltinScene, 1> kScenes{{{"room", "a furnished interior"}}};
std::span<const BuiltinScene> builtin_scenes() { return kScenes; }
bool is_builtin(const std::string& name) { return name == "room" || name == "furnace"; }
Scene make_builtin(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.environment.radiance = vec3(0.5f);
  scene.view_points.push_back({"room"});
  return scene;
}
}  // namespace ods
