// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/things.h"

namespace ods {

Things things_of(const Scene& scene) {
  Things things{{}, std::vector<int>(scene.instances.size(), -1)};
  for (const NamedObject& object : scene.objects) {
    for (size_t i = 0; i < object.count; i++) {
      things.of_instance[object.first_instance + i] = static_cast<int>(things.names.size());
    }
    things.names.push_back(object.name);
  }
  for (size_t i = 0; i < scene.instances.size(); i++) {
    if (things.of_instance[i] >= 0) continue;
    const auto material = static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material);
    things.of_instance[i] = static_cast<int>(things.names.size());
    things.names.push_back(material < scene.material_names.size() ? scene.material_names[material] : "");
  }
  return things;
}

}  // namespace ods
