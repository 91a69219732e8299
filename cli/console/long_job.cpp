// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/long_job.h"

#include <tbb/global_control.h>

#include <iostream>
#include <optional>

#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "ods/base/names.h"

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void add_progress_options(Options& options, ProgressMode& mode) {
  const auto set = [&mode, &console = options.console()](size_t i) {
    mode = kProgressModes[i];
    console.json = mode == ProgressMode::kJson;
  };
  options.choice("--progress", ods::names_of(kProgressModeTable), std::string(progress_mode_name(mode)), set,
                 "how to report progress: deadline, openjd and tractor print their lines on stdout; json makes every "
                 "line on stderr a JSON object");
  options.at_once("--progress");  // so that errors in other options are JSON, too
  add_console_options(options);
}

void add_restart_option(Options& options, bool& restart) {
  options.flag("--restart", restart, "discard what an interrupted run of this command has left, and start over");
}

static ProgressMode resolved(ProgressMode mode) {
  if (mode != ProgressMode::kAuto) return mode;
  if (console.quiet) return ProgressMode::kNone;
  return stderr_is_terminal() ? ProgressMode::kBar : ProgressMode::kPlain;
}

void run_long_job(ProgressMode mode, int threads, const std::function<void(ProgressLines& lines)>& work) {
  mode = resolved(mode);
  end_on_interrupts(interrupted_line(mode));
  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  ProgressLines lines(mode, progress_is_for_farm(mode) ? std::cout : std::cerr);
  try {
    work(lines);
  } catch (const std::exception& error) {
    lines.fail(with_options(error.what()));
    throw;
  }
}
