// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command's exit codes; docs/console.md has the table. A signal ends the process with 128 + its number: 130 for
// Ctrl-C, 143 for SIGTERM.
#pragma once

enum ExitCode {
  kExitOk = 0,
  kExitFailure = 1,  // any other failure
  kExitUsage = 2,    // the command line is wrong
  kExitInput = 3,    // a file is missing, malformed or unsupported
  kExitOutput = 4,   // a file could not be written
  kExitFault = 5,    // the command judged its input, and found a fault
};
