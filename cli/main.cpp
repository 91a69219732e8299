// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command line's first argument: a command of cli/commands.cpp, --help or --version.
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "cli/console/command.h"
#include "cli/console/interrupt.h"
#include "cli/console/manual.h"
#include "cli/console/print.h"
#include "cli/console/programs.h"
#include "cli/console/supervisor.h"
#include "ods/base/large_blocks.h"
#include "ods/base/suggest.h"
#include "ods/base/text.h"

namespace {

// Help, a man page or a completion script; every command writes its own part of the latter.
std::string overview(ManualFormat format) {
  std::vector<CommandSummary> all;
  for (const Command& command : commands()) all.push_back({std::string(command.name), std::string(command.summary)});
  return write_overview(all, format);
}

int print_overview(ManualFormat format, const std::string& help_option) {
  put_out(overview(format));
  if (format == ManualFormat::kHelp || format == ManualFormat::kMan) return kExitOk;
  for (const Command& command : commands()) {
    if (const int code = run_command(command, {help_option}); code != kExitOk) return code;
  }
  put_out(end_of_overview(format));
  return kExitOk;
}

// Otherwise the first picture would get the number of a closed stream, and the text printed there.
void open_closed_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) != stream) std::abort();
  }
}

int unknown_command(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  put_error("ods: error: there is no command '",
            ods::one_line(name) + "'" + ods::did_you_mean(name, names) + " (ods --help lists them)\n");
  return kExitUsage;
}

}  // namespace

// Libraries' constructors run for a while, and a Ctrl-C during them must be handled, too. Only the loader runs before
// our code; there the signal ends the process, which has not done anything yet. Sanitizers are not ready then.
#ifndef ODS_SANITIZED
[[gnu::section(".preinit_array"), gnu::used]] static void (*const before_constructors)() = [] { end_on_interrupts(); };
#endif

int main(int argc, char** argv) {
  if (argc > 0 && std::string_view(argv[0]) == kSupervisor) return supervise(argc, argv);
  open_closed_streams();
  end_on_interrupts();
  restrict_path();
  ods::return_large_blocks();
  if (argc < 2) {
    put_error("", overview(ManualFormat::kHelp));
    return kExitUsage;
  }
  const std::string name = argv[1];
  if (const auto format = manual_format(name == "help" ? "--help" : name)) return print_overview(*format, name);
  if (name == "--version") {
    put_out("ods " ODS_VERSION "\n" ODS_LIBRARIES "\n");
    return kExitOk;
  }
  const Command* const command = find_command(name);
  return command ? run_command(*command, {argv + 2, argv + argc}) : unknown_command(name);
}
