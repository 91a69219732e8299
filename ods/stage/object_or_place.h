// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Somebody can stand on a bed, and inside a watch that is 500 units long. Whether that is a place. Other rooms call
// survey().
#pragma once
#include "ods/stage/survey.h"

namespace ods {

// What speaks for an object or a place, seen from outside and from Survey::stand.
struct PlaceSigns {
  float extent = 0.0f;         // of the core, metres
  float backs_outside = 0.0f;  // backs_seen_outside(): of places seldom less than 0.3, but 0 if their walls are thick
  float backs_inside = 0.0f;   // share of the surfaces seen from the stand that show their backs
  float below = 0.0f;          // how far up in the core the floor is, as a share of its height
  float level = 0.0f;          // share of the surfaces seen from the stand that are level or upright
  float walls = 0.0f;          // Stand::walls
  float open = 0.0f;           // Openness::upper
  float detail = 0.0f;         // how many different triangles the stand sees, over how many are seen from outside
  bool has_floor = true;
};

// Precondition: there is a stand.
PlaceSigns place_signs(const SceneRays& rays, const Survey& survey, float metres_per_unit);

// Judged with files of twelve origins (bench/kinds_bench.cpp). An object is
//  - what shows the backs of its surfaces to whoever is inside: a hollow model. Not if its walls are upright, its floor
//    is level and at its bottom, and it is no larger than kLargestSolid: a room whose walls face outwards;
//  - what has nothing but air around whoever stands on it, high above its lowest part: a bed, a sheet of paper;
//  - what is closed from all sides, from below too, and larger than kLargestSolid: so large are objects in centimetres
//    or millimetres. Not if the floor is at its bottom and there is much to see inside;
//  - what is closed from below and the sides, but open above and without walls around, from kLargestTop on: a viewer on
//  a
//    smaller one would see its edge;
//  - what is closed, whatever its size, if somebody stands high up in it, and it is neither upright nor has walls.
bool is_object(const PlaceSigns& signs);

inline constexpr float kLargestSolid = 40.0f, kLargestTop = 30.0f;  // metres

}  // namespace ods
