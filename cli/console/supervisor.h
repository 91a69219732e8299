// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The process between ods and another program (cli/console/programs.h): this program itself, started under the name
// kSupervisor. It runs the program to its end and then ends all programs that this has left running. As soon as its
// stdin is closed, which the kernel also does for a killed ods, it ends the program early.
#pragma once

inline constexpr const char* kSupervisor = "ods-supervisor";

// argv: kSupervisor; a folder to be removed, with its contents, if the program is ended early, or ""; the program's
// arguments. Returns the program's exit code, 128 + the signal that ended it, or 127 if it cannot be started.
int supervise(int argc, char** argv);
