// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The documentation of the commands and their options: one table per command, written as help, as a man page or as a
// part of a completion script for a shell. `ods --help=man`, `ods render --help=man`, `ods --help=bash` and `ods
// --help=zsh` print the latter; the build and the package install them.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console/value_kind.h"

enum class ManualFormat { kHelp, kMan, kBash, kZsh };

// "--help" and "-h", or "--help=man", "--help=bash", "--help=zsh"; nullopt for other arguments.
std::optional<ManualFormat> manual_format(std::string_view word);

struct ManualEntry {
  enum class Kind { kHeading, kArgument, kOption };
  Kind kind;
  std::string name;                      // "-o,--output"; "SCENE"; a heading's text
  ValueKind value = "";                  // of an option or an argument
  std::string text = {};                 // its description
  std::vector<std::string> values = {};  // values that completion offers for it
  bool repeats = false;
};

// The manual of one command.
struct Manual {
  std::string command;   // "render"
  std::string summary;   // sentences
  std::string examples;  // lines, indented by two spaces
  std::string usage;     // "SCENE [OPTION...]"
  std::vector<ManualEntry> entries;
};

std::string write_manual(const Manual& manual, ManualFormat format);

struct CommandSummary {
  std::string name, summary;
};

// Writes the manual of ods itself. In a completion script, write_manual() of every command and end_of_overview()
// follow.
std::string write_overview(const std::vector<CommandSummary>& commands, ManualFormat format);
std::string end_of_overview(ManualFormat format);
