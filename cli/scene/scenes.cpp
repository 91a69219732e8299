// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods scenes: lists the built-in scenes.

#include "cli/console/console.h"
#include "cli/console/options.h"
#include "cli/console/print.h"
#include "ods/scene/builtin/builtin.h"

int ods_scenes(int argc, char** argv) {
  return run_command([=] {
    Options options("scenes", "Lists the built-in scenes, whose names can be used in place of a file.",
                    "  ods render room -o room.png");
    options.group("Console");
    add_console_options(options);
    if (!options.parse(argc, argv)) return;
    for (const ods::BuiltinScene& scene : ods::builtin_scenes())
      put_out(fmt::format("{:<12} {}\n", scene.name, scene.summary));
  });
}
