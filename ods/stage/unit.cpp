// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ods/base/error.h"
#include "ods/scene/motion.h"
#include "ods/scene/placement.h"

namespace ods {

namespace {

constexpr float kUsualRoom = 2.7f;  // metres from floor to ceiling

float extent(const Bounds& box) {
  const vec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

// Returns whether the upper corners are visible from high above the stand, as in a room; under a dome they are not.
bool is_boxy(const SceneRays& rays, const Bounds& box, const Stand& stand) {
  const vec3 middle = 0.5f * (box.low + box.high), half = 0.5f * (box.high - box.low);
  const vec3 from(stand.eye.x, *stand.floor + 0.8f * stand.headroom, stand.eye.z);
  int seen = 0;
  for (const vec3& corner : {vec3(-1, 1, -1), vec3(1, 1, -1), vec3(-1, 1, 1), vec3(1, 1, 1)}) {
    const vec3 way = middle + 0.85f * half * corner - from;
    if (rays.distance(from, normalize(way)) > length(way)) seen++;
  }
  return seen >= 2;
}

std::string unit_text(float metres) {
  const UnitRow* const row = unit_of(metres);
  return row ? std::string(row->plural) : fmt::format("{:g} m", metres);
}

// The ratio of a height to the height of a usual room, as a logarithm.
float strangeness(float height) {
  return std::abs(std::log(height / kUsualRoom));
}

UnitGuess with_unit(const SceneRays& rays, float metres, TakenFor taken_for, const std::string& what) {
  return {metres, fmt::format("{}, so its unit is taken for {}", what, unit_text(metres)),
          survey(rays, metres, taken_for)};
}

// Handles a room or place that is too large. Rooms of that height do not exist, so an apparent object may be one, too.
std::optional<UnitGuess> smaller_place(const SceneRays& rays, const Survey& own, TakenFor taken_for) {
  const std::optional<Stand>& stand = own.stand ? own.stand : own.refused;
  if (!stand || !stand->floor || taken_for == TakenFor::kObject) return std::nullopt;
  if (stand->open.upper <= kOpenUpwards && std::isfinite(stand->headroom) && stand->headroom > kHighestRoom &&
      is_boxy(rays, own.bounds, *stand)) {
    const float units[] = {0.0254f, 0.01f, 0.001f};
    const float best = *std::min_element(std::begin(units), std::end(units), [&](float a, float b) {
      return strangeness(stand->headroom * a) < strangeness(stand->headroom * b);
    });
    return with_unit(rays, best, TakenFor::kPlace, fmt::format("the room is {:.4g} m high", stand->headroom));
  }
  if (own.kind == SceneKind::kOpenPlace && extent(own.core) > kWidestPlace) {
    const float metres = extent(own.core) * 0.01f <= kWidestPlace ? 0.01f : 0.001f;
    return with_unit(rays, metres, taken_for, fmt::format("the place is {:.4g} km wide", extent(own.core) * 1e-3f));
  }
  return std::nullopt;
}

// Handles a room that is too small to stand in.
std::optional<UnitGuess> larger_room(const SceneRays& rays, const Survey& own, TakenFor taken_for) {
  if (taken_for == TakenFor::kObject || own.refused) return std::nullopt;
  if (extent(own.core) >= kSmallestPlace && backs_seen_outside(rays, own.core) < 0.5f) return std::nullopt;
  std::optional<UnitGuess> best;
  for (const float metres : {10.0f, 100.0f, 1000.0f}) {
    UnitGuess guess = with_unit(rays, metres, taken_for, fmt::format("the room is {:.2g} m wide", extent(own.core)));
    if (guess.survey.kind != SceneKind::kClosedRoom) continue;
    const float height = guess.survey.stand->headroom * metres;
    if (!best || strangeness(height) < strangeness(best->survey.stand->headroom * best->metres)) best = guess;
  }
  return best;
}

// Handles an object that is shown as a model.
UnitGuess model(const SceneRays& rays, Survey own) {
  const float size = distance_to_see(rays.scene(), own.core);
  const bool fits = size >= kSmallestObject && size <= kLargestObject;
  if (fits || size <= 0.0f) return {1.0f, "", std::move(own)};
  const float exact = std::clamp(kModelSize / size, kMinUnit, kMaxUnit);
  const float metres = std::strtof(fmt::format("{:.3g}", exact).c_str(), nullptr);  // so that users can repeat it
  const float longest = extent(own.core);
  const std::string what =
      longest < 1.0f ? fmt::format("{:.3g} cm", 100.0f * longest) : fmt::format("{:.4g} m", longest);
  return {metres, fmt::format("the object is {} long: it is shown as a model of {:.2g} m", what, longest * metres),
          std::move(own)};
}

void scale_animation(Animation& animation, double factor) {
  const glm::dmat4 scaling(glm::dvec4(factor, 0, 0, 0), glm::dvec4(0, factor, 0, 0), glm::dvec4(0, 0, factor, 0),
                           glm::dvec4(0, 0, 0, 1));
  for (MovingNode& node : animation.nodes) {
    if (node.parent == -1) node.before = scaling * node.before;
  }
  for (MovingInstance& moving : animation.instances) {
    const bool skinned =
        moving.deformation != -1 && animation.deformations[static_cast<size_t>(moving.deformation)].skin != -1;
    if (moving.node == -1 && !skinned) moving.local = scaling * moving.local;  // joints place a skinned mesh
  }
  for (Lamp& lamp : animation.lamps) lamp.intensity *= factor * factor, lamp.range *= factor;
  for (Clip& clip : animation.clips) {
    for (Track& track : clip.tracks) {
      if (track.property != Property::kLampIntensity && track.property != Property::kLampRange) continue;
      const double scale = track.property == Property::kLampRange ? factor : factor * factor;
      for (float& value : track.keys.values) value = static_cast<float>(double{value} * scale);
    }
  }
}

}  // namespace

const UnitRow* unit_of(float metres) {
  const auto* const row = std::ranges::find(kUnitTable, metres, &UnitRow::metres);
  return row == std::end(kUnitTable) ? nullptr : row;
}

UnitGuess guess_unit(const SceneRays& rays, bool shows_models, TakenFor taken_for) {
  Survey own = survey(rays, 1.0f, taken_for);
  if (own.kind == SceneKind::kNothing) return {1.0f, "", std::move(own)};
  if (std::optional<UnitGuess> place = smaller_place(rays, own, taken_for)) return std::move(*place);
  if (own.stand) return {1.0f, "", std::move(own)};
  if (std::optional<UnitGuess> room = larger_room(rays, own, taken_for)) return std::move(*room);
  if (!shows_models) return {1.0f, "", std::move(own)};
  return model(rays, std::move(own));
}

void scale_scene(Scene& scene, float factor) {
  assert(factor >= kMinUnit && factor <= kMaxUnit && scene.animation.playing.empty());
  if (factor == 1.0f) return;
  const Bounds bounds = scene_bounds(scene);
  const vec3 reach = max(glm::abs(bounds.low), glm::abs(bounds.high)) * factor;
  if (!(std::max({reach.x, reach.y, reach.z}) <= kFarthest)) {
    throw Error(ErrorKind::kInput,
                fmt::format("with a unit of {:g} m the scene would extend further than a million km; "
                            "`unit` m keeps its size",
                            factor));
  }
  std::erase(scene.warnings, reach_warning(scene));
  for (Instance& instance : scene.instances) {
    instance.row0 *= factor, instance.row1 *= factor, instance.row2 *= factor;
  }
  for (PunctualLight& light : scene.lights) {
    light.position *= factor;
    light.range *= factor;
    if (light.kind != kLightDirectional) light.size *= factor;
    if (light.kind != kLightDirectional) light.intensity *= factor * factor;
  }
  for (ViewPoint& view : scene.view_points) view.position *= factor;
  if (scene.viewing) scene.viewing->view.position *= factor, scene.viewing->middle *= factor;
  for (Material& material : scene.materials) {
    if (std::isfinite(material.attenuation_distance)) material.attenuation_distance *= factor;
  }
  scale_animation(scene.animation, static_cast<double>(factor));
  set_time(scene, 0.0);
  if (std::string far = reach_warning(scene); !far.empty()) scene.warnings.push_back(std::move(far));
}

}  // namespace ods
