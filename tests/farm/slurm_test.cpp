// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <set>

#include "tests/support/schedulers.h"

namespace ods {
namespace {

TEST_F(Schedulers, SlurmRunsEveryTaskOnce) {
  choices.largest_array = 6;
  choices.extras = {"--partition=render", "--time=2:00:00"};
  plan.cpus = 4;
  const std::vector<FarmFile> files = write(Scheduler::kSlurm);
  ASSERT_EQ(files.size(), 5u);  // 12 tasks in arrays of five
  std::set<std::string> calls;
  for (int array = 1; array <= 3; array++) {
    const std::string name = fmt::format("frames-{}.sbatch", array), text = text_of(files, name);
    EXPECT_NE(text.find("#SBATCH --partition=render\n#SBATCH --time=2:00:00\n"), std::string::npos);
    EXPECT_NE(text.find("#SBATCH --cpus-per-task=4\n"), std::string::npos);
    EXPECT_NE(text.find(fmt::format("#SBATCH --array=1-{}\n", array == 3 ? 2 : 5)), std::string::npos) << text;
    for (int index = 1; index <= (array == 3 ? 2 : 5); index++) {
      const std::string line =
          fmt::format("SLURM_JOB_ID=9 SLURM_CPUS_PER_TASK=4 SLURM_ARRAY_TASK_ID={} sh {}", index, in_folder(name));
      EXPECT_EQ(run_line(line).code, 0);
      EXPECT_EQ(said(), expected(0, 5 * (array - 1) + index, {"--threads", "4"}));
      calls.insert(said());
    }
  }
  EXPECT_EQ(calls.size(), 12u);
  EXPECT_EQ(run_line("SLURM_JOB_ID=9 SLURM_CPUS_ON_NODE=2 sh " + in_folder("video-1.sbatch")).code, 0);
  EXPECT_EQ(said(), expected(1, 1, {"--threads", "2"}));
  EXPECT_EQ(folder.read("film's.farm/ended/frames.12"), "0\n");
}

// A cluster of three nodes that starts a task again as long as it is put back into the queue, on the first node that it
// does not exclude.
class SlurmStarts : public Schedulers {
 protected:
  void SetUp() override {
    Schedulers::SetUp();
    set_names({"scene.glb"});
    program("scontrol", "echo \"$@\" >>\"$0.log\"\n");
    program("sinfo",
            "case \"$*\" in *'%N %m %c'*) printf 'one 8000 4\ntwo 8000 4\nsmall 2 4\n' ;; *) printf '8000\n8000\n2\n' "
            ";; esac\n");
  }

  void program(const std::string& name, const std::string& script) {
    folder.write(name, "#!/bin/sh\n" + script);
    run_line("chmod +x " + folder.path(name));
  }

  // The nodes of the task's starts, and the exit code of the last.
  std::string run(const std::string& script, const std::string& environment = "") {
    for (const char* name : {"starts", "ended", "logs"}) std::filesystem::remove_all(plan.folder + "/" + name);
    std::string starts, excluded;
    for (int start = 0; start < 9; start++) {
      const std::string node = excluded.find("one") == std::string::npos ? "one" : "two";
      folder.write("scontrol.log", "");
      const Ran ran =
          run_line(fmt::format("PATH={}:$PATH; export SLURM_JOB_ID=9 SLURM_JOB_PARTITION=all SLURM_ARRAY_TASK_ID=2 "
                               "SLURMD_NODENAME={} {}; sh {}",
                               folder.path(""), node, environment, in_folder(script)));
      starts += node + " ";
      said_to_slurm = folder.read("scontrol.log");
      if (said_to_slurm.find("requeue 9") == std::string::npos) return starts + fmt::format("{}", ran.code);
      if (const size_t at = said_to_slurm.find("ExcNodeList="); at != std::string::npos) {
        excluded = said_to_slurm.substr(at, said_to_slurm.find('\n', at) - at);
      }
    }
    return starts + "for ever";
  }

  std::string log() const { return folder.read("film's.farm/logs/frames.2.log"); }

  std::string said_to_slurm;
};

TEST_F(SlurmStarts, WhatMayGetBetterIsTriedElsewhere) {
  write(Scheduler::kSlurm);
  for (const auto& [code, starts] : std::map<int, std::string>{{0, "one 0"},
                                                               {1, "one two two 1"},
                                                               {2, "one 2"},
                                                               {3, "one two two 3"},
                                                               {4, "one two two 4"},
                                                               {5, "one 5"},
                                                               {139, "one two two 139"}}) {
    program("ods", fmt::format("exit {}\n", code));
    EXPECT_EQ(run("frames-1.sbatch"), starts);
    EXPECT_EQ(folder.read("film's.farm/ended/frames.2"), fmt::format("{}\n", code));
  }
  choices.extras = {"--time=1:00:00", "-C", "fast"};  // who names nodes has them
  write(Scheduler::kSlurm);
  EXPECT_EQ(run("frames-1.sbatch"), "one one one 139");
  program("scontrol", "exit 1\n");
  EXPECT_EQ(run("frames-1.sbatch"), "one 139") << "where nothing may be put back";
}

// The time limit, as Slurm announces it: a signal to the script.
TEST_F(SlurmStarts, ATaskThatIsLateGoesOnWhileItMakesFiles) {
  const std::string late = "kill -USR1 $PPID\nsleep 60 &\ntrap 'kill $!; exit 143' TERM\nwait\n";
  write(Scheduler::kSlurm);
  program("ods", late);
  EXPECT_EQ(run("frames-1.sbatch"), "one two two 143");
  EXPECT_NE(log().find("time limit was over three times before a file was made"), std::string::npos) << log();
  const std::string made = "\"" + plan.folder + "/logs/frames.2.files\"";
  program("ods", "echo x.exr\n[ $(wc -l <" + made + ") -lt 5 ] || exit 0\n" + late);
  EXPECT_EQ(run("frames-1.sbatch"), "one one one one one 0");
  EXPECT_EQ(folder.read("film's.farm/logs/frames.2.files"), "x.exr\nx.exr\nx.exr\nx.exr\nx.exr\n");
}

TEST_F(SlurmStarts, APartGoesOnWhileItGrows) {
  const std::string parts = folder.path("p.parts/part_####.exr"),
                    growing = folder.path("p.parts/part_0002.exr.unfinished");
  std::filesystem::create_directory(folder.path("p.parts"));
  plan.groups = {{"parts", {"render", "room", "-o", parts}, "--part", 3}};
  write(Scheduler::kSlurm);
  const std::string late = "kill -USR1 $PPID\nsleep 60 &\ntrap 'kill $!; exit 143' TERM\nwait\n";
  program("ods", "echo more >>" + growing + "\n[ $(wc -l <" + growing + ") -lt 6 ] || exit 0\n" + late);
  EXPECT_EQ(run("parts-1.sbatch"), "one one one one one one 0");
}

// A script that is killed with its node does not report anything; its starts count all the same.
TEST_F(SlurmStarts, ATaskThatTakesItsNodesDownEnds) {
  write(Scheduler::kSlurm);
  program("ods", "kill -9 $PPID\n");
  const auto start = [&](int job) {
    return run_line(
               fmt::format("PATH={}:$PATH; export SLURM_JOB_ID={} SLURM_ARRAY_TASK_ID=2 SLURMD_NODENAME=one; sh {}",
                           folder.path(""), job, in_folder("frames-1.sbatch")))
        .code;
  };
  for (int i = 0; i < 3; i++) EXPECT_EQ(start(9), 137);
  EXPECT_EQ(start(9), 1);
  EXPECT_NE(log().find("three starts have ended without a file or a message, on one one one"), std::string::npos);
  EXPECT_EQ(folder.read("film's.farm/ended/frames.2"), "1\n");
  program("ods", "");
  EXPECT_EQ(start(10), 0) << "another job has starts of its own";
}

TEST_F(SlurmStarts, AfterAKillItGetsMoreMemory) {
  write(Scheduler::kSlurm);
  program("ods", "exit 137\n");
  run("frames-1.sbatch", "SLURM_MEM_PER_NODE=3000");
  EXPECT_EQ(said_to_slurm, "") << "of the last start";
  for (const auto& [memory, more] : std::map<int, std::string>{{3000, "6000"}, {5000, "8000"}, {8000, ""}}) {
    std::filesystem::remove_all(plan.folder + "/starts");
    folder.write("scontrol.log", "");
    run_line(
        fmt::format("PATH={}:$PATH; export SLURM_JOB_ID=9 SLURM_JOB_PARTITION=all SLURM_ARRAY_TASK_ID=2 "
                    "SLURMD_NODENAME=one SLURM_MEM_PER_NODE={}; sh {}",
                    folder.path(""), memory, in_folder("frames-1.sbatch")));
    const std::string words = folder.read("scontrol.log");
    EXPECT_EQ(words.find("MinMemoryNode=") != std::string::npos, !more.empty()) << words;
    EXPECT_NE(words.find(more.empty() ? "requeue" : "MinMemoryNode=" + more + "\n"), std::string::npos) << words;
    EXPECT_NE(words.find("ExcNodeList=one\n"), std::string::npos) << words;
  }
}

TEST_F(Schedulers, SlurmSendsGroupsInOrderAndCancelsWhatIsAlone) {
  choices.largest_array = 9;
  write(Scheduler::kSlurm);
  folder.write("sbatch", "#!/bin/sh\nn=$(cat " + folder.path("n") + ")\n[ $n != \"$FAIL\" ] || exit 1\nn=$((n + 1))\n" +
                             "echo $n >" + folder.path("n") + "\nprintf '%s\\n' \"$@\" >>" + folder.path("log") +
                             "\necho \"$n;farm\"\n");
  folder.write("scancel", "#!/bin/sh\necho \"$@\" >" + folder.path("cancelled") + "\n");
  const std::string line =
      fmt::format("chmod +x {0}/sbatch {0}/scancel; PATH={0}:$PATH sh {1}", folder.path(""), in_folder("submit.sh"));
  folder.write("n", "70");
  const Ran all = run_line(line);
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(all.out,
            "71 frames-1.sbatch ods:frames:0\n72 frames-2.sbatch ods:frames:8\n73 video-1.sbatch ods:video:0\n");
  const std::string log = folder.read("log");
  EXPECT_NE(log.find("--comment=ods:frames:8:" + plan.folder + "\n"), std::string::npos) << log;
  EXPECT_NE(log.find("--dependency=afterok:71:72\n"), std::string::npos) << log;
  folder.write("n", "70");
  EXPECT_NE(run_line("export FAIL=72; " + line).code, 0);
  EXPECT_EQ(folder.read("cancelled"), "71 72\n");
}

}  // namespace
}  // namespace ods
