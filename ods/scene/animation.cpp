// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/animation.h"

#include <algorithm>
#include <set>
#include <utility>

namespace ods {

size_t property_width(Property property) {
  switch (property) {
    case Property::kWeights:
      return 0;
    case Property::kVisible:
    case Property::kLampIntensity:
    case Property::kLampRange:
    case Property::kLampInnerCone:
    case Property::kLampOuterCone:
    case Property::kEmissionStrength:
    case Property::kMetallic:
    case Property::kRoughness:
    case Property::kLayerNumber:
    case Property::kUvRotation:
      return 1;
    case Property::kUvOffset:
    case Property::kUvScale:
      return 2;
    case Property::kTranslation:
    case Property::kScale:
    case Property::kLampColor:
    case Property::kEmission:
    case Property::kLayerColor:
      return 3;
    case Property::kRotation:
    case Property::kBaseColor:
      return 4;
  }
  return 0;
}

int targets_per_material(Property property) {
  switch (property) {
    case Property::kBaseColor:
    case Property::kEmission:
    case Property::kEmissionStrength:
    case Property::kMetallic:
    case Property::kRoughness:
      return 1;
    case Property::kLayerNumber:
      return kLayerNumberCount;
    case Property::kLayerColor:
      return kLayerColorCount;
    case Property::kUvOffset:
    case Property::kUvRotation:
    case Property::kUvScale:
      return kSlotCount;
    case Property::kTranslation:
    case Property::kRotation:
    case Property::kScale:
    case Property::kVisible:
    case Property::kWeights:
    case Property::kLampColor:
    case Property::kLampIntensity:
    case Property::kLampRange:
    case Property::kLampInnerCone:
    case Property::kLampOuterCone:
      return 0;
  }
  return 0;
}

void rest_at(MovingMaterial& moving, const MaterialLayers& layers) {
  for (size_t i = 0; i < std::size(kLayerNumbers); i++) {
    moving.layer_numbers[i] = static_cast<double>(layers.*kLayerNumbers[i].member);
  }
  for (size_t i = 0; i < std::size(kLayerColors); i++) {
    moving.layer_colors[i] = glm::dvec3(layers.*kLayerColors[i].member);
  }
}

double length_of(const Animation& animation) {
  double length = 0.0;
  for (const int clip : animation.playing) {
    length = std::max(length, animation.clips[static_cast<size_t>(clip)].end);
  }
  return length;
}

bool play(Animation& animation, const std::string& name) {
  std::set<std::pair<Property, int>> taken;
  std::vector<int> playing;
  for (size_t i = 0; i < animation.clips.size(); i++) {
    const Clip& clip = animation.clips[i];
    if (!name.empty()) {
      if (clip.name == name && playing.empty()) playing.push_back(static_cast<int>(i));
      continue;
    }
    const bool free = std::none_of(clip.tracks.begin(), clip.tracks.end(), [&](const Track& track) {
      return taken.contains({track.property, track.target});
    });
    if (!free) continue;
    for (const Track& track : clip.tracks) taken.insert({track.property, track.target});
    playing.push_back(static_cast<int>(i));
  }
  if (!name.empty() && playing.empty()) return false;
  animation.playing = playing;
  return true;
}

}  // namespace ods
