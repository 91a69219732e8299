// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What Slurm knows of our jobs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/farm/slurm_answers.h"

// The tasks in Slurm's queue, and those that ended a short while ago, of all jobs of ods submit. Nothing if there is no
// squeue, or it fails.
std::optional<std::vector<ods::SlurmTask>> queued_tasks();

// The arrays that were sent from this folder, by their jobs' numbers; none if that is not known.
std::map<std::string, ods::SlurmArray> sent_arrays(const std::string& folder);

// Those of their tasks that Slurm's accounting knows, if it is on.
std::vector<ods::SlurmTask> accounted_tasks(const std::map<std::string, ods::SlurmArray>& arrays);
