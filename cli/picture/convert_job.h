// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods convert is asked to do.
#pragma once
#include <string>

#include "cli/console/progress.h"
#include "cli/options/camera_options.h"
#include "ods/convert/convert.h"
#include "ods/render/render_options.h"

struct ConvertJob {
  std::string input;
  std::string output;
  ods::FormatHint known;  // of the input
  ods::StoredPicture picture;
  ods::ConvertTarget target;
  ods::SaveOptions save;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// False when help was asked for. Throws UsageError and ods::Error.
bool read_convert_job(ConvertJob& job, int argc, char** argv);

// Opens the input: what is not given stays as it is there. The same arguments; throws likewise.
void open_convert_job(ConvertJob& job, int argc, char** argv);
