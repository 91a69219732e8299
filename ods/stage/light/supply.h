// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light that a scene lacks. An object on its own gets a studio and a ground that catches its shadow; things that
// float on all sides get the studio without a ground, before a black background; a place that is open upwards gets a
// sky with a sun, and so does a room with windows; a closed room gets a lamp near its ceiling; a scene whose colours
// hold their light already is shown as it is painted. A scene that has light keeps it as it is.
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
  kAuto,    // what the scene lacks
  kStudio,  // ods/stage/light/studio.h
  kSky,     // ods/stage/light/sky.h
  kGiven,   // a picture or a colour
};

enum class LampWish { kAuto, kNone, kPlaced };

struct LightWishes {
  Surround surround = Surround::kAuto;
  SkyOptions sky;     // for kSky, if it was asked for
  Environment given;  // for kGiven
  LampWish lamp = LampWish::kAuto;
  vec3 lamp_position{0.0f};  // for kPlaced
  bool unlit = false;        // shows all colours as they are painted
  bool ground = true;        // objects in a studio or under a sky get a ground
  float yaw = 0.0f;          // of the viewer, for the studio; degrees
};

struct LightPlan {
  bool has_light = false;  // the scene's own light reaches the viewer
  float windows = 0.0f;    // of a closed room: the share of directions that lead outside
  Paint paint = Paint::kLit;
  bool as_painted = false;           // make every material unlit
  std::optional<Surround> surround;  // to replace the scene's environment with; none: it stays
  bool ground = false;
  SkyOptions sky;  // for kSky
  std::optional<CeilingLamp> lamp;
  std::string advice;  // one line: what the scene's own light lacks, and the option that adds it; empty: nothing
  std::string note;    // one line for the user: what was supplied, why, and what changes it; empty: nothing was
};

// Of a closed room with more windows than this, light comes from outside only: it is rendered as dark as it is.
inline constexpr float kWindows = 0.003f;

// Decides what to supply. Deterministic.
LightPlan plan_light(const SceneRays& rays, const Survey& survey, const LightWishes& wishes = {});

// Supplies it: changes the scene's environment, background, materials and instances, and sets Scene::supplied.
void apply_light(Scene& scene, const Survey& survey, const LightPlan& plan, const LightWishes& wishes = {});

// The sun that lights most of what is visible from a point, among several directions at elevations of 35 to 65 degrees:
// low ones are preferred, and among equals the default.
SkyOptions best_sun(const SceneRays& rays, vec3 eye);

// How brightly the scene's emissive surfaces light it: their power over that of the whole surface at a radiance of 1.
float emission_level(const Scene& scene);

}  // namespace ods
