// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What kind of scene this is, and where somebody could stand in it: found by rays, as nothing in a file says so.
#pragma once
#include <functional>
#include <optional>
#include <string_view>

#include "ods/base/names.h"
#include "ods/stage/scene_rays.h"

namespace ods {

enum class SceneKind {
  kNothing,     // no visible triangle
  kObject,      // to be looked at from outside
  kOpenPlace,   // to be in, open upwards; without a floor if things float on all sides
  kClosedRoom,  // to be in, closed upwards but for windows
};
inline constexpr NameRow<SceneKind> kSceneKindTable[] = {
    {SceneKind::kNothing, "nothing"},
    {SceneKind::kObject, "an object"},
    {SceneKind::kOpenPlace, "an open place"},
    {SceneKind::kClosedRoom, "a closed room"},
};
static_assert(has_every_member(kSceneKindTable));
constexpr std::string_view scene_kind_name(SceneKind kind) {
  return name_in(kSceneKindTable, kind);
}

// What a scene is to be taken for.
enum class TakenFor { kAuto, kObject, kPlace };
inline constexpr NameRow<TakenFor> kTakenForTable[] = {
    {TakenFor::kAuto, "auto"},
    {TakenFor::kObject, "object"},
    {TakenFor::kPlace, "place"},
};
static_assert(has_every_member(kTakenForTable));

// The eyes of a viewer, metres: how high above the floor, and how far from everything.
inline constexpr float kEyeHeight = 1.6f;
inline constexpr float kLeastEyeHeight = 1.0f;  // where the ceiling is low
inline constexpr float kElbowRoom = 0.6f;

// A place with more of the upper directions blocked than this is a closed room.
inline constexpr float kOpenUpwards = 0.1f;

// Where somebody can be: the point between the eyes. Lengths are in the scene's units.
struct Stand {
  vec3 eye{0.0f};
  std::optional<float> floor;  // the height of the floor below; none: floating
  float headroom = 0.0f;       // from floor to ceiling; infinite under the sky
  float walls = 0.0f;          // share of the horizon that is blocked just above eye level
  float worth = 0.0f;          // how much there is to see, to compare stands
  Openness open;
};

// Lengths are in the scene's units.
struct Survey {
  SceneKind kind = SceneKind::kNothing;
  Bounds bounds;               // of all that is visible
  Bounds core;                 // of most of its triangles: without a sky dome, a huge ground, or what was left far away
  bool has_light = false;      // has_light() of ods/scene/scene.h
  std::optional<Stand> stand;  // the best one, for places
  std::optional<Stand> refused;  // an object's: somebody could stand there, but it does not look like a place
  bool doubted = false;          // it may as well be the other one of object and place
};

// metres_per_unit: how large the viewer is in the scene; 1 for a scene in metres. The scene is judged as it stands, at
// its present time: is_object() of ods/stage/object_or_place.h, unless `taken_for` says what it is. A place in which
// nobody can stand is an object all the same.
Survey survey(const SceneRays& rays, float metres_per_unit = 1.0f, TakenFor taken_for = TakenFor::kAuto);

// Bounds that leave out the few triangles far away from all others. Both corners 0 if nothing is visible.
Bounds core_bounds(const Scene& scene);

// How far from the middle of the core somebody has to be, level with it, so that whatever is in the core is seen within
// 30 degrees of straight ahead, to all sides and however it turns about its vertical axis. A ball's diameter.
float distance_to_see(const Scene& scene, const Bounds& core);

// Calls `look` with points outside, all around, and directions to the core from there.
void for_views_from_outside(const Bounds& core, int count, const std::function<void(vec3 from, vec3 way)>& look);

// The share of surfaces that show their backs to a viewer outside: 0 for solid objects, 1 for rooms without outer
// walls.
float backs_seen_outside(const SceneRays& rays, const Bounds& core);

}  // namespace ods
