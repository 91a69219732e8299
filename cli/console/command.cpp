// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/command.h"

#include <algorithm>
#include <cstdio>

#include "cli/console/console.h"

const Command* find_command(std::string_view name) {
  const auto found = std::ranges::find(commands(), name, &Command::name);
  return found == commands().end() ? nullptr : &*found;
}

// Applies the console's options even if another option is wrong: --progress json makes errors JSON, too.
static Invocation parse(const Command& command, Options& options) {
  try {
    Invocation invocation = command.parse(options);
    console = options.console();
    return invocation;
  } catch (...) {
    console = options.console();
    throw;
  }
}

ExitCode run_command(const Command& command, std::vector<std::string> words) {
  return run_to_exit_code([&] {
    Options options(std::string(command.name), std::move(words));
    try {
      return parse(command, options).run();
    } catch (const HelpRequest& help) {
      std::fputs(help.text.c_str(), stdout);
      return kExitOk;
    }
  });
}
