// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "ods/scene/load/load.h"
#include "ods/stage/light/lamp_unit.h"
#include "ods/stage/light/supply.h"
#include "ods/stage/place.h"

// A file as loaded by ods render, with the light that it lacks.
inline ods::Scene lit_scene(const std::string& path) {
  using namespace ods;
  Scene scene = load_scene(path, {});
  if (lamps_are_in_watts(scene)) scale_lamps(scene, 1.0 / kLumensPerWatt);
  Survey seen;
  LightPlan plan;
  settle(scene, {}, [&](const SceneRays& rays, const Survey& survey) {
    seen = survey;
    plan = plan_light(rays, survey);
  });
  apply_light(scene, seen, plan);
  return scene;
}
