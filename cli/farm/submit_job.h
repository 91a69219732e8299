// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods submit, and the plan that they make of a command.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/farm/split_command.h"
#include "ods/farm/scheduler.h"

struct SubmitJob {
  std::optional<ods::Scheduler> to;
  std::string folder, name, program;
  int chunk = 0;  // 0: by the time that the first one takes
  int cpus = 0;
  std::optional<float> memory;  // GB
  bool raw_first = false;
  bool dry = false, copies = false;
  ods::SchedulerChoices choices;
  std::vector<std::string> command;
};

SubmitJob parse_submit(Options& options);

// The plan for the scheduler: the folder, and everything but the number of tasks of the first group.
ods::FarmPlan make_plan(const SubmitJob& job, const SplitCommand& split);

// FOLDER/NAME.farm beside the output.
std::string usual_folder(const std::string& output);

// Sets the number of tasks of the groups. Without --chunk, makes the first frame here and measures it; its time also
// decides whether the frames are rendered first and denoised by a separate group.
void count_tasks(const SubmitJob& job, const SplitCommand& split, ods::FarmPlan& plan);
