// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods merge.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/render/render_job.h"
#include "ods/render/unfinished.h"

// The options of ods merge.
struct MergeOptions {
  std::vector<std::string> parts;  // as given; # matches any number
  RenderJob render;                // how the picture is finished
  std::optional<ods::Layout> layout;
  DisplayOptions display;
  float brighter = 0.0f;      // stops, added to the exposure
  bool remove_parts = false;  // when the picture is saved
  bool incomplete = false;    // make the picture even if parts are missing
};

struct MergeJob {
  std::vector<std::string> parts;  // files, in the order of the parts' numbers; none: there are samples
  ods::SampledPicture picture;     // whole, with the layers that finishing it needs
  ods::PictureSamples samples;     // that an interrupted run has kept
  ods::StereoCamera camera;
  ods::Layout layout = ods::Layout::kTopBottom;  // as rendered
  RenderJob render;                              // how the picture is finished
};

MergeOptions parse_merge(Options& options);

// Returns whether an earlier run has merged and removed the parts: a farm may run a task twice.
bool are_merged(const MergeOptions& given);

// Opens the parts. Throws UsageError and ods::Error if they do not make a picture.
MergeJob open_parts(const MergeOptions& given);
