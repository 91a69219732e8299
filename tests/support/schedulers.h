// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A plan whose arguments break incorrect quoting, written for a scheduler, and a program that replaces ods and reports
// its arguments.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods {

inline const std::vector<std::string> kNames = {"it's a \"scene\".glb", "$HOME `id` $(id).glb",
                                                "naïve 日本 & <b> #IFRAME.glb", "back\\slash;|*?.glb"};

class Schedulers : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("ods", "#!/bin/sh\nprintf '%s\\n' \"$@\" >\"" + folder.path("said") + "\"\n");
    run_line("chmod +x " + folder.path("ods"));
    set_names(kNames);
  }

  void set_names(const std::vector<std::string>& names) {
    plan = FarmPlan();
    plan.name = "film_1";
    plan.folder = folder.path("film's.farm");
    plan.program = folder.path("ods");
    plan.memory = 3 << 20;
    std::vector<std::string> words = {"video"};
    for (const std::string& name : names) words.push_back("/disk/" + name), plan.paths.push_back({words.back()});
    words.insert(words.end(), {"-o", "/disk/out put.mp4"});
    plan.paths.push_back({"/disk/out put.mp4", true});
    plan.groups = {{"frames", words, "--only", 12}, {"video", words, "", 1}};
    std::filesystem::create_directories(plan.folder);
  }

  std::vector<FarmFile> write(Scheduler scheduler) {
    choices.mount = "/disk";
    std::vector<FarmFile> files = row_in(kSchedulerTable, scheduler).write(plan, choices);
    for (const FarmFile& file : files) folder.write("film's.farm/" + file.name, file.text);
    return files;
  }

  std::string text_of(const std::vector<FarmFile>& files, const std::string& name) {
    for (const FarmFile& file : files) {
      if (file.name == name) return file.text;
    }
    ADD_FAILURE() << "there is no " << name;
    return "";
  }

  std::string in_folder(const std::string& name) const { return shell_word(plan.folder + "/" + name); }

  // The expected arguments of a task, one per line; more: the scheduler's own arguments, after the command.
  std::string expected(size_t group, int number, const std::vector<std::string>& more = {}) const {
    const TaskGroup& tasks = plan.groups[group];
    std::string lines;
    for (const std::string& word : tasks.command) lines += word + "\n";
    for (const std::string& word : more) lines += word + "\n";
    if (!tasks.option.empty()) lines += fmt::format("{}\n{}/{}\n", tasks.option, number, tasks.tasks);
    return lines;
  }

  std::string said() const { return folder.read("said"); }

  // The output of a Python script for a file of the folder.
  std::string by_python(const std::string& script, const std::string& file) const {
    folder.write("script.py", "import sys\ntext = open(sys.argv[1], encoding='utf-8').read()\n" + script);
    return run_line("PYTHONIOENCODING=utf-8 python3 " + folder.path("script.py") + " " + in_folder(file)).out;
  }

  TemporaryFolder folder;
  FarmPlan plan;
  SchedulerChoices choices;
};

}  // namespace ods
