// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods stitch.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/console/options.h"
#include "cli/console/progress.h"
#include "cli/options/picture_options.h"
#include "ods/picture/save.h"
#include "ods/stitch/view_files.h"

struct StitchJob {
  std::string rig_file;
  ods::ViewFiles views;
  std::string output;
  std::string report;
  ods::SaveOptions save;  // except its layout
  DisplayOptions display;
  std::optional<ods::Layout> layout;  // none: default_layout() of the rig's projection
  std::string frames;
  std::string only;                  // as TimeOptions::only
  std::optional<float> merge_limit;  // --merge auto, minutes of arc
  bool partial = false;
  bool notes_files = true;
  bool notes_unmarked = true;  // print a note if views do not identify their rig
  bool claims = true;          // false: the caller already holds a claim
  bool list_missing = false;
  bool skip_existing = false;
  std::vector<GivenWord> given;  // the command line
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

StitchJob parse_stitch(Options& options);
