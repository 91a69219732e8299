// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods denoise.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "cli/options/picture_options.h"
#include "ods/denoise/denoise.h"
#include "ods/denoise/stored_noise.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

struct DenoiseJob {
  std::string input;
  std::string output;
  ods::FormatHint known;  // of the input
  ods::NoiseLayers layers;
  ods::DenoiseOptions options;
  bool oidn = false;  // instead of ours
  std::optional<ods::Layout> layout;
  DisplayOptions display;
  ProgressMode progress = ProgressMode::kAuto;
};

DenoiseJob parse_denoise(Options& options);
