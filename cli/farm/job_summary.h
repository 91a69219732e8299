// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A summary of a job, for the user who submits it.
#pragma once
#include "cli/farm/split_command.h"
#include "ods/farm/plan.h"

// Prints its tasks, the share that they render twice, their memory, and the disk space of parts; warns if the disk has
// less.
void report_job(const ods::FarmPlan& plan, const SplitCommand& split);
