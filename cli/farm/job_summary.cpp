// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "cli/console/console.h"
#include "ods/base/memory.h"
#include "ods/files/atomic_file.h"

namespace fs = std::filesystem;

namespace {

bool is_raw_first(const ods::FarmPlan& plan) {
  return plan.groups.front().name == kRawGroup;
}

std::string halo_text(const SplitCommand& split, const ods::FarmPlan& plan) {
  if (is_raw_first(plan)) return "; no frame is rendered twice";
  const int tasks = plan.groups.front().tasks;
  const double cost = ods::halo_cost(split.halo, tasks, split.count);
  if (cost == 0.0) return "";
  const bool much = cost > ods::kMaxHaloCost;
  return fmt::format(
      "; {:.0f} % more frames are rendered, because the denoiser needs the neighbours of a task's frames{}",
      100.0 * cost, much ? " (a larger --chunk needs fewer, --raw-first none)" : "");
}

std::string memory_text(const ods::FarmPlan& plan) {
  std::vector<std::string> each;
  for (const ods::TaskGroup& group : plan.groups) {
    each.push_back(fmt::format("{} {:.1f} GB", group.name, static_cast<double>(ods::memory_of(plan, group)) * 1e-9));
  }
  return fmt::format("memory of a task: {}", fmt::join(each, ", "));
}

std::string summary(const ods::FarmPlan& plan, const SplitCommand& split) {
  const ods::TaskGroup& first = plan.groups.front();
  std::string text = first.option.empty()
                         ? fmt::format("{}: {} in one task", plan.name, first.name)
                         : fmt::format("{}: {} {}{} in {} task{}", plan.name, split.count, split.noun,
                                       split.count == 1 ? "" : "s", first.tasks, first.tasks == 1 ? "" : "s");
  for (size_t i = 1; i < plan.groups.size(); i++) {
    const ods::TaskGroup& group = plan.groups[i];
    text += fmt::format(", then {}", group.name);
    if (group.tasks > 1) text += fmt::format(" in {} tasks", group.tasks);
  }
  return text + halo_text(split, plan) + "; " + memory_text(plan);
}

// Parts are large, and all of them are there until the merge; so are raw frames, until the video.
void report_disk_use(const SplitCommand& split, const ods::FarmPlan& plan) {
  if (split.disk == 0 || (split.raw && !is_raw_first(plan))) return;
  const char* const noun = split.raw ? "raw frames" : "parts";
  std::error_code error;
  const fs::space_info space = fs::space(ods::existing_folder_of(split.output), error);
  const std::string text = fmt::format("the {} take up to {} on disk together, {} each", noun,
                                       ods::bytes_text(split.disk), ods::bytes_text(split.disk / split.count));
  if (error) return note(text);
  const std::string free = fmt::format("{}; {} are free", text, ods::bytes_text(space.available));
  split.disk <= space.available ? note(free) : warn(free + (split.raw ? "" : ": use fewer parts, or another disk"));
}

}  // namespace

void report_job(const ods::FarmPlan& plan, const SplitCommand& split) {
  note(summary(plan, split));
  report_disk_use(split, plan);
}
