// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
// stand-in until the other parts are merged
#include <unistd.h>

#include <array>
#include <fstream>

#include "ods/base/error.h"
#include "ods/image/save.h"
#include "ods/scene/builtin.h"
#include "ods/scene/environment.h"
#include "ods/scene/load.h"
namespace ods {
std::string_view layout_name(Layout layout) {
  static const char* const names[] = {"top-bottom", "side-by-side", "separate", "multiview"};
  return names[static_cast<int>(layout)];
}
std::string_view tone_curve_name(ToneCurve curve) { return curve == ToneCurve::kNeutral ? "neutral" : "linear"; }
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
void check_output(const std::string& path, const SaveOptions&, const std::vector<int>&, int) {
  std::string folder = path.substr(0, path.rfind('/') + 1);
  if (folder.empty()) folder = ".";
  if (access(folder.c_str(), W_OK) != 0) throw Error(ErrorKind::kOutput, path + ": cannot be written");
}
std::vector<std::string> save_picture(const Picture&, const CameraRig&, const SaveOptions&, const std::string& path) {
  std::ofstream(path) << "picture";
  return {path};
}
}  // namespace ods
