// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a scene's light, and what they supply where the scene has none.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/stage/light/lamp_unit.h"
#include "ods/stage/light/supply.h"

// As the user wrote them; empty: by default.
struct LightOptions {
  std::string environment;  // --env
  std::string lamp;         // --lamp
  std::string background;   // --background
  bool unlit = false;       // --unlit
  ods::LampUnit lamp_unit = ods::LampUnit::kAuto;
};

void add_light_options(Options& options, LightOptions& light);

// The file that --env or --background (option) names; empty for words, numbers and an empty word. Throws UsageError.
std::string environment_file(const std::string& option, const std::string& word);

// What they ask for. transparent: the picture has no background, and so no ground. confined_to: confining_folder().
// Throws UsageError, and Error(kInput) for files.
ods::LightWishes read_wishes(const LightOptions& light, bool transparent, const std::string& confined_to);

struct PlannedLight {
  ods::Survey survey;
  ods::LightPlan plan;
};

// Supplies light as the options ask, and whatever the scene lacks; a note says what. Scenes of ours have their own
// light (is_ours). planned: for the others, made with these wishes. Throws as read_wishes() does.
void light_scene(ods::Scene& scene, const LightOptions& light, ods::LightWishes wishes, bool is_ours,
                 const std::string& confined_to, PlannedLight planned);
