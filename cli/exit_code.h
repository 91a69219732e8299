// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the command tells the shell. Interrupted, it is 128 + the signal's number: 130 or 143.
#pragma once

enum ExitCode {
  kExitOk = 0,
  kExitRenderError = 1,  // anything not below
  kExitUsage = 2,        // the command line is wrong
  kExitInput = 3,        // a file that is absent, broken or not supported
  kExitOutput = 4,       // a file that could not be written
};
