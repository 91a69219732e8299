// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "cli/console/exit_code.h"
#include "cli/farm/queue.h"
#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/farm/plan.h"
#include "ods/files/file_input.h"
#include "ods/files/frames.h"

namespace fs = std::filesystem;

namespace {

using ods::TaskState;

struct Known {
  TaskState state = TaskState::kWaiting;
  std::string why;
  bool found_fault = false;
};

// The states of a group's tasks, by their numbers.
using KnownTasks = std::map<int, Known>;

std::string last_line(const std::string& path) {
  try {
    const ods::FileInput file(path);
    const uint64_t size = std::min<uint64_t>(file.size(), 4096);
    std::string text = file.read(file.size() - size, size);
    text.erase(text.find_last_not_of("\n\r ") + 1);
    return ods::one_line(text.substr(text.find_last_of("\n\r") + 1));
  } catch (const ods::Error&) {
    return "";
  }
}

// The regular files of a folder: reading a pipe would block.
std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error, ignored;
  fs::directory_iterator entries(folder, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    if (entries->is_regular_file(ignored)) files.push_back(entries->path());
  }
  return files;
}

// The files "GROUP.NUMBER" that tasks have left; each has an exit code.
std::map<std::string, KnownTasks> ended_tasks(const std::string& folder) {
  std::map<std::string, KnownTasks> ended;
  for (const fs::path& path : files_in(folder + "/ended")) {
    const std::string name = path.filename().native();
    const size_t dot = name.rfind('.');
    int number = 0, code = 1;
    if (dot == std::string::npos) continue;
    const auto [end, fault] = std::from_chars(name.data() + dot + 1, name.data() + name.size(), number);
    if (fault != std::errc() || end != name.data() + name.size()) continue;
    std::ifstream(path) >> code;
    const bool is_done = code == kExitOk || code == kExitFault;
    ended[name.substr(0, dot)][number] = {is_done ? TaskState::kDone : TaskState::kFailed,
                                          fmt::format("exit code {}", code), code == kExitFault};
  }
  return ended;
}

// The files "GROUP.NUMBER" have a line per start, "JOB MADE NODE".
void add_starts(GroupReport& report, const std::string& folder) {
  for (const fs::path& path : files_in(folder + "/starts")) {
    const std::string name = path.filename().native();
    if (!name.starts_with(report.name + ".")) continue;
    std::ifstream file(path);
    std::set<std::string> jobs, nodes;
    int starts = 0;
    for (std::string job, made, node; file >> job >> made >> node; starts++) jobs.insert(job), nodes.insert(node);
    report.restarts += starts - static_cast<int>(jobs.size());
    for (FailedTask& task : report.failed) {
      if (name == fmt::format("{}.{}", report.name, task.number))
        task.nodes = fmt::format("{}", fmt::join(nodes, ", "));
    }
  }
}

// The frames of a video are gone when it is there.
std::optional<std::pair<int, int>> count_made(const ods::TaskGroup& group, bool all_done) {
  const std::optional<ods::FrameNames> names = ods::frame_names(group.files);
  if (!names) return std::nullopt;
  const std::vector<int> numbers = ods::parse_frames(group.numbers);
  const int all = static_cast<int>(numbers.size());
  if (all_done) return std::pair(all, all);
  try {
    const std::vector<int> there = ods::frames_on_disk(*names);
    const auto is_there = [&](int number) { return std::ranges::binary_search(there, number); };
    return std::pair(static_cast<int>(std::ranges::count_if(numbers, is_there)), all);
  } catch (const ods::Error&) {  // no folder yet
    return std::pair(0, all);
  }
}

bool is_active(TaskState state) {
  return state == TaskState::kWaiting || state == TaskState::kRunning;
}

// Slurm's state counts while a task waits and runs; the task's own record of its end is better, unless Slurm ended it
// (TIMEOUT, CANCELLED, ...).
void add_tasks(std::map<std::string, KnownTasks>& known, const std::vector<ods::SlurmTask>& tasks) {
  for (const ods::SlurmTask& task : tasks) {
    KnownTasks& group = known[task.group];
    const auto before = group.find(task.number);
    if (before == group.end() || is_active(task.state)) group[task.number] = {task.state, task.word, false};
  }
}

GroupReport report_group(const ods::TaskGroup& group, const KnownTasks& known, const std::string& folder) {
  GroupReport report;
  report.name = group.name;
  for (const auto& [number, task] : known) {
    if (number < 1 || number > group.tasks) continue;
    if (task.state == TaskState::kDone) report.done++;
    if (task.found_fault) report.faults.push_back(number);
    if (task.state == TaskState::kRunning) report.running++;
    if (task.state == TaskState::kWaiting) report.waiting++;
    if (task.state != TaskState::kFailed) continue;
    const std::string log = fmt::format("{}/logs/{}.{}.log", folder, group.name, number);
    report.failed.push_back({number, task.why, report.failed.size() < 20 ? last_line(log) : "", ""});
  }
  report.lost = group.tasks - report.done - report.running - report.waiting - static_cast<int>(report.failed.size());
  report.made = count_made(group, report.done == group.tasks);
  add_starts(report, folder);
  return report;
}

// The nodes, and the time left by the tasks that are done, as if as many ran until the end as now.
void add_queue(GroupReport& report, const std::vector<ods::SlurmTask>& queued,
               const std::vector<ods::SlurmTask>& ended) {
  double seconds = 0.0, spent = 0.0;
  int done = 0;
  for (const ods::SlurmTask& task : queued) {
    if (task.group != report.name || task.state != TaskState::kRunning) continue;
    spent += task.seconds;
    if (!task.node.empty()) report.nodes[task.node]++;
  }
  for (const ods::SlurmTask& task : ended) {
    if (task.group == report.name && task.state == TaskState::kDone) seconds += task.seconds, done++;
  }
  if (done == 0 || report.running == 0) return;
  const double each = seconds / done, tasks_left = report.running + report.waiting;
  report.seconds_left = std::max(0.0, each * tasks_left - spent) / report.running;
}

}  // namespace

// Plans of earlier versions do not record it.
bool JobReport::is_known() const {
  return scheduler.empty() || scheduler == "slurm";
}

bool JobReport::is_over() const {
  return std::ranges::all_of(groups, [](const GroupReport& g) { return g.running + g.waiting == 0; });
}

bool JobReport::is_done() const {
  return is_over() && std::ranges::all_of(groups, [](const GroupReport& g) { return g.failed.empty() && g.lost == 0; });
}

bool JobReport::found_fault() const {
  return std::ranges::any_of(groups, [](const GroupReport& g) { return !g.faults.empty(); });
}

JobReport report_job(const std::string& folder, const std::vector<ods::SlurmTask>& queued) {
  const ods::FarmPlan plan = ods::open_plan(folder);
  const std::map<std::string, ods::SlurmArray> arrays = sent_arrays(folder);
  std::vector<ods::SlurmTask> tasks;
  const auto is_own = [&](const ods::SlurmTask& t) {
    return t.folder == folder && (arrays.empty() || arrays.contains(t.job));  // not tasks of an earlier submission
  };
  std::ranges::copy_if(queued, std::back_inserter(tasks), is_own);
  std::map<std::string, KnownTasks> known = ended_tasks(folder);
  add_tasks(known, tasks);
  std::vector<ods::SlurmTask> accounted = accounted_tasks(arrays);
  std::erase_if(accounted, [](const ods::SlurmTask& t) { return is_active(t.state); });
  add_tasks(known, accounted);
  JobReport report{plan.name, folder, plan.scheduler, {}};
  for (const ods::TaskGroup& group : plan.groups) {
    report.groups.push_back(report_group(group, known[group.name], folder));
    add_queue(report.groups.back(), tasks, accounted.empty() ? tasks : accounted);
  }
  return report;
}
