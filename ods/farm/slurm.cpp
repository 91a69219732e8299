// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"
#include "ods/farm/slurm_answers.h"

namespace ods {

namespace {

constexpr const char* kLimit = "${SLURM_CPUS_PER_TASK:-${SLURM_CPUS_ON_NODE:-0}}";

// A part of a group: Slurm limits the length of arrays.
struct Array {
  const TaskGroup& group;
  size_t number;  // counted from 1
  int before;     // tasks of the arrays before it
  int tasks;
  std::string script() const { return fmt::format("{}-{}.sbatch", group.name, number); }
};

std::vector<Array> arrays_of(const TaskGroup& group, int largest_array) {
  const int most = std::max(1, largest_array - 1);  // indices count from 1
  std::vector<Array> arrays;
  for (int before = 0; before < group.tasks; before += most) {
    arrays.push_back({group, arrays.size() + 1, before, std::min(most, group.tasks - before)});
  }
  return arrays;
}

std::string directives(const FarmPlan& plan, const Array& array, const SchedulerWishes& wishes) {
  std::string text = fmt::format("#SBATCH --job-name={}.{}\n", plan.name, array.group.name);
  if (!array.group.option.empty()) text += fmt::format("#SBATCH --array=1-{}\n", array.tasks);
  text += "#SBATCH --output=/dev/null\n#SBATCH --requeue\n#SBATCH --signal=B:USR1@60\n#SBATCH --ntasks=1\n";
  text += plan.cpus > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", plan.cpus) : "#SBATCH --exclusive\n";
  text += fmt::format("#SBATCH --mem={}M\n", (plan.memory + (1 << 20) - 1) >> 20);
  for (const std::string& extra : wishes.extras) text += fmt::format("#SBATCH {}\n", extra);
  return text;
}

std::string command_line(const FarmPlan& plan, const TaskGroup& group) {
  std::vector<std::string> words = {plan.program};
  words.insert(words.end(), group.command.begin(), group.command.end());
  std::string line = fmt::format("{} --threads \"{}\"", shell_line(words), kLimit);
  if (!group.option.empty()) line += fmt::format(" {} \"$task/{}\"", group.option, group.tasks);
  return line;
}

// The log has a line per try. A command line that is wrong (exit code 2) is so on every machine; all else is tried
// again, since disks fill and empty, and network disks show files late. At the end of the time limit the task goes back
// into the queue; its next machine finds what it left.
constexpr const char* kScript = R"sh(#!/bin/sh
{0}
folder={1}
task={2}
mkdir -p "$folder/logs" "$folder/ended"
rm -f "$folder/ended/{3}.$task"
exec >>"$folder/logs/{3}.$task.log" 2>&1
late=no
trap 'late=yes; kill -TERM "$child"' USR1
for try in 1 2 3; do
  echo "{3} $task of {4}, try $try, job $SLURM_JOB_ID on $(hostname), $(date)"
  {5} &
  child=$!
  code=0
  wait "$child" || code=$?
  if [ $late = yes ]; then
    wait "$child" || :
    scontrol requeue "$SLURM_JOB_ID"
    exit 143
  fi
  case $code in 0 | 2) break ;; esac
  [ $try = 3 ] || sleep $((5 * try))
done
echo "$code" >"$folder/ended/{3}.$task"
exit "$code"
)sh";

std::string script_of(const FarmPlan& plan, const Array& array, const SchedulerWishes& wishes) {
  const std::string task =
      array.group.option.empty() ? "1" : fmt::format("$((SLURM_ARRAY_TASK_ID + {}))", array.before);
  return fmt::format(kScript, directives(plan, array, wishes), shell_word(plan.folder), task, array.group.name,
                     array.group.tasks, command_line(plan, array.group));
}

constexpr const char* kSubmit = R"sh(#!/bin/sh
# Sends the job to Slurm, each group of tasks behind the one before, and prints the number of every array. What was sent
# is cancelled if something cannot be sent.
set -eu
folder={}
all="" group="" before=""
trap 'code=$?; [ $code = 0 ] || [ -z "$all" ] || scancel $all' EXIT
next() {{ before="--dependency=afterok$group --kill-on-invalid-dep=yes" group=""; }}
send() {{  # SCRIPT COMMENT
  id=$(sbatch --parsable $before --comment="$2:$folder" "$folder/$1")
  id=${{id%%;*}}
  all="$all $id" group="$group:$id"
  echo "$id $1 $2"
}}
)sh";

}  // namespace

std::vector<FarmFile> write_slurm(const FarmPlan& plan, const SchedulerWishes& wishes) {
  std::vector<FarmFile> files;
  std::string submit = fmt::format(kSubmit, shell_word(plan.folder));
  for (const TaskGroup& group : plan.groups) {
    if (&group != &plan.groups.front()) submit += "next\n";
    for (const Array& array : arrays_of(group, wishes.largest_array)) {
      files.push_back({array.script(), script_of(plan, array, wishes)});
      submit += fmt::format("send {} {}\n", array.script(), slurm_comment(group.name, array.before));
    }
  }
  files.push_back({"submit.sh", submit});
  return files;
}

}  // namespace ods
