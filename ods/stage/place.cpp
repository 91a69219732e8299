// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ods {

namespace {

constexpr int kAzimuths = 72;
constexpr float kElevations[] = {-35.0f, -20.0f, -10.0f, 0.0f, 10.0f, 20.0f, 35.0f};
constexpr int kRows = static_cast<int>(std::size(kElevations));

// In degrees.
vec3 toward(float yaw, float elevation) {
  return direction_of(glm::radians(yaw), glm::radians(elevation));
}

// How much there is to see in a direction, compared with the directions beside and below: edges and other things count
// more than a bare wall, a wall more than the sky.
float interest(const Sight& sight, const Sight& beside, const Sight& below) {
  if (sight.leaves() || !sight.front) return 0.0f;
  const auto differs = [&](const Sight& other) {
    return other.instance != sight.instance || dot(other.normal, sight.normal) < 0.94f;
  };
  return 0.2f + (differs(beside) ? 0.5f : 0.0f) + (differs(below) ? 0.5f : 0.0f);
}

// The yaw, in degrees, around which there is most to see within 60 degrees to both sides.
float best_yaw(const SceneRays& rays, vec3 eye) {
  constexpr float kStep = 360.0f / kAzimuths;
  std::vector<Sight> sights;
  for (int i = 0; i < kAzimuths; i++) {
    for (const float elevation : kElevations) {
      sights.push_back(rays.look(eye, toward(kStep * static_cast<float>(i), elevation)));
    }
  }
  std::vector<float> columns(kAzimuths);
  for (int i = 0; i < kAzimuths; i++) {
    for (int row = 0; row < kRows; row++) {
      const auto at = [&](int azimuth, int r) -> const Sight& {
        return sights[static_cast<size_t>(azimuth * kRows + r)];
      };
      columns[static_cast<size_t>(i)] +=
          interest(at(i, row), at((i + kAzimuths - 1) % kAzimuths, row), at(i, std::max(row - 1, 0)));
    }
  }
  float best = -1.0f, yaw = 0.0f;
  for (int i = 0; i < kAzimuths; i++) {
    float sum = 0.0f;
    for (int off = -12; off <= 12; off++) {
      const float weight = std::cos(glm::radians(kStep * static_cast<float>(off)));
      sum += weight * columns[static_cast<size_t>((i + off + kAzimuths) % kAzimuths)];
    }
    if (sum <= best * 1.001f) continue;  // of equal views, the first to the right of -Z
    best = sum;
    yaw = kStep * static_cast<float>(i);
  }
  return yaw > 180.0f ? yaw - 360.0f : yaw;
}

Viewing before_object(const SceneRays& rays, const Survey& survey, float unit) {
  const Bounds& core = survey.core;
  const vec3 size = core.high - core.low;
  Viewing viewing;
  viewing.is_object = true;
  viewing.middle = 0.5f * (core.low + core.high);
  const float distance = std::max(kObjectDistance / unit, distance_to_see(rays.scene(), core));
  const float above = std::min(0.15f * size.y, 0.15f / unit);
  for (const float turn : {0.0f, 30.0f, -30.0f, 60.0f, -60.0f, 90.0f, -90.0f, 135.0f, -135.0f, 180.0f}) {
    const float yaw = turn;
    const vec3 eye = viewing.middle - toward(yaw, 0.0f) * distance + vec3(0.0f, above, 0.0f);
    if (turn == 0.0f) viewing.view.position = eye;  // if something is in the way everywhere
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
