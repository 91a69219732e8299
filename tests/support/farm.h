// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods submit and ods jobs, with programs that replace Slurm's; tests/farm/slurm_test.sh uses the real ones.
#pragma once
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_runner.h"
#include "tests/support/programs.h"

using nlohmann::json;

class Farm : public Cli {
 protected:
  void SetUp() override {
    program("scontrol", "echo 'MaxArraySize = 6'; echo 'MaxJobCount = 100'");
    program("squeue", "[ \"$1\" != --json ] || exit 1\ncat " + tools.path("queue"));
    program("sbatch", "n=$(cat " + tools.path("n") + ")\necho $((n + 1)) >" + tools.path("n") + "\necho $n\n");
    program("sacct", "echo 'Slurm accounting storage is disabled' >&2; exit 1");
    tools.write("queue", "");
    tools.write("n", "7");
    setenv("PATH", (tools.path("") + ":" + own_path).c_str(), 1);
  }
  void TearDown() override { setenv("PATH", own_path.c_str(), 1); }

  void program(const std::string& name, const std::string& script) {
    tools.write(name, "#!/bin/sh\n" + script + "\n");
    ods::run_line("chmod +x " + tools.path(name));
  }

  // A small command whose output is in the folder.
  std::string video(const std::string& name = "a.mp4") const {
    return "video toys --width 32 --samples 4 --fps 10 -o " + folder.path(name);
  }

  json plan(const std::string& name) const { return json::parse(folder.read(name + ".farm/plan.json")); }

  // Runs a task of the plan.
  int run_task(const json& group, int number) {
    std::vector<std::string> words = group["command"];
    if (group.contains("option")) {
      words.push_back(group["option"]);
      words.push_back(fmt::format("{}/{}", number, group["tasks"].get<int>()));
    }
    Ods task(words);
    const int code = task.finish();
    EXPECT_EQ(code, 0) << task.err;
    return code;
  }

  void run_all(const json& plan) {
    for (const json& group : plan["groups"]) {
      for (int number = group.value("tasks", 1); number >= 1; number--) run_task(group, number);
    }
  }

  ods::TemporaryFolder tools;
  const std::string own_path = std::getenv("PATH");
};
