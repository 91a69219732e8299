// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Distinguishes objects from places. That a viewer fits is not enough: one can stand on a bed, or in a watch 500 units
// long. Other modules call survey().
#pragma once
#include "ods/stage/survey.h"

namespace ods {

// Evidence for an object or a place, seen from outside and from Survey::stand.
struct PlaceSigns {
  float extent = 0.0f;         // size of the core, metres
  float backs_outside = 0.0f;  // backs_seen_outside(): rarely less than 0.3 for places, but 0 if their walls are thick
  float backs_inside = 0.0f;   // fraction of the surfaces seen from the stand that show their backs
  float below = 0.0f;          // height of the floor in the core, relative to the core's height
  float level = 0.0f;          // fraction of the surfaces seen from the stand that are level or upright
  float walls = 0.0f;          // Stand::walls
  float open = 0.0f;           // Openness::upper
  float detail = 0.0f;         // number of different triangles seen from the stand, over the number seen from outside
  bool has_floor = true;
};

// Precondition: there is a stand.
PlaceSigns place_signs(const SceneRays& rays, const Survey& survey, float metres_per_unit);

// Criteria, tested with files of twelve origins (bench/kinds_bench.cpp). A scene is an object if
// - a viewer inside sees the backs of its surfaces: a hollow model. Exception: its walls are upright, its floor is
//   level and at its bottom, and it is no larger than kLargestSolid: a room whose walls face outwards;
// - a viewer on it is surrounded by nothing but air, high above its lowest part: a bed, a sheet of paper;
// - it is closed on all sides, including below, and larger than kLargestSolid, which is common for objects in
//   centimetres or millimetres. Exception: the floor is at its bottom and much detail is visible inside;
// - it is closed below and at the sides, but open above and without walls around, and larger than kLargestTop: a viewer
//   on a smaller one would see its edge;
// - it is closed, of any size, the viewer's floor is high up in it, and it is neither upright nor has walls.
bool is_object(const PlaceSigns& signs);

inline constexpr float kLargestSolid = 40.0f, kLargestTop = 30.0f;  // metres

}  // namespace ods
