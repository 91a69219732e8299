// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The state of a job on the farm: from its folder and from Slurm.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ods/farm/slurm_answers.h"

struct FailedTask {
  int number = 0;
  std::string why;    // "exit code 3", or Slurm's state: "TIMEOUT"
  std::string last;   // line of its log
  std::string nodes;  // of its starts: "one, two"
};

struct GroupReport {
  std::string name;
  int done = 0, running = 0, waiting = 0;
  int lost = 0;                             // neither ended nor in the queue: cancelled long ago, or never sent
  int restarts = 0;                         // of all tasks
  std::map<std::string, int> nodes;         // how many tasks run on each
  std::optional<std::pair<int, int>> made;  // existing frames, parts or views, and their full number
  std::vector<FailedTask> failed;
  std::vector<int> faults;  // tasks that are done, and whose command judged its input and found a fault
  std::optional<double> seconds_left;
};

struct JobReport {
  std::string name, folder, scheduler;
  std::vector<GroupReport> groups;
  bool is_known() const;  // Slurm or the tasks report the state of its tasks
  bool is_over() const;   // nothing runs or waits
  bool is_done() const;   // all tasks are
  bool found_fault() const;
};

// tasks: in Slurm's queue, of any job. Tasks that Slurm has forgotten are reported by their files in the folder. Throws
// ods::Error(kInput) if the folder has no plan.
JobReport report_job(const std::string& folder, const std::vector<ods::SlurmTask>& tasks);

// Write the report as a table with the failed tasks, for people, and as JSON (docs/farm.md has its keys).
std::string report_text(const std::vector<JobReport>& jobs);
std::string report_json(const std::vector<JobReport>& jobs);
