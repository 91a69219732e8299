// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Jobs that are submitted again.
#pragma once
#include "cli/farm/split_command.h"
#include "ods/farm/plan.h"

// Whether the file that the last of several groups makes is there, was made by these very commands (as the plan in the
// folder says), and is newer than all that they read.
bool is_finished(const ods::FarmPlan& plan, const SplitCommand& split);
