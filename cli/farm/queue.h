// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Slurm's records of our jobs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/farm/slurm_answers.h"

inline constexpr float kSlurmLimit = 120;  // seconds for an answer; Slurm's own programs give up sooner

struct SlurmQueue {
  std::vector<ods::SlurmTask> tasks;  // in the queue, and those that ended a short while ago, of all jobs of ods submit
  std::string fault;                  // why squeue failed, for messages; empty: it succeeded
};
SlurmQueue read_queue();

// Returns the arrays that were sent from this folder, by their jobs' numbers; none if unknown. Throws Error(kInput) if
// the list of them is damaged.
std::map<std::string, ods::SlurmArray> sent_arrays(const std::string& folder);

// Returns the tasks of these arrays in Slurm's accounting, if it is on.
std::vector<ods::SlurmTask> accounted_tasks(const std::map<std::string, ods::SlurmArray>& arrays);
