// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/stands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace ods {

namespace {

constexpr int kGridColumns = 20;  // cells of the grid over the scene, each way
constexpr int kMaxStoreys = 24;   // maximum number of surfaces above each other that are examined
constexpr int kAzimuths = 16;
constexpr float kLevel = 0.7071f;                                      // minimum upward component of a floor's normal
constexpr float kElevations[] = {-20.0f, -10.0f, 5.0f, 20.0f, 40.0f};  // degrees: the directions examined from a stand

constexpr float kWithinSolid = 1e-3f;  // such a stand is worth less than any other

struct View {
  float worth = 0.0f;
  float near = 0.0f;   // fraction of the azimuths in which the ground reaches 4.4 m, or ends at a wall
  float far = 0.0f;    // fraction of the azimuths in which the ground reaches 9 m, or ends at a wall
  float walls = 0.0f;  // as Stand::walls
  float above = 0.0f;  // fraction of the directions above the horizon with visible surfaces
  float backs = 0.0f;  // fraction of the surfaces that show their backs
  bool shut = false;   // no direction leads outside

  // Inside a rock that contains other objects, or under the water of a lake; also in a room whose walls face outwards.
  bool is_within_solid() const { return shut && backs > 0.25f; }
};

View look_around(const SceneRays& rays, vec3 eye, float unit) {
  View view;
  int hits = 0, backs = 0, above = 0, near = 0, far = 0, walls = 0;
  float sum = 0.0f;
  std::set<std::pair<int, int>> seen;
  for (int i = 0; i < kAzimuths; i++) {
    for (const float elevation : kElevations) {
      const Sight sight = rays.look(eye, direction_at(360.0f / kAzimuths * static_cast<float>(i), elevation));
      if (sight.leaves()) continue;
      hits++;
      if (elevation == kElevations[0]) near++;
      if (elevation == kElevations[1]) far++;
      if (elevation == kElevations[2]) walls++;
      if (elevation > 0.0f) above++;
      if (!sight.front) {
        backs++;
        continue;
      }
      seen.insert({sight.instance, sight.triangle});
      sum += std::clamp((sight.distance * unit - kElbowRoom) / 2.0f, 0.0f, 1.0f);
    }
  }
  const float count = kAzimuths * std::size(kElevations);
  view.near = static_cast<float>(near) / kAzimuths;
  view.far = static_cast<float>(far) / kAzimuths;
  view.walls = static_cast<float>(walls) / kAzimuths;
  view.above = static_cast<float>(above) / (kAzimuths * 3.0f);
  view.backs = hits == 0 ? 0.0f : static_cast<float>(backs) / static_cast<float>(hits);
  view.shut = hits == static_cast<int>(count);
  view.worth = sum / count + 0.15f * static_cast<float>(seen.size()) / count;
  return view;
}

// The safety of the ground: 1 on a wide floor, less on a bed or a table from which one could fall, 0 on a ledge.
float footing(const SceneRays& rays, vec3 eye, float floor, float unit) {
  int level = 0, lower = 0;
  for (int i = 0; i < 8; i++) {
    const vec3 aside = direction_at(45.0f * static_cast<float>(i), 0.0f);
    const auto near = floor_below(rays, eye + aside * (0.5f / unit));
    if (near && std::abs(*near - floor) * unit < 0.35f) level++;
    const float reach = 1.5f / unit;
    if (rays.distance(eye, aside) < reach) continue;
    const auto far = floor_below(rays, eye + aside * reach);
    const float drop = far ? (floor - *far) * unit : 0.0f;
    if (drop > 0.25f && drop < 1.5f) lower++;
  }
  return level < 6 ? 0.0f : 1.0f - 0.5f * static_cast<float>(lower) / 8.0f;
}

// 1 in the middle of the core as seen from above, 0 at its edge.
float centrality(const Bounds& core, vec3 point) {
  const vec3 half = 0.5f * (core.high - core.low), off = glm::abs(point - 0.5f * (core.low + core.high));
  const float x = half.x > 0.0f ? off.x / half.x : 0.0f, z = half.z > 0.0f ? off.z / half.z : 0.0f;
  return std::clamp(1.0f - std::max(x, z), 0.0f, 1.0f);
}

// 1 in the middle of the core, 0 at its faces; for a viewer among objects on all sides.
float depth_within(const Bounds& core, vec3 point) {
  const vec3 off = glm::abs(point - 0.5f * (core.low + core.high)) / max(0.5f * (core.high - core.low), vec3(1e-9f));
  return std::clamp(1.0f - std::max({off.x, off.y, off.z}), 0.0f, 1.0f);
}

// Returns whether the ground has no object that extends above the eyes.
bool is_flat(const Bounds& core, float unit) {
  const vec3 size = core.high - core.low;
  return std::min(size.x, size.z) * unit >= 10.0f && size.y < 0.08f * std::max(size.x, size.z);
}

// Returns whether most of the scene is visible from a point: the walls of a room, as opposed to the inside of one
// object among many.
bool sees_max(const SceneRays& rays, const Bounds& core, vec3 eye) {
  const Bounds seen = seen_bounds(rays, eye);
  const vec3 seen_size = seen.high - seen.low, size = core.high - core.low;
  return seen_size.x * seen_size.y * seen_size.z >= 0.3f * size.x * size.y * size.z;
}

// A floor with its headroom; worth 0 if a person cannot stand there.
Stand judge_floor(const SceneRays& rays, const Bounds& core, vec3 foot, float headroom, float unit) {
  Stand stand;
  stand.floor = foot.y;
  stand.headroom = headroom;
  const float height = std::min(kEyeHeight, headroom * unit - kElbowRoom);
  if (height < kMinEyeHeight) return stand;
  stand.eye = foot + vec3(0.0f, height / unit, 0.0f);
  const float firm = footing(rays, stand.eye, foot.y, unit);
  if (firm == 0.0f || !is_free(rays, stand.eye, kElbowRoom / unit)) return stand;
  const View view = look_around(rays, stand.eye, unit);
  const bool surrounded = view.near >= 0.75f && view.far >= 0.6f && (view.above >= 0.05f || is_flat(core, unit));
  if (!surrounded || view.backs > 0.95f) return stand;
  stand.walls = view.walls;
  stand.worth = (view.worth + 0.4f * centrality(core, stand.eye)) * firm * height / kEyeHeight;
  if (view.is_within_solid()) stand.worth *= kWithinSolid;
  return stand;
}

// The best floor on a vertical line, from the top downwards.
Stand best_in_column(const SceneRays& rays, const Bounds& core, vec3 top, float unit) {
  Stand best;
  const vec3 down(0.0f, -1.0f, 0.0f);
  const float step = 1e-4f * std::max(length(core.high - core.low), 1e-6f);
  for (int storey = 0; storey < kMaxStoreys; storey++) {
    const Sight sight = rays.look(top, down);
    const vec3 foot = top + down * sight.distance;
    if (sight.leaves() || foot.y < core.low.y - step) break;
    if (sight.normal.y >= kLevel) {
      const float headroom = rays.distance(foot - down * step, -down);
      const Stand stand = judge_floor(rays, core, foot, headroom, unit);
      const bool within_solid = stand.worth < 3.0f * kWithinSolid;
      if (stand.worth > best.worth && !(within_solid && !sees_max(rays, core, stand.eye))) best = stand;
    }
    top = foot + down * step;
  }
  return best;
}

vec3 grid_point(const Bounds& core, vec3 share) {
  return core.low + (core.high - core.low) * share;
}

float cell(int i, int count) {
  return (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
}

}  // namespace

std::optional<Stand> best_stand(const SceneRays& rays, const Bounds& core, float metres_per_unit) {
  Stand best;
  const float above = 0.01f * length(core.high - core.low);
  for (int i = 0; i < kGridColumns; i++) {
    for (int k = 0; k < kGridColumns; k++) {
      vec3 top = grid_point(core, {cell(i, kGridColumns), 1.0f, cell(k, kGridColumns)});
      top.y += above;
      const Stand stand = best_in_column(rays, core, top, metres_per_unit);
      if (stand.worth > best.worth) best = stand;
    }
  }
  if (best.worth <= 0.0f) return std::nullopt;
  best.open = openness(rays, best.eye);
  return best;
}

std::optional<Stand> best_float(const SceneRays& rays, const Bounds& core, float metres_per_unit) {
  constexpr int kCells = 7, kSectors = 16, kMinSectors = 13, kMinThings = 12;
  constexpr float kSteep = 0.26f;  // the sine of 15 degrees: objects above and below do not surround the viewer
  static const std::vector<vec3> kDirections = sphere_directions(2048);
  Stand best;
  for (int cell_number = 0; cell_number < kCells * kCells * kCells; cell_number++) {
    const int x = cell_number % kCells, y = cell_number / kCells % kCells, z = cell_number / (kCells * kCells);
    const vec3 eye = grid_point(core, {cell(x, kCells), cell(y, kCells), cell(z, kCells)});
    if (!is_free(rays, eye, kElbowRoom / metres_per_unit)) continue;
    std::set<int> sectors, things;
    int fronts = 0, backs = 0;
    for (const vec3& direction : kDirections) {
      if (std::abs(direction.y) > kSteep) continue;
      const Sight sight = rays.look(eye, direction);
      if (sight.leaves()) continue;
      (sight.front ? fronts : backs)++;
      const float turn = std::atan2(direction.x, -direction.z) / (2.0f * std::numbers::pi_v<float>)+0.5f;
      sectors.insert(std::min(static_cast<int>(turn * kSectors), kSectors - 1));
      things.insert(sight.instance);
    }
    if (static_cast<int>(sectors.size()) < kMinSectors || things.size() < kMinThings || backs > fronts) continue;
    const float worth = static_cast<float>(fronts) / 512.0f + 0.6f * depth_within(core, eye);
    if (worth > best.worth) best = {eye, std::nullopt, std::numeric_limits<float>::infinity(), 0.0f, worth, {}};
  }
  if (best.worth <= 0.0f) return std::nullopt;
  best.open = openness(rays, best.eye);
  return best;
}

}  // namespace ods
