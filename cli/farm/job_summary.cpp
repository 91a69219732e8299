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

std::string halo_text(const SplitCommand& split, int tasks) {
  const double cost = ods::halo_cost(split.halo, tasks, split.count);
  if (cost == 0.0) return "";
  const bool much = cost > ods::kMostHaloCost;
  return fmt::format("; {:.0f} % more frames are rendered for the denoiser, which draws on those beside a task's own{}",
                     100.0 * cost, much ? " (a larger --chunk needs fewer)" : "");
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
  for (size_t i = 1; i < plan.groups.size(); i++) text += fmt::format(", then {}", plan.groups[i].name);
  return text + halo_text(split, first.tasks) + "; " + memory_text(plan);
}

// Parts are large, and all of them are there until the merge.
void say_disk(const SplitCommand& split) {
  if (split.disk == 0) return;
  std::error_code error;
  const fs::space_info space = fs::space(ods::existing_folder_of(split.output), error);
  const std::string text = fmt::format("the parts take up to {} on disk together, {} each", ods::bytes_text(split.disk),
                                       ods::bytes_text(split.disk / split.count));
  if (error) return note(text);
  const std::string free = fmt::format("{}; {} are free", text, ods::bytes_text(space.available));
  split.disk <= space.available ? note(free) : warn(free + ": use fewer parts, or another disk");
}

}  // namespace

void say_job(const ods::FarmPlan& plan, const SplitCommand& split) {
  note(summary(plan, split));
  say_disk(split);
}
