// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/catchers.h"

#include <algorithm>

namespace ods {

static std::string material_name(const Scene& scene, const Instance& instance) {
  const auto material = static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material);
  return material < scene.material_names.size() ? scene.material_names[material] : std::string();
}

bool make_catchers(Scene& scene, const std::string& name) {
  bool found = false;
  for (const NamedObject& object : scene.objects) {
    if (object.name != name) continue;
    for (size_t i = 0; i < object.count; i++) scene.instances[object.first_instance + i].role = kCatcher;
    found = true;
  }
  for (Instance& instance : scene.instances) {
    if (name.empty() || material_name(scene, instance) != name) continue;
    instance.role = kCatcher;
    found = true;
  }
  return found;
}

bool has_catchers(const Scene& scene) {
  const auto is_one = [](const Instance& instance) { return instance.role == kCatcher; };
  return std::any_of(scene.instances.begin(), scene.instances.end(), is_one);
}

std::vector<std::string> object_names(const Scene& scene) {
  std::vector<std::string> names;
  std::vector<char> worn(scene.material_names.size());
  for (const NamedObject& object : scene.objects) names.push_back(object.name);
  for (const Instance& instance : scene.instances) {
    const auto material = static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material);
    if (material < worn.size()) worn[material] = 1;
  }
  for (size_t i = 0; i < worn.size(); i++) {
    if (worn[i] && !scene.material_names[i].empty()) names.push_back(scene.material_names[i]);
  }
  std::vector<std::string> once;
  for (const std::string& name : names) {
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  }
  return once;
}

}  // namespace ods
