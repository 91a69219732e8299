// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a plan as the job files of each scheduler. Nothing here sends them.
//
//   slurm       an array of jobs per group (as many arrays as it takes), and submit.sh, which sends them in order
//   openjd      template.json of the base specification jobtemplate-2023-09, with parameter_values.json a job bundle;
//               openjd_parameters.json has the same values for the command openjd
//   opencue     job.xml of cjsl-1.15: a layer per group
//   flamenco    a job type in JavaScript
//   kubernetes  an Indexed Job per group, and submit.sh, which applies one after the other
//
// A scheduler is here if its job files can be checked: by its own tool, or by a published schema.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/farm/plan.h"

namespace ods {

// Settings that only some schedulers need, and that are not in the plan.
struct SchedulerChoices {
  int largest_array = 1001;         // Slurm's MaxArraySize: indices are below it
  std::vector<std::string> extras;  // Slurm: options of sbatch, "--partition=render"
  std::string image = "ods";        // Kubernetes: of the containers
  std::string volume = "ods";       // Kubernetes: the claim of the disk with the files
  std::string mount;                // Kubernetes: where the claim is mounted; absolute
};

struct FarmFile {
  std::string name;  // in the plan's folder
  std::string text;
};

// Throw Error(kUsage) for arguments that the scheduler's language cannot express. Precondition: check_quotable().
std::vector<FarmFile> write_slurm(const FarmPlan& plan, const SchedulerChoices& choices);
std::vector<FarmFile> write_openjd(const FarmPlan& plan, const SchedulerChoices& choices);
std::vector<FarmFile> write_opencue(const FarmPlan& plan, const SchedulerChoices& choices);
std::vector<FarmFile> write_flamenco(const FarmPlan& plan, const SchedulerChoices& choices);
std::vector<FarmFile> write_kubernetes(const FarmPlan& plan, const SchedulerChoices& choices);

enum class Scheduler { kSlurm, kOpenJd, kOpenCue, kFlamenco, kKubernetes };

struct SchedulerRow {
  Scheduler member;
  std::string_view name;
  std::vector<FarmFile> (*write)(const FarmPlan& plan, const SchedulerChoices& choices);
  std::string_view next;  // the next step for people, in the plan's folder
};

inline constexpr SchedulerRow kSchedulerTable[] = {
    {Scheduler::kSlurm, "slurm", write_slurm, "sh submit.sh"},
    {Scheduler::kOpenJd, "openjd", write_openjd,
     "deadline bundle submit ., or openjd run template.json --step NAME -p file://openjd_parameters.json"},
    {Scheduler::kOpenCue, "opencue", write_opencue, "send job.xml with opencue.api.launchSpec()"},
    {Scheduler::kFlamenco, "flamenco", write_flamenco, "copy the script into the Manager's folder scripts"},
    {Scheduler::kKubernetes, "kubernetes", write_kubernetes, "sh submit.sh"},
};
static_assert(has_every_member(kSchedulerTable));

}  // namespace ods
