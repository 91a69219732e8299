// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Jobs that are submitted again.
#pragma once
#include "cli/farm/split_command.h"
#include "ods/farm/plan.h"

// Returns whether the file of the last of several groups exists, was made by exactly these commands (by the plan in the
// folder), and is newer than all their inputs.
bool is_finished(const ods::FarmPlan& plan, const SplitCommand& split);
