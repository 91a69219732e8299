// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a job comes to, for whoever submits it.
#pragma once
#include "cli/farm/split_command.h"
#include "ods/farm/plan.h"

// Its tasks, what they render twice, their memory, and the disk space of parts; a warning if the disk has less.
void say_job(const ods::FarmPlan& plan, const SplitCommand& split);
