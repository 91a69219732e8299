// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/layered_file.h"

#include <cmath>
#include <filesystem>

#include "ods/base/angles.h"
#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/confined_file.h"
#include "ods/layers/file/layers_info.h"

namespace ods {

namespace fs = std::filesystem;

bool is_layered_scene(const std::string& path) {
  std::error_code fault;
  if (small_letters(fs::path(path).extension().string()) != ".glb" || !fs::is_regular_file(path, fault)) return false;
  try {
    return read_layers_info(path).has_value();
  } catch (const Error&) {
    return true;
  }
}

// Without probes at the height of the eyes.
static vec3 place_ahead(const LayersInfo& info) {
  constexpr float kAhead = 1.2f;
  const float yaw = info.yaw * static_cast<float>(kDegree);
  const vec3 at = info.box.center + kAhead * vec3(std::sin(yaw), 0.0f, -std::cos(yaw));
  const bool has_probes = info.light.probes.count.y > 0;
  return {at.x, has_probes ? info.light.probes.origin.y - kProbeMargin : at.y, at.z};
}

LayeredFile read_layered_file(const std::string& path) {
  const LayersInfo info = *read_layers_info(path);
  LayeredFile file;
  file.scene = info.scene;
  file.ahead = place_ahead(info);
  const std::string name = info.fallback;
  if (name.empty()) return file;
  const fs::path folder = fs::canonical(path).parent_path();
  const std::string fallback = (folder / name).native();
  try {
    const ConfinedFile confined(fallback, folder.native(), Reach::kDirectly);
    file.fallback = fallback;
  } catch (const Error&) {
    file.missing = name;
  }
  return file;
}

}  // namespace ods
