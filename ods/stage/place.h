// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the viewer is: on a floor in a place, before an object, at a camera of the file.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "ods/stage/unit.h"

namespace ods {

// Where the viewer is put.
//  - In a place: at Stand::eye, facing things rather than walls, and along the length of a street: best_yaw() in
//    facing.h.
//  - Before an object: level with its middle or a little above, of a flat one 30 degrees above, as near as it is seen
//  60
//    degrees wide at most and no part of it, however it turns, is nearer than kElbowRoom; on its +Z side, which glTF
//    calls the front, unless something is in the way there or only its edge would be seen.
// Lengths are in the scene's units. Precondition: survey.kind is not kNothing.
Viewing place_viewer(const SceneRays& rays, const Survey& survey, float metres_per_unit = 1.0f);

struct Settled {
  SceneKind kind = SceneKind::kNothing;
  float metres_per_unit = 1.0f;
  std::string unit_reason;    // why that is not 1; empty if it is, or was given
  std::string camera_reason;  // why the file's first camera is not used; empty if it is, or there is none
  bool doubted = false;       // it may as well be the other one of object and place
};

// Which of the file's cameras is used.
enum class CameraChoice {
  kFirst,  // unless the whole scene is a speck to it: seen within kSpeck degrees
  kNamed,  // by the user
  kNone,
};
inline constexpr float kSpeck = 10.0f;

// Of the words after --camera: a name, "none", or nothing.
CameraChoice camera_choice(std::string_view words);

struct SettleOptions {
  std::optional<float> metres_per_unit{};  // none: guess_unit()
  bool shows_models = true;                // as in guess_unit()
  TakenFor taken_for = TakenFor::kAuto;
  CameraChoice camera = CameraChoice::kFirst;
};

// What else needs the rays of the settled scene and what they found, so that nobody traces them again.
using LookAround = std::function<void(const SceneRays& rays, const Survey& survey)>;

// Gives a scene its size in metres and its viewer: guesses the unit, unless it is given, scales the scene by it, and
// sets Scene::viewing. A scene without anything visible is left as it is, but for a unit that is given. An object that
// a camera of the file looks at keeps its size. look: called once, when all that is done.
Settled settle(Scene& scene, const SettleOptions& options = {}, const LookAround& look = {});

// In words, if it is in doubt what a scene is: what else it may be, and the option that says so.
std::string settle_doubt(SceneKind kind);

// What is wrong with a viewer at a point, in words for a warning that starts with "the camera"; empty: nothing. The
// scene is in metres.
std::string view_fault(const SceneRays& rays, vec3 eye);

}  // namespace ods
