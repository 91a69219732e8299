// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"

namespace ods {

namespace {

// The plug-in replaces <STARTFRAME> and the like, and splits the line at spaces outside of double quotes.
std::string word_of(const std::string& word) {
  if (word.find_first_of("\"\\<>") != std::string::npos) {
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' has a quote, a backslash or an angle bracket, which Deadline's command line cannot "
                            "hold; rename the file",
                            word));
  }
  return shell_word(word) == word ? word : "\"" + word + "\"";
}

std::string arguments_of(const FarmPlan& plan, const TaskGroup& group) {
  std::string line;
  for (const std::string& word : group.command) line += word_of(word) + " ";
  line += "--progress deadline";
  if (plan.cpus > 0) line += fmt::format(" --threads {}", plan.cpus);
  if (!group.option.empty()) line += fmt::format(" {} <STARTFRAME>/{}", group.option, group.tasks);
  return line;
}

std::string job_info(const FarmPlan& plan, const TaskGroup& group) {
  std::string text = fmt::format(
      "Plugin=CommandLine\nName={0} "
      "{1}\nBatchName={0}\nFrames={2}\nChunkSize=1\nMachineLimit=0\nOnJobComplete=Nothing\n",
      plan.name, group.name, group.tasks == 1 ? "1" : fmt::format("1-{}", group.tasks));
  int outputs = 0;
  for (const PlanPath& path : plan.paths) {
    if (!path.is_output) continue;
    const std::string folder = path.is_folder ? path.path : std::filesystem::path(path.path).parent_path().native();
    text += fmt::format("OutputDirectory{}={}\n", outputs++, folder);
  }
  return text;
}

constexpr const char* kSubmit = R"sh(#!/bin/sh
# Sends the jobs to Deadline 10, each behind the one before; prints their numbers. Stops at the first that is not taken.
set -eu
cd "$(dirname "$0")"
before=
send() {  # GROUP
  cp "$1.job_info" "$1.sent.job_info"
  [ -z "$before" ] || echo "JobDependencies=$before" >>"$1.sent.job_info"
  code=0
  answer=$(deadlinecommand "$1.sent.job_info" "$1.plugin_info") || code=$?
  before=$(printf '%s\n' "$answer" | sed -n 's/^JobID=\([[:alnum:]-]*\).*/\1/p')
  if [ $code != 0 ] || [ -z "$before" ]; then
    printf '%s\n' "$answer" "submit.sh: deadlinecommand has not taken $1 (exit code $code); nothing behind it was sent" >&2
    exit 1
  fi
  echo "$before $1"
}
)sh";

}  // namespace

std::vector<FarmFile> write_deadline(const FarmPlan& plan, const SchedulerWishes&) {
  std::vector<FarmFile> files;
  std::string submit = kSubmit;
  for (const TaskGroup& group : plan.groups) {
    files.push_back({group.name + ".job_info", job_info(plan, group)});
    files.push_back({group.name + ".plugin_info",
                     fmt::format("Executable={}\nArguments={}\nShellExecute=False\nSingleFramesOnly=False\n",
                                 word_of(plan.program), arguments_of(plan, group))});
    submit += fmt::format("send {}\n", group.name);
  }
  files.push_back({"submit.sh", submit});
  return files;
}

}  // namespace ods
