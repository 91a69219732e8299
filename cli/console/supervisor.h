// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The process between ods and another program (cli/console/programs.h): this very program, started under the name
// kSupervisor. It runs the program to its end and then ends all that the program has left running. As soon as its stdin
// is closed, which the kernel does for an ods that was killed, too, it ends the program early.
#pragma once

inline constexpr const char* kSupervisor = "ods-supervisor";

// argv: kSupervisor; a folder to be removed, with what is in it, if the program is ended early, or ""; the program's
// words. Returns the program's exit code, 128 + the signal that ended it, or 127 if it cannot be started.
int supervise(int argc, char** argv);
