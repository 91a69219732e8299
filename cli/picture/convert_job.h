// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods convert has to do.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "cli/options/camera_options.h"
#include "ods/convert/convert.h"
#include "ods/render/render_options.h"

struct ConvertJob {
  std::string input;
  std::string output;
  ods::FormatHint known;                     // of the input
  std::optional<ods::PictureReader> reader;  // of the input, until open_input()
  ods::StoredPicture picture;                // only its header until open_input()
  ods::ConvertTarget target;
  ods::SaveOptions save;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// Values that are not given remain the input's. Returns false if help was asked for. Throws UsageError and ods::Error.
bool read_convert_job(ConvertJob& job, int argc, char** argv);

// Reads the input's pixels. Throws UsageError and ods::Error.
void open_input(ConvertJob& job);
