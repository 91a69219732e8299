// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"

namespace ods {

namespace {

// Flamenco replaces {NAME} by its variables, and has no way to escape one.
std::string flamenco_word(const std::string& word) {
  const size_t open = word.find('{');
  if (open != std::string::npos && word.find('}', open) != std::string::npos) {
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' has {{...}}, where Flamenco expects a variable; rename the file", word));
  }
  return json_text(word);
}

std::string group_text(const FarmPlan& plan, const TaskGroup& group) {
  std::string words;
  for (const std::string& word : group.command) words += flamenco_word(word) + ", ";
  if (plan.cpus > 0) words += fmt::format("\"--threads\", \"{}\", ", plan.cpus);
  words.resize(words.size() - 2);
  return fmt::format("  {{ name: {}, option: {}, tasks: {}, args: [{}] }},\n", json_text(group.name),
                     json_text(group.option), group.tasks, words);
}

constexpr const char* kFlamencoScript =
    R"(// A job type of Flamenco 3 for one job of ods: each group of tasks starts when the one before is done.
const JOB_TYPE = {{
  label: {0},
  settings: [
    {{ key: "program", type: "string", required: true, default: {1}, description: "ods, as the Workers call it" }},
  ],
}};

const GROUPS = [
{2}];

function compileJob(job) {{
  let before = [];
  for (const group of GROUPS) {{
    const tasks = [];
    for (let number = 1; number <= group.tasks; number++) {{
      const share = number + "/" + group.tasks;
      const task = author.Task(group.option ? group.name + " " + share : group.name, "misc");
      const args = group.option ? group.args.concat([group.option, share]) : group.args;
      task.addCommand(author.Command("exec", {{ exe: job.settings.program, args: args }}));
      for (const other of before) task.addDependency(other);
      job.addTask(task);
      tasks.push(task);
    }}
    before = tasks;
  }}
}}
)";

}  // namespace

std::vector<FarmFile> write_flamenco(const FarmPlan& plan, const SchedulerChoices&) {
  std::string groups;
  for (const TaskGroup& group : plan.groups) groups += group_text(plan, group);
  return {{plan.name + ".js", fmt::format(kFlamencoScript, json_text(plan.name), flamenco_word(plan.program), groups)}};
}

}  // namespace ods
