// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the command tells the shell; docs/console.md has the table. A signal ends it with 128 + its number: 130 for
// Ctrl-C, 143 for SIGTERM.
#pragma once

enum ExitCode {
  kExitOk = 0,
  kExitFailure = 1,  // anything not below
  kExitUsage = 2,    // the command line is wrong
  kExitInput = 3,    // a file that is absent, broken or not supported
  kExitOutput = 4,   // a file that could not be written
};
