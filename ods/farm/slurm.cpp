// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"
#include "ods/farm/slurm_answers.h"
#include "ods/files/frames.h"

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
  const int maximum = std::max(1, largest_array - 1);  // indices count from 1
  std::vector<Array> arrays;
  for (int before = 0; before < group.tasks; before += maximum) {
    arrays.push_back({group, arrays.size() + 1, before, std::min(maximum, group.tasks - before)});
  }
  return arrays;
}

std::string directives(const FarmPlan& plan, const Array& array, const SchedulerChoices& choices) {
  std::string text = fmt::format("#SBATCH --job-name={}.{}\n", plan.name, array.group.name);
  if (!array.group.option.empty()) text += fmt::format("#SBATCH --array=1-{}\n", array.tasks);
  text += "#SBATCH --output=/dev/null\n#SBATCH --requeue\n#SBATCH --signal=B:USR1@60\n#SBATCH --ntasks=1\n";
  text += plan.cpus > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", plan.cpus) : "#SBATCH --exclusive\n";
  text += fmt::format("#SBATCH --mem={}M\n", (memory_of(plan, array.group) + (1 << 20) - 1) >> 20);
  for (const std::string& extra : choices.extras) text += fmt::format("#SBATCH {}\n", extra);
  return text;
}

std::string command_line(const FarmPlan& plan, const TaskGroup& group) {
  std::vector<std::string> words = {plan.program};
  words.insert(words.end(), group.command.begin(), group.command.end());
  std::string line = fmt::format("{} --threads \"{}\"", shell_line(words), kLimit);
  if (!group.option.empty()) line += fmt::format(" {} \"$task/{}\" >>\"$files\"", group.option, group.tasks);
  return line;
}

// The file that a part has before its own file exists; empty for other groups.
std::string unfinished_file(const TaskGroup& group) {
  const auto output = std::ranges::find(group.command, "-o");
  if (group.option != "--part" || output == group.command.end()) return "";
  const std::optional<FrameNames> names = frame_names(*std::next(output));
  if (!names) return "";
  return fmt::format("{}$(printf %0{}d \"$task\"){}", shell_word(names->before), names->digits,
                     shell_word(names->after + ".unfinished"));
}

// "starts" has a line per start, "files" the files that the command makes. A wrong command line (exit code 2) is wrong
// on every machine, and a verdict (5) is the same on all; after any other failure the task is requeued, for another
// node if there is one, since disks fill and empty, network disks show files late, and machines break; a task at the
// end of its time limit is requeued, too, and its next start resumes. The third start without a file is the last, also
// if the node fails or preempts the task.
constexpr const char* kSlurmScript = R"sh(#!/bin/sh
{0}
folder={1}
task={2}
unfinished={6}
node=${{SLURMD_NODENAME:-$(hostname)}}
starts="$folder/starts/{3}.$task" files="$folder/logs/{3}.$task.files"
mkdir -p "$folder/logs" "$folder/ended" "$folder/starts"
rm -f "$folder/ended/{3}.$task"
exec >>"$folder/logs/{3}.$task.log" 2>&1
touch "$files" "$starts"

# What there is of the task, as a word.
made() {{ echo "$(wc -l <"$files")$(stat -c /%Y/%s "$unfinished" 2>/dev/null)"; }}
before=$(made)
# The nodes of this job's starts that found no more than this one did.
in_vain() {{ sed -n "s|^$SLURM_JOB_ID $before ||p" "$starts"; }}
is_stuck() {{ [ "$(made)" = "$before" ] && [ "$(in_vain | wc -l)" -ge 3 ]; }}
end() {{
  echo "$1" >"$folder/ended/{3}.$task"
  exit "$1"
}}

# Slurm ends this script for it, but not at once.
again() {{  # CODE
  trap '' TERM
  scontrol requeue "$SLURM_JOB_ID" || end "$1"
  nodes() {{ sinfo --noheader --Node --partition="$SLURM_JOB_PARTITION" "$@"; }}
  fits="\$2 >= ${{SLURM_MEM_PER_NODE:-0}} && \$3 >= ${{SLURM_CPUS_PER_TASK:-1}} {{print \$1}}"
  tried=$(in_vain | sort -u)
  if [ "{7}" = anywhere ] && [ "$(made)" = "$before" ] &&
    nodes --states=idle,mixed,allocated --format='%N %m %c' | awk "$fits" | grep -qvxF "$tried"; then
    scontrol update JobId="$SLURM_JOB_ID" ExcNodeList="$(echo "$tried" | paste -sd ,)"
  fi
  most=$(nodes --format=%m | sort -n | tail -n 1) memory=${{SLURM_MEM_PER_NODE:-0}}
  more=$((2 * memory < ${{most:-0}} ? 2 * memory : ${{most:-0}}))
  if [ "$1" = 137 ] && [ $memory -gt 0 ] && [ $more -gt "$memory" ]; then
    scontrol update JobId="$SLURM_JOB_ID" MinMemoryNode=$more
  fi
  exit "$1"
}}

if is_stuck; then
  echo "ods: error: three starts have ended without a file or a message, on $(in_vain | paste -sd ' ')"
  end 1
fi
echo "$SLURM_JOB_ID $before $node" >>"$starts"
late=no
trap 'late=yes; kill -TERM "$child"' USR1
echo "{3} $task of {4}, try $(in_vain | wc -l), job $SLURM_JOB_ID on $node, $(date)"
{5} &
child=$!
code=0
wait "$child" || code=$?
if [ $late = yes ]; then
  wait "$child" || :
  code=143
fi
case $code in 0 | 2 | 5) end "$code" ;; esac
is_stuck || again "$code"
[ $late = no ] ||
  echo "ods: error: the time limit was over three times before a file was made: more time (--sbatch --time=...) or less work"
end "$code"
)sh";

// Returns whether no option of sbatch restricts the nodes of the tasks.
bool runs_anywhere(const SchedulerChoices& choices) {
  constexpr std::array<std::string_view, 9> kOthers = {"--partition", "-p", "--time",    "-t",    "--qos",
                                                       "-q",          "-A", "--account", "--nice"};
  return std::ranges::all_of(choices.extras, [&](const std::string& extra) {
    const std::string name = extra.starts_with("--") ? extra.substr(0, extra.find_first_of("= ")) : extra.substr(0, 2);
    return std::ranges::find(kOthers, name) != kOthers.end();
  });
}

std::string script_of(const FarmPlan& plan, const Array& array, const SchedulerChoices& choices) {
  const std::string task =
      array.group.option.empty() ? "1" : fmt::format("$((SLURM_ARRAY_TASK_ID + {}))", array.before);
  return fmt::format(kSlurmScript, directives(plan, array, choices), shell_word(plan.folder), task, array.group.name,
                     array.group.tasks, command_line(plan, array.group), unfinished_file(array.group),
                     runs_anywhere(choices) ? "anywhere" : "where told");
}

constexpr const char* kSlurmSubmit = R"sh(#!/bin/sh
# Sends the job to Slurm, each group of tasks behind the one before, and prints the number of every array. What was sent
# is cancelled if something cannot be sent.
set -eu
folder={}
all="" group="" before=""
trap 'code=$?; [ $code = 0 ] || [ -z "$all" ] || scancel $all' EXIT
trap 'exit 143' HUP INT TERM
next() {{ before="--dependency=afterok$group --kill-on-invalid-dep=yes" group=""; }}
send() {{  # SCRIPT COMMENT
  id=$(sbatch --parsable $before --comment="$2:$folder" "$folder/$1")
  id=${{id%%;*}}
  all="$all $id" group="$group:$id"
  echo "$id $1 $2"
}}
)sh";

}  // namespace

std::vector<FarmFile> write_slurm(const FarmPlan& plan, const SchedulerChoices& choices) {
  std::vector<FarmFile> files;
  std::string submit = fmt::format(kSlurmSubmit, shell_word(plan.folder));
  for (const TaskGroup& group : plan.groups) {
    if (&group != &plan.groups.front()) submit += "next\n";
    for (const Array& array : arrays_of(group, choices.largest_array)) {
      files.push_back({array.script(), script_of(plan, array, choices)});
      submit += fmt::format("send {} {}\n", array.script(), slurm_comment(group.name, array.before));
    }
  }
  files.push_back({"submit.sh", submit});
  return files;
}

}  // namespace ods
