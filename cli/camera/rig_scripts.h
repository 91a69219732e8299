// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes the output of ods rig: the rig, and scripts for other renderers beside it.
#pragma once
#include <vector>

#include "cli/console/options.h"
#include "ods/export/rig_export.h"

// --for NAME,NAME,...
void add_script_option(Options& options, std::vector<ods::RigTarget>& targets);

// Writes the rig as JSON, then every script as the same name without .json plus its own ending; prints the file names.
void write_rig(const ods::SlitRig& rig, const std::vector<ods::RigTarget>& targets, const std::string& output);
