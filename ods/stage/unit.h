// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The unit of a scene. glTF is in metres by definition, but files of other units are common: a room that is 400 units
// wide because it was modelled in centimetres. Stereo needs the true size, because the eyes are 65 mm apart.
#pragma once
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "ods/base/names.h"
#include "ods/stage/survey.h"

namespace ods {

enum class LengthUnit { kMetre, kCentimetre, kMillimetre, kInch, kFoot, kKilometre };

struct UnitRow {
  LengthUnit member;
  std::string_view name;
  std::string_view plural;
  float metres;
};
inline constexpr UnitRow kUnitTable[] = {
    {LengthUnit::kMetre, "m", "metres", 1.0f},
    {LengthUnit::kCentimetre, "cm", "centimetres", 0.01f},
    {LengthUnit::kMillimetre, "mm", "millimetres", 0.001f},
    {LengthUnit::kInch, "in", "inches", 0.0254f},
    {LengthUnit::kFoot, "ft", "feet", 0.3048f},
    {LengthUnit::kKilometre, "km", "kilometres", 1000.0f},
};
static_assert(has_every_member(kUnitTable));

// The unit of this length; null if there is none.
const UnitRow* unit_of(float metres);

// The range of metres per unit.
inline constexpr float kMinUnit = 1e-6f;
inline constexpr float kMaxUnit = 1e6f;

// Limits between plausible sizes and wrong units, metres.
inline constexpr float kSmallestPlace = 0.05f;   // size of a whole room: even a doll's house is larger
inline constexpr float kHighestRoom = 100.0f;    // floor to ceiling: higher than any cathedral's nave or hangar
inline constexpr float kWidestPlace = 20000.0f;  // a landscape up to the horizon
inline constexpr float kSmallestObject = 0.5f;   // smaller ones are specks at arm's length and beyond,
inline constexpr float kLargestObject = 5.0f;    // larger ones are too far away for stereo if they are to be seen whole
inline constexpr float kModelSize = 1.3f;        // the size at which such objects are shown

struct UnitGuess {
  float metres = 1.0f;  // per unit of the file
  std::string reason;   // for users, if it is not 1: "the room is 260 m high, so its unit is taken for centimetres"
  Survey survey;        // survey of the scene with that unit, in the file's units
};

// Guesses the unit of a scene: metres, unless real rooms, places and objects do not have that size.
// - For a box-shaped room that is too high, the unit is the one among inches, centimetres and millimetres that brings
//   its height closest to 2.7 m; for a place that is too wide, it is centimetres or millimetres.
// - A room too small to stand in is enlarged by 10, 100 or 1000, if it is smaller than kSmallestPlace or its walls show
//   their backs to the outside.
// - An object on its own is shown as a model of kModelSize if it is smaller than kSmallestObject or larger than
//   kLargestObject: a picture of a ring or of a tower at its own size would show hardly any stereo. Its size is
//   distance_to_see(). Not if shows_models is false, because places in the scene are given in the file's units, or a
//   camera of the file is used.
// taken_for: as in survey().
UnitGuess guess_unit(const SceneRays& rays, bool shows_models = true, TakenFor taken_for = TakenFor::kAuto);

// Multiplies all lengths of a scene: instances, lights and their range, view points, volumes, and animated values. The
// picture does not change, except that the eyes are smaller or larger: the power of point and spot lights is multiplied
// by the square of the factor, so that they light their surroundings as before; directional lights, emission and
// environment do not depend on lengths. Leaves the scene at rest, at time 0. Precondition: kMinUnit <= factor <=
// kMaxUnit, and no clip plays.
// Throws Error(kInput) if the scene would extend further than kFarthest (ods/scene/placement.h).
void scale_scene(Scene& scene, float factor);

}  // namespace ods
