// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of a command, read and checked by the command itself, which does not begin its work.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "cli/console/options.h"

// Runs the command up to run_long_job() (cli/console/long_job.h). Nothing if help was requested. Throws what the
// command would print. Precondition: the command calls run_long_job().
std::optional<std::vector<GivenWord>> checked_words(const std::function<void()>& command);

// --- for the console -------------------------------------------------------------------------------------------------

// Whether a command is only checked: then run_command() lets exceptions through, and run_long_job() calls end_check().
bool only_checks();
[[noreturn]] void end_check();

// What a command line had.
void keep_given(std::vector<GivenWord> given);
