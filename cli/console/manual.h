// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods says about its commands and their options: one table per command, written as help, as a man page or as a
// part of a completion script for a shell. `ods --help=man`, `ods render --help=man`, `ods --help=bash` and
// `ods --help=zsh` print the latter; the build and the package install them.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/console/value_kind.h"

enum class ManualFormat { kHelp, kMan, kBash, kZsh };

// "--help" and "-h", or "--help=man", "--help=bash", "--help=zsh"; nothing for other words.
std::optional<ManualFormat> manual_format(std::string_view word);

struct ManualEntry {
  enum class Kind { kHeading, kArgument, kOption };
  Kind kind;
  std::string name;                      // "-o,--output"; "SCENE"; the words of a heading
  ValueKind value = "";                  // of an option, or what an argument is
  std::string text = {};                 // what it does
  std::vector<std::string> values = {};  // what completion offers for it
  bool repeats = false;
};

// Of one command.
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

// Of ods itself. A completion script goes on with write_manual() of every command, then end_of_overview().
std::string write_overview(const std::vector<CommandSummary>& commands, ManualFormat format);
std::string end_of_overview(ManualFormat format);
