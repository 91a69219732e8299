// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods blender: installs the add-on.
#include "cli/bridge/blender.h"
#include "cli/console/console.h"
#include "cli/console/options.h"

int ods_blender(int argc, char** argv) {
  return run_command([=] {
    BlenderOptions blender;
    Options options("blender", "Installs the add-on: the panel Stereo 360 in Blender's render properties.",
                    "  ods blender\n  ods blender --blender ~/blender-4.2/blender");
    options.text("--blender", "PROGRAM", blender.program, "which Blender; by default the one on PATH");
    options.number("--blender-limit", blender.seconds, 0.1f, 1e6f, "the seconds that Blender may take");
    options.group("Console");
    add_console_options(options);
    if (!options.parse(argc, argv)) return;
    if (find_blender(blender).empty()) {
      throw ods::Error(ods::ErrorKind::kInput,
                       "there is no Blender: install it, or say where it is with --blender PATH");
    }
    install_add_on(blender);
    note("the add-on is installed: in Blender open Render properties, Stereo 360");
  });
}
