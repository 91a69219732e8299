// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What commands that take long share: progress, interrupts, a limit of threads.
#pragma once
#include <chrono>
#include <functional>

#include "cli/console/options.h"
#include "cli/console/progress.h"

double seconds_since(std::chrono::steady_clock::time_point start);

// --progress, --quiet, --no-color, in a group that is open already.
void add_progress_options(Options& options, ProgressMode& mode);

// Runs the work with its lines, on so many threads (0: all), until it is done, fails or is interrupted. A failure is
// told to the farm, and thrown on.
void run_long_job(ProgressMode mode, int threads, const std::function<void(ProgressLines& lines)>& work);
