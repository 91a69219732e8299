// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods blender: installs the add-on.
#include "cli/bridge/blender.h"
#include "cli/console/command.h"
#include "cli/console/console.h"

namespace {

BlenderOptions parse_blender(Options& options) {
  BlenderOptions blender;
  options.describe("Installs the add-on: the panel Stereo 360 in Blender's render properties.",
                   "  ods blender\n  ods blender --blender ~/blender-4.2/blender");
  options.text("--blender", "PROGRAM", blender.program, "which Blender; by default the one on PATH");
  options.number("--blender-limit", blender.seconds, 0.1f, 1e6f, "the seconds that Blender may take");
  options.group("Console");
  add_console_options(options);
  options.parse();
  return blender;
}

void install(const BlenderOptions& blender) {
  if (find_blender(blender).empty()) {
    throw ods::Error(ods::ErrorKind::kInput, "there is no Blender: install it, or name it with --blender PATH");
  }
  install_add_on(blender);
  note("the add-on is installed: in Blender open Render properties, Stereo 360");
}

}  // namespace

extern const Command kBlender = make_command<parse_blender, install>("blender", "install the add-on for Blender");
