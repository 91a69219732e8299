// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Adds light to scenes that lack it. An object on its own gets a studio and a ground that catches its shadow; objects
// that float on all sides get the studio without a ground, in front of a black background; a place that is open upwards
// gets a sky with a sun, and so does a room with windows; a closed room gets a lamp near its ceiling; a scene whose
// colours include their lighting is shown as it is painted. A scene with light is not changed.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/stage/light/baked.h"
#include "ods/stage/light/lamp.h"
#include "ods/stage/light/sky.h"
#include "ods/stage/survey.h"

namespace ods {

enum class Surround {
  kAuto,    // adds the missing light
  kStudio,  // ods/stage/light/studio.h
  kSky,     // ods/stage/light/sky.h
  kGiven,   // a picture or a colour
};

enum class LampChoice { kAuto, kNone, kPlaced };

struct LightChoices {
  Surround surround = Surround::kAuto;
  SkyOptions sky;     // for kSky, if specified
  Environment given;  // for kGiven
  LampChoice lamp = LampChoice::kAuto;
  vec3 lamp_position{0.0f};  // for kPlaced
  bool unlit = false;        // shows all colours as painted
  bool ground = true;        // objects in a studio or under a sky get a ground
  float yaw = 0.0f;          // viewer's yaw, for the studio; degrees
  float turn = 0.0f;         // of the light from all around, degrees clockwise seen from above
  float strength = 1.0f;     // multiplies it
};

struct LightPlan {
  bool has_light = false;  // the scene's own light reaches the viewer
  float windows = 0.0f;    // for a closed room: the fraction of directions that lead outside
  Paint paint = Paint::kLit;
  bool as_painted = false;           // make every material unlit
  std::optional<Surround> surround;  // replaces the scene's environment, if set
  bool ground = false;
  SkyOptions sky;  // for kSky
  std::optional<CeilingLamp> lamp;
  std::string advice;  // one line: the fault of the scene's own light, and the option that adds light; else empty
  std::string note;    // one line for the user: the added light, the reason, and the option to change it; else empty
};

// A closed room with more windows than this is lit from outside only, and rendered as dark as it is.
inline constexpr float kWindows = 0.003f;

// Decides which light to add. Deterministic.
LightPlan plan_light(const SceneRays& rays, const Survey& survey, const LightChoices& choices = {});

// Adds the light: changes the scene's environment, background, materials and instances, and sets Scene::supplied.
// Turns and multiplies the environment and the background, the scene's own ones as well. A turn by a fraction of a
// texel mixes neighbours linearly, as the kernel's look-up does; it keeps the picture's total light.
void apply_light(Scene& scene, const Survey& survey, const LightPlan& plan, const LightChoices& choices = {});

// The sun that lights most of the surfaces visible from a point, among several directions at elevations of 35 to 65
// degrees: low ones are preferred, and among equals the default.
SkyOptions best_sun(const SceneRays& rays, vec3 eye);

// The brightness of the light from the scene's emissive surfaces: their power over the power of the whole surface at a
// radiance of 1.
float emission_level(const Scene& scene);

}  // namespace ods
