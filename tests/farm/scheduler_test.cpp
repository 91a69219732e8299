// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The files for a scheduler are read by the parsers of its language, and each task is run as the scheduler would, with
// a program in place of ods that prints its arguments.
#include "ods/farm/scheduler.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "ods/base/error.h"
#include "tests/support/schedulers.h"

namespace ods {
namespace {

using nlohmann::json;

// Flamenco runs the script in an engine of its own; node runs the same language.
TEST_F(Schedulers, FlamencoCompilesToTheSameTasks) {
  if (const std::string why = missing("node", "command -v node"); !why.empty()) GTEST_SKIP() << why;
  write(Scheduler::kFlamenco);
  folder.write("stubs.js",
               "const tasks = [];\n"
               "const author = {\n"
               "  Task: (name, type) => ({ name, type, commands: [], after: [],\n"
               "    addCommand(c) { this.commands.push(c); }, addDependency(t) { this.after.push(t.name); } }),\n"
               "  Command: (name, parameters) => ({ name, parameters }),\n"
               "};\n"
               "const job = { settings: {}, addTask: (task) => tasks.push(task) };\n");
  folder.write("run.js",
               "\nfor (const s of JOB_TYPE.settings) job.settings[s.key] = s.default;\ncompileJob(job);\n"
               "console.log(JSON.stringify(tasks));\n");
  const Ran ran = run_line("cd " + folder.path("") + " && cat stubs.js " + in_folder("film_1.js") +
                           " run.js >all.js && node all.js");
  ASSERT_EQ(ran.code, 0) << ran.out;
  const json tasks = json::parse(ran.out);
  ASSERT_EQ(tasks.size(), 13u);
  std::vector<std::string> names;
  for (size_t i = 0; i < tasks.size(); i++) {
    const json& command = tasks[i]["commands"].at(0);
    EXPECT_EQ(tasks[i]["type"], "misc");
    EXPECT_EQ(command["name"], "exec");
    std::vector<std::string> words = {command["parameters"]["exe"]};
    for (const std::string word : command["parameters"]["args"]) words.push_back(word);
    const bool last = i == 12;
    EXPECT_EQ(words, task_arguments(plan, plan.groups[last ? 1 : 0], last ? 1 : static_cast<int>(i) + 1));
    EXPECT_EQ(tasks[i]["after"], last ? json(names) : json::array());
    names.push_back(tasks[i]["name"]);
  }
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 13u);
}

TEST_F(Schedulers, FlamencoGetsNoNameWithAVariable) {
  set_names({"{blender}.glb"});
  EXPECT_THROW(write(Scheduler::kFlamenco), Error);
  set_names({"}{ a {.glb"});
  EXPECT_NO_THROW(write(Scheduler::kFlamenco));
}

// Files for a hundred thousand tasks are as long as for ten, except for Slurm's arrays.
TEST_F(Schedulers, ManyTasksAreFewFiles) {
  plan.groups[0].tasks = 100'000;
  for (const SchedulerRow& row : kSchedulerTable) {
    choices.mount = "/disk", plan.cpus = 4;
    const std::vector<FarmFile> files = row.write(plan, choices);
    EXPECT_TRUE(files.size() <= 5 || row.member == Scheduler::kSlurm) << row.name;
    EXPECT_EQ(files.size() == 102, row.member == Scheduler::kSlurm) << row.name;
    for (const FarmFile& file : files) EXPECT_LT(file.text.size(), 20'000u) << row.name;
  }
}

}  // namespace
}  // namespace ods
