// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What Slurm's own commands print, in the versions of the last ten years. Lines and values that are not understood are
// left out: a farm's report is better short than missing.
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
  std::string job;            // Slurm's number of the array, or of the job that is none
  std::string folder, group;  // of the plan
  int number = 1;             // of the task in its group
  TaskState state = TaskState::kWaiting;
  std::string word;       // Slurm's own word for it: "PENDING", "TIMEOUT"
  double seconds = 0.0;   // how long it has run
  std::string node = {};  // on which it runs
};

// Identifies an array: the beginning of its comment in Slurm, behind which ":FOLDER" stands. before: the tasks of the
// group's arrays before it.
std::string slurm_comment(const std::string& group, int before);

struct SlurmArray {
  std::string folder, group;
  int before = 0;
};
// Of a whole comment; nothing for other people's jobs.
std::optional<SlurmArray> array_of_comment(std::string_view comment);

// squeue with kQueueWords, a line per task.
inline constexpr const char* kQueueWords[] = {"--noheader", "--array", "--states=all", "--format=%F|%K|%T|%M|%N|%k"};
std::vector<SlurmTask> read_queue(std::string_view text);

// squeue --json; now: seconds since 1970. Nothing if the text is not JSON.
std::optional<std::vector<SlurmTask>> read_queue_json(std::string_view text, double now);

// sacct with kAccountWords, where accounting is on; arrays: by their jobs' numbers, as submit.sh has printed them.
inline constexpr const char* kAccountWords[] = {"--noheader", "--parsable2", "--allocations",
                                                "--format=JobID,State,ElapsedRaw"};
std::vector<SlurmTask> read_account(std::string_view text, const std::map<std::string, SlurmArray>& arrays);

// A number of scontrol show config: "MaxArraySize = 1001".
std::optional<int> slurm_setting(std::string_view text, std::string_view name);

}  // namespace ods
