// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What moves in a scene, and how: all that set_time() (ods/scene/motion.h) needs to write the scene's own records anew.
// Everything that is not named here stands still.
//
// Clips hold tracks; a track changes one property of one target with time. Targets are rows of the lists below:
//   nodes      a tree of places; instances, skins, lights and view points hang on them
//   weights    of the morph targets of a mesh
//   lamps      what lights are made of: colour, strength, range, cone
//   materials  factors and the places of textures
#pragma once
#include <iterator>
#include <string>
#include <vector>

#include "ods/base/names.h"
#include "ods/scene/animation/deformation.h"
#include "ods/scene/animation/keyframes.h"

namespace ods {

enum class Property {
  kTranslation,  // of a node: x, y, z
  kRotation,     //            quaternion x, y, z, w
  kScale,        //            x, y, z
  kWeights,      // of weights: one number for each morph target
  kLampColor,    // of a lamp: r, g, b
  kLampIntensity,
  kLampRange,
  kLampInnerCone,  // radians
  kLampOuterCone,
  kBaseColor,  // of a material: r, g, b, a
  kEmission,   //                r, g, b
  kEmissionStrength,
  kMetallic,
  kRoughness,
  kUvOffset,  // of a texture's place: target is 5 * material + slot (kBaseColorSlot ..)
  kUvRotation,
  kUvScale,
};

inline constexpr Property kProperties[] = {
    Property::kTranslation,   Property::kRotation,      Property::kScale,     Property::kWeights,
    Property::kLampColor,     Property::kLampIntensity, Property::kLampRange, Property::kLampInnerCone,
    Property::kLampOuterCone, Property::kBaseColor,     Property::kEmission,  Property::kEmissionStrength,
    Property::kMetallic,      Property::kRoughness,     Property::kUvOffset,  Property::kUvRotation,
    Property::kUvScale};
static_assert(std::size(kProperties) == enumerator_count<Property>());

// How many numbers change together; 0: as many as there are morph targets.
size_t property_width(Property property);

struct Track {
  Property property = Property::kTranslation;
  int target = 0;
  Keyframes keys;
};

struct Clip {
  std::string name;
  double end = 0.0;  // seconds: its last key
  std::vector<Track> tracks;
};

// A place that moves, or hangs on one that does. parent * before * T * R * S is where it stands in the world.
struct MovingNode {
  int parent = -1;  // a node before this one in the list; -1: none, `before` holds all that stands above
  glm::dmat4 before{1.0};
  glm::dvec3 translation{0.0};  // at rest
  glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};
  glm::dvec3 scale{1.0};
};

struct Skin {
  std::vector<int> joints;  // nodes
  std::vector<glm::dmat4> inverse_bind;
};

// An instance of the scene that moves, or whose mesh does. Its matrix is node * local.
struct MovingInstance {
  int instance = 0;
  int node = -1;         // -1: none, local is where it stands
  int deformation = -1;  // of its mesh; -1: none
  glm::dmat4 local{1.0};
  vec3 low{0.0f}, high{0.0f};  // the box around its mesh, where that is not deformed
};

struct Lamp {
  glm::dvec3 color{1.0};
  double intensity = 1.0, range = 0.0, inner_cone = 0.0, outer_cone = 0.7853981633974483;
};

struct MovingLight {
  int light = 0;  // of the scene
  int node = -1;  // -1: it does not move; it shines along -Z of its node
  int lamp = 0;
};

struct MovingView {
  int view_point = 0;  // of the scene
  int node = 0;        // it looks along -Z of its node
};

// KHR_texture_transform.
struct UvPlace {
  glm::dvec2 offset{0.0};
  double rotation = 0.0;  // radians
  glm::dvec2 scale{1.0};
};

enum { kBaseColorSlot, kMetallicRoughnessSlot, kNormalSlot, kEmissionSlot, kTransmissionSlot, kSlotCount };

struct MovingMaterial {
  int material = 0;  // of the scene
  glm::dvec4 base_color{1.0};
  glm::dvec3 emission{0.0};  // without its strength
  double strength = 1.0, metallic = 0.0, roughness = 1.0;
  UvPlace places[kSlotCount];
  bool placed[kSlotCount] = {};  // whether a track moves that texture
};

struct Animation {
  std::vector<Clip> clips;
  std::vector<int> playing;  // which clips set_time() plays; none: all is at rest. Of two that move the same thing the
                             // later one wins

  std::vector<MovingNode> nodes;
  std::vector<std::vector<double>> weights;  // at rest
  std::vector<Skin> skins;
  std::vector<Deformation> deformations;
  std::vector<MovingInstance> instances;
  std::vector<Lamp> lamps;  // at rest
  std::vector<MovingLight> lights;
  std::vector<MovingView> views;
  std::vector<MovingMaterial> materials;  // at rest
};

// Seconds from 0 to the last key of what plays; 0: nothing moves.
double length_of(const Animation& animation);

// Chooses what plays: the clip of that name, or with an empty name every clip that moves nothing which one before it
// moves (files hold one clip for each object, or several takes of one figure). False: there is no clip of that name.
bool play(Animation& animation, const std::string& name);

}  // namespace ods
