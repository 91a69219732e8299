// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The quality and cost of a picture: the options that ods render and ods video share.
#pragma once
#include <optional>
#include <string_view>

#include "cli/console/options.h"
#include "ods/render/render_options.h"

struct RenderJob;

// A preset of --quality.
struct QualityPreset {
  std::string_view name;
  int width;
  int samples;
  float noise;
  bool exact;  // no light cache, no straight caustics
};

// The preset, and the options that override it besides --width.
struct Quality {
  QualityPreset preset;
  std::optional<int> samples;
  std::optional<float> noise;
  std::optional<ods::Indirect> indirect;
  std::optional<ods::Caustics> caustics;
};

// Adds the options in a group of their own. finish_quality() applies them and the preset to job.render.
void add_quality_options(Options& options, RenderJob& job);
void finish_quality(RenderJob& job);
