// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shared by long-running commands: progress, interrupts, thread limit.
#pragma once
#include <chrono>
#include <functional>

#include "cli/console/options.h"
#include "cli/console/progress.h"

double seconds_since(std::chrono::steady_clock::time_point start);

// Adds --progress, --quiet and --no-color to the current group.
void add_progress_options(Options& options, ProgressMode& mode);

// Adds --restart to the current group: without it, an interrupted command resumes.
void add_restart_option(Options& options, bool& restart);

// Runs the work with this many threads (0: all) until it is done, fails or is interrupted. A failure is reported to the
// farm and rethrown.
void run_long_job(ProgressMode mode, int threads, const std::function<void(ProgressLines& lines)>& work);
