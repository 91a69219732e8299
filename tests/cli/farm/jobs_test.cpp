// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods jobs.
#include <sys/stat.h>

#include "tests/support/farm.h"

namespace ods::jobs_command_test {

using JobsCommand = Farm;

TEST_F(JobsCommand, JobsOfTenThousandTasks) {
  program("scontrol", "echo 'MaxArraySize = 20000'; echo 'MaxJobCount = 100000'");
  ASSERT_EQ(run("submit -q --to slurm --chunk 1 -- " + video() + " --frames 1-10000"), 0) << err;
  std::string queue;
  for (int task = 1; task <= 10000; task++) {
    const char* const state = task <= 6000   ? "COMPLETED"
                              : task <= 6040 ? "RUNNING"
                              : task == 6041 ? "TIMEOUT"
                                             : "PENDING";
    queue += fmt::format("7|{}|{}|0:{}|node{}|ods:frames:0:{}\n", task, state, task <= 6000 ? "10" : "04", task % 20,
                         folder.path("a.farm"));
  }
  tools.write("queue",
              queue + "8|N/A|PENDING|0:00||ods:video:0:" + folder.path("a.farm") + "\n99|1|RUNNING|0:01|one|(null)\n");
  ASSERT_EQ(run("jobs"), 0) << err;
  EXPECT_NE(out.find("frames      6000       40     3959       1         0       0/10000  16:36 min\n"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("video          0        0        1       0         0                \n"), std::string::npos)
      << out;
  EXPECT_NE(out.find("a frames 6041: TIMEOUT"), std::string::npos) << out;
  EXPECT_NE(out.find("a frames: on node0 (2), node1 (2), node10 (2), node11 (2), node12 (2), node13 (2), node14 (2), "
                     "node15 (2) and 12 more\n"),
            std::string::npos)
      << out;
  const std::string all = out;
  ASSERT_EQ(run("jobs a"), 0) << err;
  EXPECT_EQ(out, all);
}

TEST_F(JobsCommand, AFailedTaskIsShownWithItsLastLine) {
  ASSERT_EQ(run("submit -q --to slurm --chunk 4 -- " + video() + " --frames 1-12"), 0) << err;
  for (const char* name : {"ended", "logs"}) std::filesystem::create_directories(folder.path("a.farm/") + name);
  folder.write("a.farm/ended/frames.1", "0\n");
  folder.write("a.farm/ended/frames.2", "3\n");
  folder.write("a.farm/logs/frames.2.log", "frames 2 of 3, try 3\nods: error: cannot read 'x.glb': no such file\n");
  program("squeue", "exit 1");  // Slurm has forgotten it, and is down
  ASSERT_EQ(run("jobs " + folder.path("a.farm")), 0) << err;
  EXPECT_NE(out.find("frames         1        0        0       1         0          0/12  \n"), std::string::npos)
      << out;
  EXPECT_NE(out.find("a frames: 1 neither ended nor in the queue; submit it again\n"), std::string::npos) << out;
  EXPECT_NE(out.find("a frames 2: exit code 3: ods: error: cannot read 'x.glb': no such file\n"), std::string::npos)
      << out;
  EXPECT_EQ(run("jobs --follow " + folder.path("a.farm")), 1);
  EXPECT_NE(err.find("'a' has ended, but it is not complete"), std::string::npos) << err;
}

TEST_F(JobsCommand, JobsSaysRestartsNodesAndFramesInsideTasks) {
  ASSERT_EQ(run("submit -q --to slurm --chunk 4 -- " + video() + " --frames 1-12"), 0) << err;
  for (const char* name : {"ended", "starts", "logs"})
    std::filesystem::create_directories(folder.path("a.farm/") + name);
  folder.write("a.farm/starts/frames.1", "7 0 one\n7 2 one\n");
  for (const char* pipe : {"a.farm/starts/frames.3", "a.farm/ended/frames.3"}) {
    ASSERT_EQ(mkfifo(folder.path(pipe).c_str(), 0600), 0);  // of another user of the disk; reading it would block
  }
  folder.write("a.farm/starts/frames.2", "7 0 one\n7 0 two\n7 0 two\n");
  folder.write("a.farm/ended/frames.2", "3\n");
  for (const int frame : {1, 2, 3, 9, 77}) folder.write(fmt::format("a.mp4.frames/frame.{:06}.exr", frame), "");
  tools.write("queue", "7|1|RUNNING|0:05|one|ods:frames:0:" + folder.path("a.farm") +
                           "\n7|3|PENDING|0:00||ods:frames:0:" + folder.path("a.farm") + "\n");
  ASSERT_EQ(run("jobs a"), 0) << err;
  EXPECT_NE(out.find("frames         0        1        1       1         3          4/12  \n"), std::string::npos)
      << out;
  EXPECT_NE(out.find("a frames: on one (1)\n"), std::string::npos) << out;
  EXPECT_NE(out.find("a frames 2: on one, two, exit code 3\n"), std::string::npos) << out;
  ASSERT_EQ(run("jobs a --json"), 0) << err;
  const json job = json::parse(out)[0], frames = job["groups"][0];
  EXPECT_EQ(job["job"], "a");
  EXPECT_EQ(job["scheduler"], "slurm");
  EXPECT_EQ(frames, json::parse(R"({"name": "frames", "made": 4, "of": 12, "done": 0, "running": 1, "waiting": 1,
      "lost": 0, "restarts": 3, "nodes": {"one": 1}, "faults": [],
      "failed": [{"task": 2, "why": "exit code 3", "last_line": "", "nodes": "one, two"}]})"));
}

// A verdict is the result of a task that is done, also where Slurm's accounting calls it FAILED.
TEST_F(JobsCommand, AVerdictIsDoneAndSaysWhere) {
  folder.write("x.png", "");
  ASSERT_EQ(run("submit -q --to slurm -- lint " + folder.path("x.png") + " --layout top-bottom"), 0) << err;
  for (const char* name : {"ended", "logs"}) std::filesystem::create_directories(folder.path("x.farm/") + name);
  folder.write("x.farm/ended/lint.1", "5\n");
  tools.write("queue", "7|N/A|FAILED|0:05||ods:lint:0:" + folder.path("x.farm") + "\n");
  ASSERT_EQ(run("jobs " + folder.path("x.farm")), 0) << err;
  EXPECT_NE(out.find("lint           1        0        0       0         0                \n"), std::string::npos)
      << out;
  EXPECT_NE(out.find("x lint 1: found a fault, see " + folder.path("x.farm/logs/lint.1.log\n")), std::string::npos)
      << out;
  ASSERT_EQ(run("jobs --json " + folder.path("x.farm")), 0) << err;
  const json group = json::parse(out)[0]["groups"][0];
  EXPECT_EQ(group["done"], 1);
  EXPECT_EQ(group["faults"], json::parse("[1]"));
  EXPECT_EQ(group["failed"], json::array());
  EXPECT_EQ(run("jobs --follow " + folder.path("x.farm")), 5);
  EXPECT_EQ(err, "");
  folder.write("x.farm/ended/lint.1", "0\n");
  EXPECT_EQ(run("jobs --follow " + folder.path("x.farm")), 0);
}

TEST_F(JobsCommand, OfOtherSchedulersItSaysThatItCannotKnow) {
  ASSERT_EQ(run("submit -q --to flamenco --chunk 4 -- " + video() + " --frames 1-12"), 0) << err;
  folder.write("a.mp4.frames/frame.000005.exr", "");
  ASSERT_EQ(run("jobs " + folder.path("a.farm")), 0) << err;
  EXPECT_NE(out.find("frames         ?        ?        ?       ?         ?          1/12  \n"), std::string::npos)
      << out;
  EXPECT_NE(out.find("a: the state of its tasks is available only from flamenco"), std::string::npos) << out;
  ASSERT_EQ(run("jobs --json " + folder.path("a.farm")), 0) << err;
  EXPECT_EQ(json::parse(out)[0]["groups"],
            json::parse(R"([{"name": "frames", "made": 1, "of": 12}, {"name": "video"}])"));
  EXPECT_EQ(run("jobs --follow " + folder.path("a.farm")), 2);
  EXPECT_NE(err.find("was written for flamenco"), std::string::npos) << err;
}

TEST_F(JobsCommand, NoJobsIsNoError) {
  ASSERT_EQ(run("jobs"), 0) << err;
  EXPECT_EQ(out, "no jobs\n");
  ASSERT_EQ(run("jobs --json"), 0) << err;
  EXPECT_EQ(out, "[]\n");
}

}  // namespace ods::jobs_command_test
