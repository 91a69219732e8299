// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods jobs: how the jobs of ods submit get on in Slurm.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <thread>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/interrupt.h"
#include "cli/console/options.h"
#include "cli/console/print.h"
#include "cli/farm/job_report.h"
#include "cli/farm/queue.h"
#include "ods/farm/plan.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* kJobsExamples =
    "  ods jobs                            all jobs in Slurm\n"
    "  ods jobs scene_360_TB --follow      until it is over\n"
    "  ods jobs renders/scene_360_TB.farm  by its folder, also when Slurm has forgotten it\n"
    "  ods jobs --json";

struct JobsChoices {
  std::string name;
  bool follow = false, json = false;
};

bool is_folder_of_job(const std::string& name) {
  std::error_code ignored;
  return fs::exists(name + "/plan.json", ignored);
}

// Throws ods::Error(kInput) if there is no job of that name.
std::vector<JobReport> find_jobs(const JobsChoices& choices) {
  const bool by_folder = !choices.name.empty() && is_folder_of_job(choices.name);
  const auto [tasks, fault] = read_queue();
  if (!fault.empty() && !by_folder) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("there is no Slurm here: {}; ods jobs FOLDER reads a job's folder", fault));
  }
  if (by_folder) {
    const JobReport job = report_job(ods::absolute_folder(choices.name), tasks);
    if (choices.follow && !job.is_known()) {
      throw UsageError(fmt::format("--follow asks Slurm, and '{}' was written for {}", job.name, job.scheduler));
    }
    return {job};
  }
  std::set<std::string> folders;
  for (const ods::SlurmTask& task : tasks) folders.insert(task.folder);
  std::vector<JobReport> jobs;
  for (const std::string& folder : folders) {
    if (!is_folder_of_job(folder)) {
      warn(fmt::format("'{}' has no plan: it was moved, or is on another disk", folder));
      continue;
    }
    const JobReport job = report_job(folder, tasks);
    if (choices.name.empty() || job.name == choices.name) jobs.push_back(job);
  }
  if (jobs.empty() && !choices.name.empty()) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("Slurm has no job '{}'; ods jobs FOLDER reads its folder, "
                                                         "NAME.farm beside its output",
                                                         choices.name));
  }
  return jobs;
}

JobsChoices parse_jobs(Options& options) {
  JobsChoices choices;
  options.describe("Shows how much is done, running, waiting and failed of the jobs that ods submit sent to Slurm.",
                   kJobsExamples);
  options.optional_argument("NAME", choices.name, "a job, or its folder; by default all");
  options.flag("--follow", choices.follow,
               "show it again every five seconds until the job has ended; exit code 1 if it is not complete, 5 if it "
               "judged its input and found a fault");
  options.flag("--json", choices.json, "print it as JSON");
  options.group("Console");
  add_console_options(options);
  options.parse();
  return choices;
}

ExitCode show_jobs(const JobsChoices& choices) {
  if (choices.follow) end_on_interrupts();
  std::vector<JobReport> found;
  std::string before;
  while (true) {
    found = find_jobs(choices);
    const std::string text = choices.json ? report_json(found) : found.empty() ? "no jobs\n" : report_text(found);
    if (text != before) put_out(text);
    std::fflush(stdout);
    before = text;
    const bool over = std::ranges::all_of(found, [](const JobReport& job) { return job.is_over(); });
    if (!choices.follow || over) break;
    std::this_thread::sleep_for(std::chrono::seconds(5));
  }
  if (!choices.follow) return kExitOk;
  for (const JobReport& job : found) {
    if (!job.is_done())
      throw ods::Error(ods::ErrorKind::kCancelled, fmt::format("'{}' has ended, but it is not complete", job.name));
  }
  return std::ranges::any_of(found, &JobReport::found_fault) ? kExitFault : kExitOk;
}

}  // namespace

extern const Command kJobs = make_command<parse_jobs, show_jobs>("jobs", "show the progress of Slurm jobs");
