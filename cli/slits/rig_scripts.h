// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods rig writes: the rig, and scripts for other renderers beside it.
#pragma once
#include <vector>

#include "cli/console/options.h"
#include "ods/export/rig_export.h"

// --for NAME,NAME,...
void add_script_option(Options& options, std::vector<ods::RigTarget>& targets);

// The rig as JSON, then every script under its name without .json and an ending of its own; says what was written.
void write_rig(const ods::SlitRig& rig, const std::vector<ods::RigTarget>& targets, const std::string& output);
