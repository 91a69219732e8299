// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/lamp_unit.h"

#include <algorithm>
#include <cassert>

#include "ods/scene/motion.h"

namespace ods {

bool lamps_are_in_watts(const Scene& scene) {
  constexpr float kCandela = 100.0f, kLux = 50.0f;
  if (scene.generator.find("Blender I/O") == std::string::npos) return false;
  if (!std::ranges::any_of(scene.materials, is_emissive)) return false;
  return std::ranges::any_of(scene.lights, [](const PunctualLight& light) {
    const float most = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    return most > (light.kind == kLightDirectional ? kLux : kCandela);
  });
}

void scale_lamps(Scene& scene, double factor) {
  assert(scene.animation.playing.empty());
  for (PunctualLight& light : scene.lights) light.intensity *= static_cast<float>(factor);
  for (Lamp& lamp : scene.animation.lamps) lamp.intensity *= factor;
  for (Clip& clip : scene.animation.clips) {
    for (Track& track : clip.tracks) {
      if (track.property != Property::kLampIntensity) continue;
      for (float& value : track.keys.values) value = static_cast<float>(static_cast<double>(value) * factor);
    }
  }
  set_time(scene, 0.0);
}

}  // namespace ods
