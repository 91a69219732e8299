// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How clean a picture becomes, and at what price: the options that ods render and ods video share.
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

// The preset, and the options that take precedence over it besides --width and --noise.
struct Quality {
  QualityPreset preset;
  std::optional<int> samples;
  std::optional<ods::Indirect> indirect;
  std::optional<ods::Caustics> caustics;
};

// Options in a group of their own, and what remains to be done after parsing.
void add_quality_options(Options& options, RenderJob& job, Quality& quality);
void finish_quality(const Options& options, const Quality& quality, RenderJob& job);
