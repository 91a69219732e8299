// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/object_or_place.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ods {

namespace {

constexpr int kDirections = 2048;
constexpr float kLevelNormal = 0.97f, kUprightNormal = 0.17f;  // about 10 to 15 degrees

using Triangles = std::set<std::pair<int, int>>;

Triangles seen_outside(const SceneRays& rays, const Bounds& core) {
  Triangles seen;
  for_views_from_outside(core, kDirections, [&](vec3 from, vec3 way) {
    const Sight sight = rays.look(from, way);
    if (!sight.leaves()) seen.insert({sight.instance, sight.triangle});
  });
  return seen;
}

float share(int part, int whole) {
  return whole == 0 ? 0.0f : static_cast<float>(part) / static_cast<float>(whole);
}

}  // namespace

PlaceSigns place_signs(const SceneRays& rays, const Survey& survey, float metres_per_unit) {
  const Stand& stand = *survey.stand;
  const vec3 size = survey.core.high - survey.core.low;
  PlaceSigns signs;
  signs.extent = std::max({size.x, size.y, size.z}) * metres_per_unit;
  signs.backs_outside = backs_seen_outside(rays, survey.core);
  signs.walls = stand.walls, signs.open = stand.open.upper;
  signs.has_floor = stand.floor.has_value();
  if (stand.floor && size.y > 0.0f) signs.below = (*stand.floor - survey.core.low.y) / size.y;
  Triangles inside;
  int hits = 0, backs = 0, level = 0;
  for (const vec3& way : sphere_directions(kDirections)) {
    const Sight sight = rays.look(stand.eye, way);
    if (sight.leaves()) continue;
    hits++;
    if (!sight.front) backs++;
    const float up = std::abs(sight.normal.y);
    if (up > kLevelNormal || up < kUprightNormal) level++;
    inside.insert({sight.instance, sight.triangle});
  }
  signs.backs_inside = share(backs, hits);
  signs.level = share(level, hits);
  signs.detail = static_cast<float>(inside.size()) /
                 static_cast<float>(std::max<size_t>(seen_outside(rays, survey.core).size(), 1));
  return signs;
}

bool is_object(const PlaceSigns& signs) {
  constexpr float kHollow = 0.15f, kClosed = 0.25f, kHighUp = 0.25f, kOnTop = 0.4f, kFewWalls = 0.25f;
  constexpr float kUpright = 0.8f, kWalled = 0.5f, kHall = 0.9f, kDetailed = 0.54f, kCourtyard = 0.9f;
  const bool is_hall = signs.level > kHall && signs.below <= kHighUp && signs.extent <= kLargestSolid;
  if (signs.backs_inside > kHollow && !is_hall) return true;
  if (signs.has_floor && signs.below > kOnTop && signs.walls < kFewWalls) return true;
  if (signs.backs_outside >= kClosed || !signs.has_floor) return false;
  const bool high_up = signs.below > kHighUp;
  if (signs.open > kOpenUpwards && signs.walls < kCourtyard && signs.extent > kLargestTop) return true;
  if (signs.extent > kLargestSolid) return high_up || signs.detail < kDetailed;
  return high_up && (signs.level < kUpright || signs.walls < kWalled);
}

}  // namespace ods
