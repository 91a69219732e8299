// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages for people: one line each, on stderr. stdout is for results only.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cli/console/exit_code.h"
#include "ods/base/error.h"

// The command line is invalid. what() is one line.
struct UsageError : ods::Error {
  explicit UsageError(const std::string& message) : Error(ods::ErrorKind::kUsage, message) {}
};

struct Console {
  bool quiet = false;     // prints only errors, and text that is a command's result
  bool no_color = false;  // NO_COLOR, TERM=dumb and a stderr that is not a terminal have the same effect
  bool json = false;      // every line is a JSON object, as described below
};

extern Console console;

// The files that the command reads, for the message that memory has run out: then it is too late to make one.
void name_inputs(const std::vector<std::string>& files);

// Returns whether stderr is a terminal that can move its cursor.
bool stderr_is_terminal();

// Replaces the names of settings in messages of the library, `layout`, by the options of the command, --layout. The
// functions below do it themselves; text that is printed in other ways must pass through this.
std::string with_options(const std::string& text);

// "ods: text" or {"note":"text"}, unless quiet.
void note(const std::string& text);

// "ods: warning: text" or {"warning":"text"}, unless quiet.
void warn(const std::string& text);

// While one of these exists, note() and warn() leave out what they have printed since it was made: a command does its
// work twice. At most one at a time.
class SaidOnce {
 public:
  SaidOnce();
  ~SaidOnce();
  SaidOnce(const SaidOnce&) = delete;
  SaidOnce& operator=(const SaidOnce&) = delete;
};

// Prints the name of a written file on stdout, unless quiet.
void announce_file(const std::string& file);

// Runs a command's body and returns its exit code. An exception becomes one line on stderr, "ods: error: text" or
// {"error":"text","exit_code":3}, and the matching exit code (cli/console/exit_code.h).
ExitCode run_to_exit_code(const std::function<ExitCode()>& body);
