// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ods/stage/facing.h"

namespace ods {

namespace {

// The elevation in degrees from which an object is seen: level if its height is a third of its width or more, and
// steeper the flatter it is.
float steepness(vec3 size) {
  constexpr float kFlat = 0.08f, kHigh = 0.35f, kSteepest = 30.0f;
  const float width = std::max({size.x, size.z, 1e-9f});
  return kSteepest * std::clamp((kHigh - size.y / width) / (kHigh - kFlat), 0.0f, 1.0f);
}

Viewing before_object(const SceneRays& rays, const Survey& survey, float unit) {
  constexpr float kThin = 0.12f;
  const Bounds& core = survey.core;
  const vec3 size = core.high - core.low;
  Viewing viewing;
  viewing.is_object = true;
  viewing.middle = 0.5f * (core.low + core.high);
  const float to_see = distance_to_see(rays.scene(), core);
  const float distance = std::max(to_see, 0.5f * to_see + 1.02f * kElbowRoom / unit);  // the radius is <= to_see / 2
  const float above =
      std::max(distance * std::tan(glm::radians(steepness(size))), std::min(0.15f * size.y, 0.15f / unit));
  const float front = size.x < kThin * size.z ? -90.0f : 0.0f;  // from +X, instead of its edge
  bool first = true;
  for (const float aside : {0.0f, 30.0f, -30.0f, 60.0f, -60.0f, 90.0f, -90.0f, 135.0f, -135.0f, 180.0f}) {
    const float yaw = front + aside <= -180.0f ? front + aside + 360.0f : front + aside;
    const vec3 eye = viewing.middle - direction_at(yaw, 0.0f) * distance + vec3(0.0f, above, 0.0f);
    if (!std::exchange(first, false) && free_radius(rays, eye) * unit < kElbowRoom) continue;
    viewing.view.position = eye;  // the first one is kept if something is in the way everywhere
    viewing.view.yaw = yaw;
    if (free_radius(rays, eye) * unit >= kElbowRoom) break;
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

CameraChoice camera_choice(std::string_view words) {
  if (words.empty()) return CameraChoice::kFirst;
  return words == "none" ? CameraChoice::kNone : CameraChoice::kNamed;
}

// Returns the reason why a camera is not used. Empty if it is.
static std::string speck_seen_by(const ViewPoint& camera, const Bounds& core) {
  const float distance = length(camera.position - 0.5f * (core.low + core.high));
  const float angle = glm::degrees(2.0f * std::atan2(0.5f * length(core.high - core.low), distance));
  if (angle >= kSpeck || !(angle > 0.0f)) return "";  // 0 if nothing is visible at all
  return fmt::format("the whole scene is a speck in the file's camera '{}', {:.2g} degrees wide", camera.name, angle);
}

// Returns whether the size of the scene may be chosen.
static bool chooses_size(const Scene& scene, const SettleOptions& options, const Settled& settled) {
  const bool has_camera = !scene.view_points.empty() && options.camera != CameraChoice::kNone;
  return options.shows_models && (!has_camera || !settled.camera_reason.empty());
}

Settled settle(Scene& scene, const SettleOptions& options, const LookAround& look) {
  Settled settled;
  if (options.camera == CameraChoice::kFirst && !scene.view_points.empty()) {
    settled.camera_reason = speck_seen_by(scene.view_points.front(), core_bounds(scene));
  }
  {
    const SceneRays rays(scene);
    const UnitGuess guess =
        options.metres_per_unit
            ? UnitGuess{*options.metres_per_unit, "", survey(rays, *options.metres_per_unit, options.taken_for)}
            : guess_unit(rays, chooses_size(scene, options, settled), options.taken_for);
    settled.kind = guess.survey.kind, settled.doubted = guess.survey.doubted;
    settled.metres_per_unit = guess.metres, settled.unit_reason = guess.reason;
    if (settled.kind != SceneKind::kNothing) {
      scene.viewing = place_viewer(rays, guess.survey, guess.metres);
      scene.viewing->replaces_cameras = options.camera == CameraChoice::kNone || !settled.camera_reason.empty();
    }
    if (look && guess.metres == 1.0f) look(rays, guess.survey);
  }
  if (settled.metres_per_unit == 1.0f) return settled;
  scale_scene(scene, settled.metres_per_unit);
  if (!look) return settled;
  const SceneRays rays(scene);
  look(rays, survey(rays, 1.0f, settled.kind == SceneKind::kObject ? TakenFor::kObject : TakenFor::kPlace));
  return settled;
}

std::string settle_doubt(SceneKind kind) {
  if (kind == SceneKind::kObject)
    return "taken for an object, but somebody could stand in it: `as` place if it is a place";
  return "taken for a place, but closed from all sides like an object: `as` object or `unit` cm if it is one";
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
