// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What is written for a scheduler is read by the parsers of its language, and each task is run as the scheduler would,
// with a program in the place of ods that says how it was called.
#include "ods/farm/scheduler.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "ods/base/error.h"
#include "tests/support/schedulers.h"

namespace ods {
namespace {

using nlohmann::json;

// Flamenco runs the script in an engine of its own; node knows the same language.
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
    EXPECT_EQ(words, task_words(plan, plan.groups[last ? 1 : 0], last ? 1 : static_cast<int>(i) + 1));
    EXPECT_EQ(tasks[i]["after"], last ? json(names) : json::array());
    names.push_back(tasks[i]["name"]);
  }
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 13u);
}

TEST_F(Schedulers, DeadlineGetsAPairOfFilesPerJob) {
  if (const std::string why = missing("python3", "command -v python3"); !why.empty()) GTEST_SKIP() << why;
  EXPECT_THROW(write_deadline(plan, wishes), Error) << "it cannot be told of quotes";
  set_names({"a scene's $HOME.glb", "日本 & co.glb"});
  const std::vector<FarmFile> files = write(Scheduler::kDeadline);
  EXPECT_NE(text_of(files, "frames.job_info")
                .find("Plugin=CommandLine\nName=film_1 frames\nBatchName=film_1\n"
                      "Frames=1-12\nChunkSize=1\n"),
            std::string::npos);
  for (size_t group = 0; group < 2; group++) {
    const std::string words = by_python(
        "import shlex\n"
        "line = [l for l in text.split('\\n') if l.startswith('Arguments=')][0][10:].replace('<STARTFRAME>', '5')\n"
        "lexer = shlex.shlex(line, posix=True, punctuation_chars=False)\n"
        "lexer.quotes, lexer.escape, lexer.whitespace_split, lexer.commenters = '\"', '', True, ''\n"
        "for word in lexer: print(word)",
        group == 0 ? "frames.plugin_info" : "video.plugin_info");
    EXPECT_EQ(words, expected(group, 5, {"--progress", "deadline"}));
  }
  folder.write("deadlinecommand", "#!/bin/sh\ncat \"$1\" >>" + folder.path("sent") + "\necho JobID=abc123\n");
  const Ran ran = run_line(
      fmt::format("chmod +x {0}/deadlinecommand; PATH={0}:$PATH sh {1}", folder.path(""), in_folder("submit.sh")));
  EXPECT_EQ(ran.out, "abc123 frames\nabc123 video\n");
  const std::string sent = folder.read("sent");
  EXPECT_GT(sent.find("JobDependencies=abc123\n"), sent.find("Name=film_1 video"));
  EXPECT_NE(sent.find("JobDependencies=abc123\n"), std::string::npos);
}

// It may fail by its exit code, by what it prints, or with the second job only.
TEST_F(Schedulers, DeadlineStopsAtAJobThatIsNotTaken) {
  set_names({"scene.glb"});
  write(Scheduler::kDeadline);
  struct Failure {
    std::string command;
    std::string out;
    size_t asked;
  };
  const std::string why = "submit.sh: deadlinecommand has not taken ";
  const std::vector<Failure> failures = {
      {"echo JobID=abc123; exit 3", "JobID=abc123\n" + why + "frames (exit code 3); nothing behind it was sent\n", 1},
      {"echo 'Error: no plug-in'", "Error: no plug-in\n" + why + "frames (exit code 0); nothing behind it was sent\n",
       1},
      {"case $1 in video*) exit 1 ;; esac; echo JobID=abc-123",
       "abc-123 frames\n\n" + why + "video (exit code 1); nothing behind it was sent\n", 2}};
  for (const Failure& failure : failures) {
    folder.write("asked", "");
    folder.write("deadlinecommand", "#!/bin/sh\necho x >>" + folder.path("asked") + "\n" + failure.command + "\n");
    const Ran ran = run_line(
        fmt::format("chmod +x {0}/deadlinecommand; PATH={0}:$PATH sh {1}", folder.path(""), in_folder("submit.sh")));
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.out, failure.out);
    EXPECT_EQ(folder.read("asked").size(), 2 * failure.asked);
  }
}

// Of a hundred thousand tasks: as long as one of ten, but for Slurm's arrays.
TEST_F(Schedulers, ManyTasksAreFewFiles) {
  plan.groups[0].tasks = 100'000;
  for (const SchedulerRow& row : kSchedulerTable) {
    if (row.member == Scheduler::kDeadline) set_names({"a.glb"}), plan.groups[0].tasks = 100'000;
    wishes.mount = "/disk", plan.cpus = 4;
    const std::vector<FarmFile> files = row.write(plan, wishes);
    EXPECT_TRUE(files.size() <= 5 || row.member == Scheduler::kSlurm) << row.name;
    EXPECT_EQ(files.size() == 102, row.member == Scheduler::kSlurm) << row.name;
    for (const FarmFile& file : files) EXPECT_LT(file.text.size(), 20'000u) << row.name;
  }
}

}  // namespace
}  // namespace ods
