// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/command.h"

#include <algorithm>

#include "cli/console/console.h"
#include "cli/console/print.h"

const Command* find_command(std::string_view name) {
  const auto found = std::ranges::find(commands(), name, &Command::name);
  return found == commands().end() ? nullptr : &*found;
}

// Applies the console's options, even if another option is wrong: --progress json makes errors JSON, too.
static Invocation parse(const Command& command, Options& options) {
  try {
    Invocation invocation = command.parse(options);
    console = options.console();
    std::vector<std::string> inputs;
    for (const GivenWord& word : invocation.given) {
      if (word.kind.use_of(word.value) == PathUse::kInput && !word.kind.is_folder) inputs.push_back(word.value);
    }
    name_inputs(inputs);
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
      put_out(help.text);
      return kExitOk;
    }
  });
}
