// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A command is parse() and run(). parse() turns the arguments of a command line into a job, a value: it opens no file,
// starts no program and prints nothing. run() opens, plans and does the work, and returns an exit code; if it returns
// void, it has succeeded when it returns.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/console/exit_code.h"
#include "cli/console/options.h"

// A parsed command line, ready to run.
struct Invocation {
  std::vector<GivenWord> given;
  std::function<ExitCode()> run;
};

struct Command {
  std::string_view name;
  std::string_view summary;               // one line, for the overview
  Invocation (*parse)(Options& options);  // throws UsageError and HelpRequest
};

// parse: Job(Options&). run: ExitCode(Job) or void(Job); by value or by reference to const.
template <auto parse, auto run>
constexpr Command make_command(std::string_view name, std::string_view summary) {
  return {name, summary, [](Options& options) -> Invocation {
            auto job = parse(options);
            return {options.given_words(), [job = std::move(job)] {
                      if constexpr (std::is_void_v<decltype(run(job))>) {
                        run(job);
                        return kExitOk;
                      } else {
                        return run(job);
                      }
                    }};
          }};
}

// All commands, in the order of the overview. Help, man pages, completion, ods submit and the tests read this table.
std::span<const Command> commands();

// Returns null if there is no such command.
const Command* find_command(std::string_view name);

// Parses the arguments that follow the command's name, applies the console's options, and runs the job. Prints help if
// it is requested, or the error as one line.
ExitCode run_command(const Command& command, std::vector<std::string> words);
