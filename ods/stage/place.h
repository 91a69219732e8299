// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the viewer is: on a floor in a place, before an object.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "ods/stage/unit.h"

namespace ods {

// Where the viewer is put.
//  - In a place: at Stand::eye, facing things rather than walls, and along the length of a street: best_yaw() in
//    facing.h.
//  - Before an object: level with its middle or a little above, as near as it is seen 60 degrees wide at most and no
//    part of it, however it turns, is nearer than kElbowRoom; on its +Z side, which glTF calls the front, unless
//    something is in the way there.
// Lengths are in the scene's units. Precondition: survey.kind is not kNothing.
Viewing place_viewer(const SceneRays& rays, const Survey& survey, float metres_per_unit = 1.0f);

struct Settled {
  SceneKind kind = SceneKind::kNothing;
  float metres_per_unit = 1.0f;
  std::string unit_reason;  // why that is not 1; empty if it is, or was given
};

// What else needs the rays of the settled scene and what they found, so that nobody traces them again.
using LookAround = std::function<void(const SceneRays& rays, const Survey& survey)>;

// Gives a scene its size in metres and its viewer: guesses the unit, unless it is given, scales the scene by it, and
// sets Scene::viewing. A scene without anything visible is left as it is, but for a unit that is given. shows_models:
// as in guess_unit(). look: called once, when all that is done.
Settled settle(Scene& scene, std::optional<float> metres_per_unit = std::nullopt, bool shows_models = true,
               const LookAround& look = {});

// What is wrong with a viewer at a point, in words for a warning that starts with "the camera"; empty: nothing. The
// scene is in metres.
std::string view_fault(const SceneRays& rays, vec3 eye);

}  // namespace ods
