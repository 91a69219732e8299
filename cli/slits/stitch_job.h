// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods stitch is asked to do.
#pragma once
#include <optional>
#include <string>

#include "cli/console/progress.h"
#include "ods/picture/save.h"
#include "ods/stitch/view_files.h"

struct StitchJob {
  std::string rig_file;
  ods::ViewFiles views;
  std::string output;
  std::string report;
  ods::SaveOptions save;              // but for its layout
  std::optional<ods::Layout> layout;  // none: default_layout() of the rig's projection
  std::string frames;
  bool has_tone = false;
  bool partial = false;
  bool says_files = true;
  bool says_unmarked = true;  // notes views that do not say which rig they are of
  bool claims = true;         // false: the caller holds a claim on what the frames are for
  bool list_missing = false;
  bool skip_existing = false;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

// False when help was asked for. Throws UsageError.
bool read_stitch_job(StitchJob& job, int argc, char** argv);
