// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/camera/rig_scripts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "cli/console/console.h"
#include "cli/options/untested_targets.h"
#include "ods/base/names.h"
#include "ods/files/atomic_file.h"
#include "ods/stitch/slit_file.h"

using ods::RigTarget;

static std::vector<RigTarget> parse_targets(const std::string& words) {
  std::vector<RigTarget> targets;
  std::istringstream stream(words);
  for (std::string word; std::getline(stream, word, ',');) {
    const std::optional<RigTarget> found = ods::find_in(ods::kRigTargetTable, word);
    if (!found) {
      throw UsageError(
          fmt::format("--for: '{}' is not one of {}", word, fmt::join(ods::names_of(ods::kRigTargetTable), ", ")));
    }
    if (std::find(targets.begin(), targets.end(), *found) == targets.end()) targets.push_back(*found);
  }
  return targets;
}

void add_script_option(Options& options, std::vector<RigTarget>& targets) {
  options.custom(
      "--for", "LIST", "", [&](const std::string& words) { targets = parse_targets(words); },
      fmt::format("write scripts that render the views, next to the rig, for any of: {}; {}",
                  fmt::join(ods::names_of(ods::kRigTargetTable), ", "), untested_targets(ods::kRigTargetTable)));
}

void write_rig(const ods::SlitRig& rig, const std::vector<RigTarget>& targets, const std::string& output) {
  const std::filesystem::path path(output);
  const std::filesystem::path base = path.extension() == ".json" ? path.parent_path() / path.stem() : path;
  save_slit_rig(rig, output);
  announce_file(output);
  for (const RigTarget target : targets) {
    const ods::RigExport made = export_rig(rig, target, base.filename().native());
    for (const std::string& warning : made.warnings) {
      note(fmt::format("--for {}: {}", ods::rig_target_name(target), warning));
    }
    for (const ods::RigScript& script : made.scripts) {
      const std::string script_path = base.native() + script.ending;
      ods::write_file(script_path, script.text);
      announce_file(script_path);
    }
  }
}
