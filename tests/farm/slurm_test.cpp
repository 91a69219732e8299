// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <set>

#include "tests/support/schedulers.h"

namespace ods {
namespace {

TEST_F(Schedulers, SlurmRunsEveryTaskOnce) {
  wishes.largest_array = 6;
  wishes.extras = {"--partition=render", "--time=2:00:00"};
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

// sleep is none, or this test would wait.
TEST_F(Schedulers, SlurmTriesAgainWhatMayGetBetter) {
  write(Scheduler::kSlurm);
  for (const auto& [code, tries] : std::map<int, int>{{0, 1}, {1, 3}, {2, 1}, {3, 3}, {4, 3}, {139, 3}}) {
    folder.write("ods", fmt::format("#!/bin/sh\necho x >>{}\nexit {}\n", folder.path("tries"), code));
    folder.write("tries", "");
    folder.write("sleep", "#!/bin/sh\n");
    const std::string line =
        fmt::format("chmod +x {0}/sleep; PATH={0}:$PATH SLURM_JOB_ID=9 SLURM_ARRAY_TASK_ID=2 sh {1}", folder.path(""),
                    in_folder("frames-1.sbatch"));
    EXPECT_EQ(run_line(line).code, code);
    EXPECT_EQ(folder.read("tries").size(), 2u * static_cast<size_t>(tries)) << code;
    EXPECT_EQ(folder.read("film's.farm/ended/frames.2"), fmt::format("{}\n", code));
  }
}

TEST_F(Schedulers, SlurmSendsGroupsInOrderAndCancelsWhatIsAlone) {
  wishes.largest_array = 9;
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
