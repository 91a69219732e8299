// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/lamp_unit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ods/scene/motion.h"

namespace ods {

static float brightest(const PunctualLight& light) {
  return std::max({light.intensity.x, light.intensity.y, light.intensity.z});
}

// Returns whether the power, divided by Blender's factor, is a number of watts with at most three digits. About one
// lamp in several thousand has such a value by chance.
static bool has_round_watts(const PunctualLight& light) {
  const double sphere = light.kind == kLightDirectional ? 1.0 : 4.0 * std::numbers::pi;
  const double watts = double{brightest(light)} * sphere / kLumensPerWatt;
  if (!(watts > 0.0)) return false;
  const double digit = std::pow(10.0, std::floor(std::log10(watts)) - 2.0);
  return std::abs(watts / digit - std::round(watts / digit)) < 1e-6 * watts / digit;
}

bool lamps_are_in_watts(const Scene& scene) {
  constexpr float kCandela = 100.0f, kLux = 50.0f;
  const bool is_blenders = scene.generator.find("Blender I/O") != std::string::npos ||
                           (!scene.lights.empty() && std::ranges::all_of(scene.lights, has_round_watts));
  if (!is_blenders) return false;
  if (!std::ranges::any_of(scene.materials, is_emissive)) return false;
  return std::ranges::any_of(scene.lights, [](const PunctualLight& light) {
    return brightest(light) > (light.kind == kLightDirectional ? kLux : kCandela);
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
