// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a farm has to do, whatever its scheduler: groups of tasks, one group after the other. Each task is a command
// line of ods that anybody can run by hand, and that does no harm when it runs twice, or twice at once: it claims its
// files, skips those that are complete, and commits by renaming (ods/files/claim.h, ods/files/atomic_file.h).
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

// Tasks that differ in one word. With an option, task i of n (from 1) has "OPTION i/n" behind the command; without,
// there is one task, the command itself.
struct TaskGroup {
  std::string name;                  // "frames", "parts", "merge", "video": letters
  std::vector<std::string> command;  // the words after "ods"
  std::string option;                // "--only", "--part", or empty
  int tasks = 1;
  size_t memory = 0;                     // bytes that a task takes; 0: as the plan says
  std::string files = {}, numbers = {};  // what the tasks make: "/disk/out.####.exr", "1-100" (ods/files/frames.h)
};

struct PlanPath {
  std::string path;  // absolute
  bool is_output = false;
  bool is_folder = false;
};

struct FarmPlan {
  std::string name;               // letters, digits, "_", "-" and "."
  std::string folder;             // absolute: for the plan, what is sent, and the tasks' logs
  std::string program;            // ods, as the tasks' machines call it
  int cpus = 0;                   // processors of a task; 0: all of a machine
  size_t memory = 0;              // bytes that a task takes, if its group does not say
  std::vector<PlanPath> paths;    // that the commands name
  std::vector<TaskGroup> groups;  // each starts when the one before is done
  std::string scheduler = {};     // that it was written for: "slurm"; empty: not known
};

// What a task of the group takes, in bytes.
size_t memory_of(const FarmPlan& plan, const TaskGroup& group);

// The program and the words of task `number`, counted from 1.
std::vector<std::string> task_words(const FarmPlan& plan, const TaskGroup& group, int number);

// As JSON (docs/farm.md has its keys), and back. Throws Error(kInput) if it is no such plan; `path` stands for it in
// messages.
std::string write_plan(const FarmPlan& plan);
FarmPlan read_plan(std::string_view text, const std::string& path);

// plan.json of a job's folder. Throws Error(kInput), also if it cannot be read.
FarmPlan open_plan(const std::string& folder);

// A folder's absolute path, without a slash at its end.
std::string absolute_folder(const std::string& path);

// A name that every scheduler takes: other characters become "_". At most 64.
std::string plan_name(const std::string& text);

// Throws Error(kUsage) if a word or path has what some scheduler's language cannot hold: a line break, bytes that are
// not UTF-8.
void check_quotable(const FarmPlan& plan);

// --- how many tasks -------------------------------------------------------------------------------------------------

// Frames that tasks render beyond their own, over all frames: those beside a task's own, `halo` on each side, which
// another task renders, too. Precondition: tasks > 0, frames > 0.
double halo_cost(int halo, int tasks, size_t frames);

// What a chunk of ours costs at most in that way.
inline constexpr double kMostHaloCost = 0.25;

// Frames of a task whose halo costs that.
int least_chunk(int halo);

// Frames of a task that takes about ten minutes, if the frames are not so few that machines would be idle: at least
// sixteen tasks, unless that would cost more than kMostHaloCost. Precondition: seconds_per_frame > 0, frames > 0.
int suitable_chunk(double seconds_per_frame, size_t frames, int halo);

// Whether it is cheaper to render all frames first, each once, and to denoise them by a second group, than to render
// those beside a task's own twice: a frame as rendered has raw_bytes, and a shared disk takes 100 MB a second. Not
// where tasks of ten minutes have least_chunk() frames or more. Precondition: as suitable_chunk().
bool raw_first_is_cheaper(double seconds_per_frame, size_t frames, int halo, size_t raw_bytes);

// Tasks of at most `chunk` frames.
int tasks_for(size_t frames, int chunk);

}  // namespace ods
