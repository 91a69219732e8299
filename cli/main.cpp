// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command line's first word: a command of cli/commands.cpp, --help or --version.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/console/command.h"
#include "cli/console/interrupt.h"
#include "cli/console/manual.h"
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
  std::fputs(overview(format).c_str(), stdout);
  if (format == ManualFormat::kHelp || format == ManualFormat::kMan) return kExitOk;
  for (const Command& command : commands()) {
    if (const int code = run_command(command, {help_option}); code != kExitOk) return code;
  }
  std::fputs(end_of_overview(format).c_str(), stdout);
  return kExitOk;
}

// The first picture would get the number of a stream that is closed, and with it what is printed there.
void open_closed_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) != stream) std::abort();
  }
}

int unknown_command(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  std::fprintf(stderr, "ods: error: there is no command '%s'%s (ods --help lists them)\n",
               ods::one_line(name).c_str(), ods::did_you_mean(name, names).c_str());
  return kExitUsage;
}

}  // namespace

// Libraries' constructors run for a while: a Ctrl-C then is one like any other. What is left is the loader itself,
// which no code of ours precedes; there the signal ends the process, which has done nothing yet. Sanitizers are not
// ready then.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
[[gnu::section(".preinit_array"), gnu::used]] static void (*const before_constructors)() = [] { end_on_interrupts(); };
#endif

int main(int argc, char** argv) {
  open_closed_streams();
  end_on_interrupts();
  ods::return_large_blocks();
  if (argc < 2) {
    std::fputs(overview(ManualFormat::kHelp).c_str(), stderr);
    return kExitUsage;
  }
  const std::string name = argv[1];
  if (const auto format = manual_format(name == "help" ? "--help" : name)) return print_overview(*format, name);
  if (name == "--version") {
    std::puts("ods " ODS_VERSION "\n" ODS_LIBRARIES);
    return kExitOk;
  }
  const Command* const command = find_command(name);
  return command ? run_command(*command, {argv + 2, argv + argc}) : unknown_command(name);
}
