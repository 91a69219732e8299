// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The animation of a scene: the data from which set_time() (ods/scene/motion.h) updates the scene's records. Everything
// else is static.
//
// Clips contain tracks; a track changes one property of one target over time. Targets are indices into the lists below:
//   nodes      a tree of transforms, with instances, skins, lights and view points attached
//   weights    of the morph targets of a mesh
//   lamps      the properties of lights: colour, intensity, range, cone
//   materials  factors and texture transforms
#pragma once
#include <iterator>
#include <string>
#include <vector>

#include "ods/base/names.h"
#include "ods/scene/deformation.h"
#include "ods/scene/keyframes.h"
#include "ods/scene/layer_factors.h"

namespace ods {

enum class Property {
  kTranslation,  // a node's x, y, z
  kRotation,     //            quaternion x, y, z, w
  kScale,        //            x, y, z
  kVisible,      // 0 hides the node and its descendants, other numbers show them
  kWeights,      // one number for each morph target
  kLampColor,    // a lamp's r, g, b
  kLampIntensity,
  kLampRange,
  kLampInnerCone,  // radians
  kLampOuterCone,
  kBaseColor,  // a material's r, g, b, a
  kEmission,   //                r, g, b
  kEmissionStrength,
  kMetallic,
  kRoughness,
  kLayerNumber,  // for a material's layers: target is kLayerNumberCount * material + index in kLayerNumbers
  kLayerColor,   // target is kLayerColorCount * material + index in kLayerColors; r, g, b
  kUvOffset,     // for a texture transform: target is kSlotCount * material + slot (kBaseColorSlot ..)
  kUvRotation,
  kUvScale,
};

inline constexpr Property kProperties[] = {
    Property::kTranslation,      Property::kRotation,      Property::kScale,         Property::kVisible,
    Property::kWeights,          Property::kLampColor,     Property::kLampIntensity, Property::kLampRange,
    Property::kLampInnerCone,    Property::kLampOuterCone, Property::kBaseColor,     Property::kEmission,
    Property::kEmissionStrength, Property::kMetallic,      Property::kRoughness,     Property::kLayerNumber,
    Property::kLayerColor,       Property::kUvOffset,      Property::kUvRotation,    Property::kUvScale};
static_assert(std::size(kProperties) == enumerator_count<Property>());

// The number of values that change together; 0 stands for one per morph target.
size_t property_width(Property property);

// The number of consecutive targets of this property that belong to one of Animation::materials; 0 if it is not a
// property of materials.
int targets_per_material(Property property);

struct Track {
  Property property = Property::kTranslation;
  int target = 0;
  Keyframes keys;
};

struct Clip {
  std::string name;
  double end = 0.0;  // seconds: time of the last key
  std::vector<Track> tracks;
};

// A transform that moves, or whose ancestor does. Its world matrix is parent * before * T * R * S.
struct MovingNode {
  int parent = -1;  // an earlier node in the list; -1 if `before` holds all ancestors, which are static
  glm::dmat4 before{1.0};
  glm::dvec3 translation{0.0};  // at rest
  glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};
  glm::dvec3 scale{1.0};
  bool visible = true;
};

struct Skin {
  std::vector<int> joints;  // indices of nodes
  std::vector<glm::dmat4> inverse_bind;
};

// An instance that moves, or whose mesh deforms. Its matrix is node * local.
struct MovingInstance {
  int instance = 0;
  int node = -1;         // -1 if `local` is its world matrix
  int deformation = -1;  // the deformation of its mesh, or -1
  glm::dmat4 local{1.0};
  vec3 low{0.0f}, high{0.0f};  // the mesh's bounds, if it does not deform
  int shown_by = -1;           // the node that hides and shows it, or -1
};

struct Lamp {
  glm::dvec3 color{1.0};
  double intensity = 1.0, range = 0.0, inner_cone = 0.0, outer_cone = 0.7853981633974483;
};

struct MovingLight {
  int light = 0;  // index in the scene
  int node = -1;  // -1 if static; it shines along -Z of its node
  int lamp = 0;
};

struct MovingView {
  int view_point = 0;  // index in the scene
  int node = 0;        // it looks along -Z of its node
};

// KHR_texture_transform.
struct UvPlace {
  glm::dvec2 offset{0.0};
  double rotation = 0.0;  // radians
  glm::dvec2 scale{1.0};
};

// The slots of a material's textures, then those of its layers.
enum { kBaseColorSlot, kMetallicRoughnessSlot, kNormalSlot, kEmissionSlot, kTransmissionSlot, kFirstLayerSlot };
inline constexpr int kSlotCount = kFirstLayerSlot + kLayerTextureCount;

struct MovingMaterial {
  int material = 0;  // index in the scene
  glm::dvec4 base_color{1.0};
  glm::dvec3 emission{0.0};  // without the strength factor
  double strength = 1.0, metallic = 0.0, roughness = 1.0;
  double layer_numbers[kLayerNumberCount] = {};
  glm::dvec3 layer_colors[kLayerColorCount] = {};
  UvPlace places[kSlotCount];
  bool placed[kSlotCount] = {};  // per slot: whether a track animates its texture transform
};

// Sets the rest values of the layers' factors.
void rest_at(MovingMaterial& moving, const MaterialLayers& layers);

struct Animation {
  std::vector<Clip> clips;
  std::vector<int> playing;  // clips that set_time() plays, later ones take precedence; empty if everything is at rest

  std::vector<MovingNode> nodes;
  std::vector<std::vector<double>> weights;  // values at rest
  std::vector<Skin> skins;
  std::vector<Deformation> deformations;
  std::vector<MovingInstance> instances;
  std::vector<Lamp> lamps;  // at rest
  std::vector<MovingLight> lights;
  std::vector<MovingView> views;
  std::vector<MovingMaterial> materials;  // at rest
};

// The last key of the playing clips, in seconds; 0 if nothing moves.
double length_of(const Animation& animation);

// Selects the playing clips: the clip of that name or, with an empty name, every clip that animates nothing that an
// earlier one does (files contain one clip per object, or several takes of one figure). Returns false if no clip has
// that name.
bool play(Animation& animation, const std::string& name);

}  // namespace ods
