// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The work of a farm, independent of its scheduler: groups of tasks, one group after the other. Each task is a command
// line of ods that can also be run by hand, and that does no harm when it runs twice, or twice at once: it claims its
// files, skips those that are complete, and commits by renaming (ods/files/claim.h, ods/files/atomic_file.h).
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

// Tasks that differ in one argument. With an option, task i of n (from 1) has "OPTION i/n" after the command; without
// an option there is one task, the command itself.
struct TaskGroup {
  std::string name;                  // "frames", "parts", "merge", "video": letters
  std::vector<std::string> command;  // the arguments after "ods"
  std::string option;                // "--only", "--part", or empty
  int tasks = 1;
  size_t memory = 0;                     // bytes that a task takes; 0: FarmPlan::memory
  std::string files = {}, numbers = {};  // what the tasks make: "/disk/out.####.exr", "1-100" (ods/files/frames.h)
};

struct PlanPath {
  std::string path;  // absolute
  bool is_output = false;
  bool is_folder = false;
};

struct FarmPlan {
  std::string name;               // letters, digits, "_", "-" and "."
  std::string folder;             // absolute: for the plan, the files that are sent, and the tasks' logs
  std::string program;            // ods, as the tasks' machines call it
  int cpus = 0;                   // processors of a task; 0: all processors of a machine
  size_t memory = 0;              // bytes that a task takes, if its group does not specify it
  std::vector<PlanPath> paths;    // paths that the commands name
  std::vector<TaskGroup> groups;  // each starts when the one before is done
  std::string scheduler = {};     // scheduler that it was written for: "slurm"; empty: unknown
};

// The memory of a task of the group, in bytes.
size_t memory_of(const FarmPlan& plan, const TaskGroup& group);

// The program and the arguments of task `number`, counted from 1.
std::vector<std::string> task_arguments(const FarmPlan& plan, const TaskGroup& group, int number);

// Write a plan as JSON (docs/farm.md has its keys), and read it. Throws Error(kInput) if the text is not such a plan;
// `path` names it in messages.
std::string write_plan(const FarmPlan& plan);
FarmPlan read_plan(std::string_view text, const std::string& path);

// Reads plan.json in a job's folder. Throws Error(kInput), also if it cannot be read.
FarmPlan open_plan(const std::string& folder);

// Returns a folder's absolute path, without a slash at its end.
std::string absolute_folder(const std::string& path);

// Returns a name that every scheduler accepts: other characters become "_". At most 64 characters.
std::string plan_name(const std::string& text);

// Throws Error(kUsage) if an argument or path contains something that a scheduler's language cannot express: a line
// break, bytes that are not UTF-8.
void check_quotable(const FarmPlan& plan);

// --- how many tasks -------------------------------------------------------------------------------------------------

// The number of frames that tasks render beyond their own, divided by all frames: `halo` frames on each side of a
// task's own, which another task renders, too. Precondition: tasks > 0, frames > 0.
double halo_cost(int halo, int tasks, size_t frames);

// The largest halo_cost() of a chunk that ods chooses.
inline constexpr double kMaxHaloCost = 0.25;

// The number of frames of a task with this cost.
int min_chunk(int halo);

// The number of frames of a task that takes about ten minutes, or fewer, so that there are at least sixteen tasks and
// no machine is idle, unless that would cost more than kMaxHaloCost. Precondition: seconds_per_frame > 0, frames > 0.
int suitable_chunk(double seconds_per_frame, size_t frames, int halo);

// Returns whether it is cheaper to render all frames first, each once, and to denoise them by a second group, than to
// render the frames beside a task's own twice. A rendered frame has raw_bytes, and a shared disk takes 100 MB a second.
// Returns false if tasks of ten minutes have min_chunk() frames or more. Preconditions: as for suitable_chunk().
bool raw_first_is_cheaper(double seconds_per_frame, size_t frames, int halo, size_t raw_bytes);

// The number of tasks of at most `chunk` frames.
int tasks_for(size_t frames, int chunk);

}  // namespace ods
