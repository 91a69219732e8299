// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Places the viewer: on a floor in a place, in front of an object, or at a camera of the file.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "ods/stage/unit.h"

namespace ods {

// Places the viewer.
// - In a place: at Stand::eye, facing objects instead of walls, and along the length of a street: best_yaw() in
//   facing.h.
// - In front of an object: level with its middle or slightly above, 30 degrees above a flat one. The distance is the
//   smallest at which it is seen at most 60 degrees wide and no part of it, however it turns, is closer than
//   kElbowRoom. The viewer is on its +Z side, which glTF calls the front, unless something is in the way there or only
//   its edge would be visible.
// Lengths are in the scene's units. Precondition: survey.kind is not kNothing.
Viewing place_viewer(const SceneRays& rays, const Survey& survey, float metres_per_unit = 1.0f);

struct Settled {
  SceneKind kind = SceneKind::kNothing;
  float metres_per_unit = 1.0f;
  std::string unit_reason;    // the reason if the unit is not 1 and was not given; else empty
  std::string camera_reason;  // the reason why the file's first camera is not used; empty if it is, or there is none
  bool doubted = false;       // object and place are both plausible
};

// The camera of the file that is used.
enum class CameraChoice {
  kFirst,  // unless the whole scene appears as a speck in it: less than kSpeck degrees wide
  kNamed,  // named by the user
  kNone,
};
inline constexpr float kSpeck = 10.0f;

// Parses the value of --camera: a name, "none", or nothing.
CameraChoice camera_choice(std::string_view words);

struct SettleOptions {
  std::optional<float> metres_per_unit{};  // guess_unit() if not set
  bool shows_models = true;                // as in guess_unit(): false if a position is given, in the file's units
  TakenFor taken_for = TakenFor::kAuto;
  CameraChoice camera = CameraChoice::kFirst;
};

// A callback for other analyses of the settled scene that need its rays and survey, so that they are not computed
// again.
using LookAround = std::function<void(const SceneRays& rays, const Survey& survey)>;

// Gives a scene its size in metres and its viewer: guesses the unit, unless it is given, scales the scene by it, and
// sets Scene::viewing. A scene without visible surfaces is not changed, except by a given unit. An object seen by a
// camera of the file keeps its size. look: called once at the end. Throws Error(kInput) as scale_scene().
//
// The commands open a file with load_scene(); if why_on_its_back(), they load it again with SceneOptions::z_up; they
// call make_sheets_thin() and mark_outlines(), which say what real-time programs mean by some surfaces; then they settle
// it, and place the camera with camera_in() (ods/sequence/scene_camera.h). Built-in scenes are not settled.
Settled settle(Scene& scene, const SettleOptions& options = {}, const LookAround& look = {});

// A note for a scene of uncertain kind: the alternative, and the option for it.
std::string settle_doubt(SceneKind kind);

// The fault of a viewer's position, for a warning that starts with "the camera". Empty if it has none. The scene is in
// metres.
std::string view_fault(const SceneRays& rays, vec3 eye);

}  // namespace ods
