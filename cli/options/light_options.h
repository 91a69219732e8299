// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a scene's light, and the light that they supply if the scene lacks it.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/stage/light/lamp_unit.h"
#include "ods/stage/light/supply.h"

// The options as the user wrote them; empty: the default.
struct LightOptions {
  std::string environment;  // --env
  std::string lamp;         // --lamp
  std::string background;   // --background
  bool unlit = false;       // --unlit
  float turn = 0.0f;        // --env-turn
  float strength = 1.0f;    // --env-strength
  ods::LampUnit lamp_unit = ods::LampUnit::kAuto;

  bool operator==(const LightOptions&) const = default;
};

void add_light_options(Options& options, LightOptions& light);

// Returns the file that --env or --background (option) names; empty for keywords, numbers and an empty value. Throws
// UsageError.
std::string environment_file(const std::string& option, const std::string& word);

// The sky that --env or --background (option) describes; nullopt if it is something else. Throws UsageError.
std::optional<ods::SkyOptions> described_sky(const std::string& option, const std::string& word);

// The value of --env for a sky.
std::string sky_word(const ods::SkyOptions& sky);

// Reads the options. transparent: the picture has no background, and so no ground. confined_to: confining_folder().
// Throws UsageError, and Error(kInput) for files.
ods::LightChoices read_choices(const LightOptions& light, bool transparent, const std::string& confined_to);

// Reads --background. Returns nullopt if the camera sees the light from all around. Throws as read_choices().
std::optional<ods::Environment> read_background(const std::string& word, const std::string& confined_to);

struct PlannedLight {
  ods::Survey survey;
  ods::LightPlan plan;
};

// Supplies the light that the options specify, and the light that the scene lacks, with a note. Built-in scenes have
// their own light (is_ours). planned: for other scenes, made with these choices. Throws as read_choices() does.
void light_scene(ods::Scene& scene, const LightOptions& light, ods::LightChoices choices, bool is_ours,
                 const std::string& confined_to, PlannedLight planned);
