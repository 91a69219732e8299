// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the medium that a ray travels in where volumes of glass and liquid touch or overlap.
//
// A ray keeps the set of volumes that it is inside of. Where several overlap, the one with the highest refractive index
// counts: if wine is modelled slightly into the wall of its glass, the wall remains glass from either side.
// After Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", 2002. glTF has no priorities, so the
// refractive index takes their place.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/light.h"
namespace ods {
#endif

const int kMaxMedia = 4;  // deeper nesting is treated as if the innermost volumes were absent

// The colours into which dispersion splits light.
const int kRedWave = 0;
const int kGreenWave = 1;
const int kBlueWave = 2;

struct Media {
  int material[kMaxMedia];
  int count;
};

inline Media no_media() {
  Media media;
  media.material[0] = -1;
  media.material[1] = -1;
  media.material[2] = -1;
  media.material[3] = -1;
  media.count = 0;
  return media;
}

inline Media enter_medium(Media media, int material) {
  if (media.count < kMaxMedia) {
    media.material[media.count] = material;
    media.count += 1;
  }
  return media;
}

inline Media leave_medium(Media media, int material) {
  for (int i = media.count - 1; i >= 0; i--) {
    if (media.material[i] == material) {
      media.count -= 1;
      media.material[i] = media.material[media.count];
      return media;
    }
  }
  return media;
}

inline bool inside_medium(Media media, int material) {
  bool found = false;
  for (int i = 0; i < kMaxMedia; i++) found = found || (i < media.count && media.material[i] == material);
  return found;
}

// The media before and behind the wall of a volume that a ray meets from the front or from the back. A ray that meets
// the back of a wall without having passed its front started inside.
inline Media media_before(Media media, bool front, int material) {
  if (front || inside_medium(media, material)) return media;
  return enter_medium(media, material);
}

inline Media media_behind(Media media, bool front, int material) {
  if (front) return enter_medium(media, material);
  return leave_medium(media, material);
}

#ifdef __cplusplus
struct MediumReader : LightSampler {
#endif

  // The material of the current medium; -1 in air.
  inline int current_medium(Media media) {
    int best = -1;
    for (int i = 0; i < media.count; i++) {
      int candidate = media.material[i];
      if (best < 0) {
        best = candidate;
      } else {
        float index = scene_material(candidate).ior;
        float best_index = scene_material(best).ior;
        if (index > best_index || (index == best_index && candidate < best)) best = candidate;
      }
    }
    return best;
  }

  // KHR_materials_dispersion: 20 over the Abbe number.
  inline float medium_dispersion(int medium) {
    if (medium < 0 || scene_material(medium).layers < 0) return 0.0f;
    return scene_material_layers(scene_material(medium).layers).dispersion;
  }

  // wave: 0, 1 or 2 for red, green or blue light; any other value gives green's index.
  inline float medium_ior(int medium, int wave) {
    if (medium < 0) return 1.0f;
    float ior = max(scene_material(medium).ior, 1.0f);
    if (wave != kRedWave && wave != kBlueWave) return ior;
    float half_spread = (ior - 1.0f) * 0.025f * medium_dispersion(medium);
    return max(wave == kRedWave ? ior - half_spread : ior + half_spread, 1.0f);
  }

  // Transmittance over a distance in a medium (Beer-Lambert; KHR_materials_volume).
  inline vec3 medium_transmittance(int medium, float distance) {
    if (medium < 0) return vec3(1.0f);
    Material material = scene_material(medium);
    float reach = material.attenuation_distance;
    if (!(reach > 0.0f) || reach > kFarAway) return vec3(1.0f);
    vec3 color = clamp(material.attenuation_color, vec3(1e-6f), vec3(1.0f));
    return exp(log(color) * (min(distance, kFarAway) / reach));
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
