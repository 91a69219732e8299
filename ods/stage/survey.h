// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Classifies a scene and finds standpoints by casting rays; files record neither.
#pragma once
#include <functional>
#include <optional>
#include <string_view>

#include "ods/base/names.h"
#include "ods/stage/scene_rays.h"

namespace ods {

enum class SceneKind {
  kNothing,     // no visible triangle
  kObject,      // seen from outside
  kOpenPlace,   // entered, open upwards; without a floor if objects float on all sides
  kClosedRoom,  // entered, closed upwards except for windows
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

// The kind of scene that the user specifies.
enum class TakenFor { kAuto, kObject, kPlace };
inline constexpr NameRow<TakenFor> kTakenForTable[] = {
    {TakenFor::kAuto, "auto"},
    {TakenFor::kObject, "object"},
    {TakenFor::kPlace, "place"},
};
static_assert(has_every_member(kTakenForTable));

// The position of a viewer's eyes, metres: height above the floor, and minimum distance from all surfaces.
inline constexpr float kEyeHeight = 1.6f;
inline constexpr float kMinEyeHeight = 1.0f;  // under a low ceiling
inline constexpr float kElbowRoom = 0.6f;

// A place with a larger fraction of the upper directions blocked is a closed room.
inline constexpr float kOpenUpwards = 0.1f;

// A position of the viewer: the point between the eyes. Lengths are in the scene's units.
struct Stand {
  vec3 eye{0.0f};
  std::optional<float> floor;  // height of the floor below; not set if floating
  float headroom = 0.0f;       // from floor to ceiling; infinite under the sky
  float walls = 0.0f;          // fraction of the horizon that is blocked just above eye level
  float worth = 0.0f;          // a measure of the visible surroundings, for comparing stands
  Openness open;
};

// Lengths are in the scene's units.
struct Survey {
  SceneKind kind = SceneKind::kNothing;
  Bounds bounds;                 // box around everything visible
  Bounds core;                   // box around most triangles: without a sky dome, huge ground, or stray objects
  bool has_light = false;        // has_light() of ods/scene/scene.h
  std::optional<Stand> stand;    // the best one, for places
  std::optional<Stand> refused;  // for objects: a person could stand there, but it does not look like a place
  bool doubted = false;          // object and place are both plausible
};

// metres_per_unit: the scale of the viewer in the scene; 1 for a scene in metres. Judges the scene in its present state
// with is_object() of ods/stage/object_or_place.h, unless `taken_for` specifies its kind. A place without a standpoint
// is an object in any case.
Survey survey(const SceneRays& rays, float metres_per_unit = 1.0f, TakenFor taken_for = TakenFor::kAuto);

// Bounds that leave out the few triangles far away from all others. Both corners are 0 if nothing is visible.
Bounds core_bounds(const Scene& scene);

// The distance from the middle of the core, level with it, at which everything in the core is seen within 30 degrees of
// straight ahead, to all sides and however it turns about its vertical axis. For a ball this is its diameter.
float distance_to_see(const Scene& scene, const Bounds& core);

// Calls `look` with points outside, all around, and directions to the core from there.
void for_views_from_outside(const Bounds& core, int count, const std::function<void(vec3 from, vec3 way)>& look);

// The fraction of surfaces that show their backs to a viewer outside: 0 for solid objects, 1 for rooms without outer
// walls.
float backs_seen_outside(const SceneRays& rays, const Bounds& core);

}  // namespace ods
