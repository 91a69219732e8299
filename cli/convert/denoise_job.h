// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods denoise has to do.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "ods/denoise/denoise.h"
#include "ods/denoise/stored_noise.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

struct DenoiseJob {
  std::string input;
  std::string output;
  ods::FormatHint known;  // of the input
  std::optional<ods::PictureReader> reader;
  ods::NoiseLayers layers;
  ods::DenoiseOptions options;
  bool oidn = false;  // instead of ours
  ods::SaveOptions save;
  ProgressMode progress = ProgressMode::kAuto;
};

// Returns false if help was asked for. Throws UsageError and ods::Error.
bool read_denoise_job(DenoiseJob& job, int argc, char** argv);
