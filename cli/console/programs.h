// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Other programs, run to their end.
#pragma once
#include <optional>
#include <string>
#include <vector>

struct ProgramResult {
  int code = 0;  // its exit code; 128 + the signal that ended it
  std::string out;
};

// Leaves in PATH only absolute folders, for us and for the programs that we start: none in the current folder is run,
// which may have come with the files there.
void restrict_path();

// Where PATH finds a program of that name; empty: nowhere. Relative folders do not count.
std::string program_path(const std::string& name);
// Whether that is a file that we may run, not a folder.
bool is_program(const std::string& path);
bool has_program(const std::string& name);

enum class ProgramErrors { kShown, kHidden };

// What it prints on stdout. Nothing if there is no such program.
std::optional<ProgramResult> run_program(const std::vector<std::string>& words,
                                         ProgramErrors errors = ProgramErrors::kHidden);

// Path of this very program.
std::string own_program();
