// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods scenes: lists the built-in scenes.

#include <fmt/format.h>

#include "cli/console/command.h"
#include "cli/console/print.h"
#include "ods/scene/builtin/builtin.h"

namespace {

struct ScenesJob {};

ScenesJob parse_scenes(Options& options) {
  options.describe("Lists the built-in scenes, whose names can be used in place of a file.",
                   "  ods render room -o room.png");
  options.group("Console");
  add_console_options(options);
  options.parse();
  return {};
}

void list_scenes(const ScenesJob&) {
  for (const ods::BuiltinScene& scene : ods::builtin_scenes()) {
    put_out(fmt::format("{:<12} {}\n", scene.name, scene.summary));
  }
}

}  // namespace

extern const Command kScenes = make_command<parse_scenes, list_scenes>("scenes", "list the built-in scenes");
