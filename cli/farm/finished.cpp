// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/finished.h"

#include <algorithm>
#include <filesystem>

#include "ods/base/error.h"

namespace fs = std::filesystem;

namespace {

bool has_same_commands(const ods::FarmPlan& plan) {
  const auto same = [](const ods::TaskGroup& a, const ods::TaskGroup& b) {
    return a.command == b.command && a.numbers == b.numbers;
  };
  try {
    std::vector<ods::TaskGroup> then = ods::open_plan(plan.folder).groups;
    std::erase_if(then, [](const ods::TaskGroup& group) { return group.name == kRawGroup; });
    return std::ranges::equal(then, plan.groups, same);
  } catch (const ods::Error&) {  // no plan, or a plan of another version
    return false;
  }
}

}  // namespace

bool is_finished(const ods::FarmPlan& plan, const SplitCommand& split) {
  std::error_code ignored;
  if (plan.groups.size() < 2 || !fs::is_regular_file(split.output, ignored) || !has_same_commands(plan)) return false;
  const auto made = fs::last_write_time(split.output, ignored);
  const auto is_older = [&](const std::string& path) { return fs::last_write_time(path, ignored) < made; };
  const auto is_older_input = [&](const ods::PlanPath& p) { return p.is_output || p.is_folder || is_older(p.path); };
  return is_older(plan.folder + "/plan.json") && std::ranges::all_of(plan.paths, is_older_input) &&
         std::ranges::all_of(split.scene_files, is_older);
}
