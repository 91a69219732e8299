// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods submit: splits a command for a render farm.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/print.h"
#include "cli/console/programs.h"
#include "cli/farm/copy_inputs.h"
#include "cli/farm/finished.h"
#include "cli/farm/job_summary.h"
#include "cli/farm/queue.h"
#include "cli/farm/submit_job.h"
#include "ods/base/quote.h"
#include "ods/files/atomic_file.h"

namespace fs = std::filesystem;

namespace {

constexpr float kSubmitLimit = 600;  // seconds for all of a job's sbatch

// The limits of this cluster.
void ask_slurm(const SubmitJob& job, const ods::FarmPlan& plan, ods::SchedulerChoices& choices) {
  const auto config = run_program({.words = {"scontrol", "show", "config"}, .limit = kSlurmLimit});
  const std::string text = config ? config->out : "";
  choices.largest_array = std::max(2, ods::slurm_setting(text, "MaxArraySize").value_or(1001));
  const int maximum = ods::slurm_setting(text, "MaxJobCount").value_or(10000), tasks = plan.groups.front().tasks;
  if (tasks < maximum || job.dry) return;
  throw UsageError(fmt::format("{} tasks are more than this cluster's MaxJobCount of {}: make them larger, --chunk {}",
                               tasks, maximum, (std::max(job.chunk, 1) * int64_t{tasks}) / (maximum / 2) + 1));
}

void print(const std::vector<ods::FarmFile>& files, const ods::FarmPlan& plan) {
  for (const ods::FarmFile& file : files) {
    put_out(fmt::format("# {}/{}\n{}\n", plan.folder, file.name, file.text));
  }
}

// Replaces the files of an earlier submission, except the logs.
void write(const std::vector<ods::FarmFile>& files, const ods::FarmPlan& plan) {
  std::error_code ignored;
  for (const char* name : {"/ended", "/starts"}) fs::remove_all(plan.folder + name, ignored);
  for (const ods::FarmFile& file : files) ods::write_file(plan.folder + "/" + file.name, file.text);
}

void check_idle(const ods::FarmPlan& plan) {
  const auto [tasks, fault] = read_queue();
  if (!fault.empty()) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("there is no Slurm here: {}; --dry-run prints what would be sent", fault));
  }
  for (const ods::SlurmTask& task : tasks) {
    const bool lives = task.state == ods::TaskState::kWaiting || task.state == ods::TaskState::kRunning;
    if (!lives || task.folder != plan.folder) continue;
    throw UsageError(fmt::format("'{}' has tasks in the queue, job {}: wait, or scancel them, or give another -o",
                                 plan.folder, task.job));
  }
}

void send(const ods::FarmPlan& plan) {
  const Program submit = {.words = {"sh", plan.folder + "/submit.sh"}, .limit = kSubmitLimit};
  const auto sent = run_program(submit);
  if (const std::string fault = program_fault(submit, sent); !fault.empty()) {
    throw ods::Error(ods::ErrorKind::kOutput,
                     fmt::format("Slurm did not accept the job ({}); try again: sh {}/submit.sh", fault,
                                 ods::shell_word(plan.folder)));
  }
  if (!sent->last_line.empty()) warn(fmt::format("Slurm: {}", sent->last_line));
  ods::write_file(plan.folder + "/jobs.txt", sent->out);
  if (!console.quiet) put_out(sent->out);
  note(fmt::format("ods jobs {} --follow shows its progress", ods::shell_word(plan.name)));
}

void submit(const SubmitJob& job) {
  SplitCommand split = split_command(job.command);
  const ods::SchedulerRow& scheduler = ods::row_in(ods::kSchedulerTable, *job.to);
  const bool is_slurm = scheduler.member == ods::Scheduler::kSlurm;
  FileCopies copies;
  if (job.copies) copies = move_inputs(split, make_plan(job, split).folder);
  ods::FarmPlan plan = make_plan(job, split);
  ods::check_quotable(plan);
  ods::check_writable(plan.folder + "/plan.json");
  scheduler.write(plan, job.choices);  // throws for settings that it does not support
  if (is_slurm && !job.dry) check_idle(plan);
  if (!job.dry && !split.restart && is_finished(plan, split)) {
    return note(fmt::format("'{}' is finished: there is nothing to do; remove it to make it again", split.output));
  }
  if (!job.dry) {
    copy_files(copies);
    split.prepare();
  }
  count_tasks(job, split, plan);
  ods::SchedulerChoices choices = job.choices;
  if (is_slurm) ask_slurm(job, plan, choices);
  std::vector<ods::FarmFile> files = scheduler.write(plan, choices);
  files.insert(files.begin(), {"plan.json", ods::write_plan(plan)});
  report_job(plan, split);
  if (job.dry) return print(files, plan);
  write(files, plan);
  if (is_slurm) return send(plan);
  for (const ods::FarmFile& file : files) announce_file(plan.folder + "/" + file.name);
  note(fmt::format("in '{}': {}", plan.folder, scheduler.next));
}

}  // namespace

extern const Command kSubmit =
    make_command<parse_submit, submit>("submit", "send a command to a render farm, split into tasks");
