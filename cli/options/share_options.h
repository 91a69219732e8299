// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames that a process makes, for a command that makes one file of each.
#pragma once
#include <string>
#include <vector>

#include "cli/console/options.h"

struct FrameShare {
  std::string only;  // as TimeOptions::only (cli/options/time_options.h)
  bool skip_existing = false;
};

void add_share_options(Options& options, FrameShare& share);

// Throws UsageError if one of these options is given although frames (#### in the name) do not become frames.
void check_share(const FrameShare& share, const std::string& input, const std::string& output);
