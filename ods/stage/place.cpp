// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ods/stage/facing.h"

namespace ods {

namespace {

Viewing before_object(const SceneRays& rays, const Survey& survey, float unit) {
  const Bounds& core = survey.core;
  const vec3 size = core.high - core.low;
  Viewing viewing;
  viewing.is_object = true;
  viewing.middle = 0.5f * (core.low + core.high);
  const float to_see = distance_to_see(rays.scene(), core);
  const float distance = std::max(to_see, 0.5f * to_see + 1.02f * kElbowRoom / unit);  // its radius is at most the half
  const float above = std::min(0.15f * size.y, 0.15f / unit);
  for (const float yaw : {0.0f, 30.0f, -30.0f, 60.0f, -60.0f, 90.0f, -90.0f, 135.0f, -135.0f, 180.0f}) {
    const vec3 eye = viewing.middle - direction_at(yaw, 0.0f) * distance + vec3(0.0f, above, 0.0f);
    if (yaw == 0.0f) viewing.view.position = eye;  // if something is in the way everywhere
    if (free_radius(rays, eye) * unit < kElbowRoom) continue;
    viewing.view.position = eye;
    viewing.view.yaw = yaw;
    break;
  }
  viewing.view.name = fmt::format("{:.2g} m before the object", distance * unit);
  return viewing;
}

Viewing in_place(const SceneRays& rays, const Survey& survey, float unit) {
  const Stand& stand = *survey.stand;
  Viewing viewing;
  viewing.view.position = stand.eye;
  viewing.view.yaw = best_yaw(rays, stand.eye);
  viewing.middle = 0.5f * (survey.core.low + survey.core.high);
  if (!stand.floor) {
    viewing.view.name = "in free space with the scene around";
    return viewing;
  }
  const float height = (stand.eye.y - *stand.floor) * unit;
  viewing.view.name = fmt::format("{:.2g} m above the {}", height,
                                  survey.kind == SceneKind::kClosedRoom ? "floor of the room" : "ground of the place");
  return viewing;
}

}  // namespace

Viewing place_viewer(const SceneRays& rays, const Survey& survey, float metres_per_unit) {
  return survey.stand ? in_place(rays, survey, metres_per_unit) : before_object(rays, survey, metres_per_unit);
}

Settled settle(Scene& scene, std::optional<float> metres_per_unit, bool shows_models, const LookAround& look) {
  Settled settled;
  {
    const SceneRays rays(scene);
    const UnitGuess guess = metres_per_unit ? UnitGuess{*metres_per_unit, "", survey(rays, *metres_per_unit)}
                                            : guess_unit(rays, shows_models);
    settled = {guess.survey.kind, guess.metres, guess.reason};
    if (settled.kind != SceneKind::kNothing) scene.viewing = place_viewer(rays, guess.survey, guess.metres);
    if (look && guess.metres == 1.0f) look(rays, guess.survey);
  }
  if (settled.metres_per_unit == 1.0f) return settled;
  scale_scene(scene, settled.metres_per_unit);
  if (!look) return settled;
  const SceneRays rays(scene);
  look(rays, survey(rays));
  return settled;
}

std::string view_fault(const SceneRays& rays, vec3 eye) {
  constexpr float kCramped = 0.15f;  // metres
  const Surroundings around = surroundings(rays, eye);
  if (around.backs > 0.5f && around.backs > 9.0f * around.fronts) {
    return fmt::format("is inside a solid model: {:.0f} percent of what it sees are backs of surfaces",
                       100.0f * around.backs / (around.backs + around.fronts));
  }
  if (around.nearest >= kCramped) return "";
  const std::vector<vec3> directions = sphere_directions(256);
  const auto cramped = std::count_if(directions.begin(), directions.end(),
                                     [&](vec3 direction) { return rays.distance(eye, direction) < kCramped; });
  if (cramped > 230) {
    return fmt::format("is in a closed space: there are surfaces within {:.0f} cm on nearly all sides",
                       100.0f * kCramped);
  }
  return fmt::format("is {:.2g} cm from the nearest surface: nobody can look at that in stereo",
                     100.0f * around.nearest);
}

}  // namespace ods
