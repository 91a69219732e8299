// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Parses the output of Slurm's commands, in the versions of the last ten years. Leaves out lines and values that it
// cannot parse: a short report is better than none.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"

namespace ods {

enum class TaskState { kWaiting, kRunning, kDone, kFailed };

inline constexpr NameRow<TaskState> kTaskStateTable[] = {{TaskState::kWaiting, "waiting"},
                                                         {TaskState::kRunning, "running"},
                                                         {TaskState::kDone, "done"},
                                                         {TaskState::kFailed, "failed"}};
static_assert(has_every_member(kTaskStateTable));

struct SlurmTask {
  std::string job;            // Slurm's number of the array, or of a job without an array
  std::string folder, group;  // of the plan
  int number = 1;             // of the task in its group
  TaskState state = TaskState::kWaiting;
  std::string word;       // Slurm's name for it: "PENDING", "TIMEOUT"
  double seconds = 0.0;   // running time
  std::string node = {};  // node on which it runs
};

// Identifies an array: the beginning of its comment in Slurm, followed by ":FOLDER". before: the tasks of the group's
// arrays before it.
std::string slurm_comment(const std::string& group, int before);

struct SlurmArray {
  std::string folder, group;
  int before = 0;
};
// Parses a whole comment. Returns nullopt for jobs that ods did not submit.
std::optional<SlurmArray> array_of_comment(std::string_view comment);

// Reads the output of squeue with kQueueWords, a line per task.
inline constexpr const char* kQueueWords[] = {"--noheader", "--array", "--states=all", "--format=%F|%K|%T|%M|%N|%k"};
std::vector<SlurmTask> read_queue(std::string_view text);

// Reads the output of squeue --json. now: seconds since 1970. Returns nullopt if the text is not JSON.
std::optional<std::vector<SlurmTask>> read_queue_json(std::string_view text, double now);

// Reads the output of sacct with kAccountWords, for clusters with accounting. arrays: by their jobs' numbers, as
// submit.sh printed them.
inline constexpr const char* kAccountWords[] = {"--noheader", "--parsable2", "--allocations",
                                                "--format=JobID,State,ElapsedRaw"};
std::vector<SlurmTask> read_account(std::string_view text, const std::map<std::string, SlurmArray>& arrays);

// Returns a number of scontrol show config: "MaxArraySize = 1001".
std::optional<int> slurm_setting(std::string_view text, std::string_view name);

}  // namespace ods
