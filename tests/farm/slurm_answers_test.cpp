// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers as Slurm 22.05 and 23.11 give them.
#include "ods/farm/slurm_answers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace ods {
namespace {

std::string word(const SlurmTask& t) {
  return fmt::format("{} {} {} {} {} {} {:g}{}{}", t.job, t.folder, t.group, t.number,
                     name_in(kTaskStateTable, t.state), t.word, t.seconds, t.node.empty() ? "" : " on ", t.node);
}

std::vector<std::string> words(const std::vector<SlurmTask>& tasks) {
  std::vector<std::string> all;
  for (const SlurmTask& task : tasks) all.push_back(word(task));
  return all;
}

TEST(SlurmAnswers, LinesOfTheQueue) {
  const std::string text =
      "7|3|RUNNING|1:05|node7|ods:frames:0:/disk/film.farm\n"
      "7|4|PENDING|0:00||ods:frames:0:/disk/film.farm\n"
      "8|1|COMPLETING|1-02:03:04|node8|ods:frames:1000:/disk/film.farm\n"
      "9|N/A|COMPLETED|0:09|node8|ods:video:0:/disk/with | and : in it.farm\n"
      "10|2|NODE_FAIL|INVALID|node7|ods:parts:0:/x.farm\n"
      "11|2|A_STATE_OF_TOMORROW|0:01||ods:parts:0:/x.farm\n";
  const std::vector<std::string> expected = {"7 /disk/film.farm frames 3 running RUNNING 65 on node7",
                                             "7 /disk/film.farm frames 4 waiting PENDING 0",
                                             "8 /disk/film.farm frames 1001 running COMPLETING 93784 on node8",
                                             "9 /disk/with | and : in it.farm video 1 done COMPLETED 9",
                                             "10 /x.farm parts 2 failed NODE_FAIL 0",
                                             "11 /x.farm parts 2 failed A_STATE_OF_TOMORROW 1"};
  EXPECT_EQ(words(read_queue(text)), expected);
}

TEST(SlurmAnswers, OtherPeoplesJobsAndNonsenseAreLeftOut) {
  for (const std::string line : {"", "\n\n", "squeue: error", "1|2|RUNNING|0:01|node7|(null)",
                                 "1|2|RUNNING|0:01|node7|ods:", "1|2|RUNNING|0:01|node7|ods:frames:x:/a",
                                 "1|2||0:01|node7|ods:frames:0:/a", "||||", "1|2|RUNNING"}) {
    EXPECT_TRUE(read_queue(line).empty()) << line;
  }
  for (const std::string text : {"", "{}", "[]", "{\"jobs\": 5}", "slurm_load_jobs error"}) {
    EXPECT_FALSE(read_queue_json(text, 0.0)) << text;
  }
  for (const std::string job :
       {"5", "{}", R"({"comment": 5})", R"({"comment": "ods:frames:0:/a"})",
        R"({"comment": "ods:frames:0:/a", "job_state": {}})",
        R"({"comment": "ods:frames:0:/a", "job_state": "PENDING", "array_task_string": "x"})"}) {
    const auto tasks = read_queue_json("{\"jobs\": [" + job + "]}", 0.0);
    ASSERT_TRUE(tasks) << job;
    EXPECT_TRUE(tasks->empty()) << job;
  }
}

// The same queue, printed by both versions.
TEST(SlurmAnswers, JsonOldAndNew) {
  const std::string old = R"({"meta": {}, "jobs": [
    {"array_job_id": 7, "array_task_id": 3, "array_task_string": "", "comment": "ods:frames:0:/f.farm", "job_id": 9,
     "job_state": "RUNNING", "nodes": "node7", "start_time": 1000, "end_time": 32000000},
    {"array_job_id": 7, "array_task_id": null, "array_task_string": "4-5,9%8", "comment": "ods:frames:0:/f.farm",
     "job_id": 7, "job_state": "PENDING", "start_time": 0, "end_time": 0},
    {"array_job_id": 0, "array_task_id": null, "array_task_string": "", "comment": "ods:video:0:/f.farm", "job_id": 8,
     "job_state": "COMPLETED", "start_time": 900, "end_time": 950}]})";
  const auto number = [](const std::string& n) { return R"({"set": true, "infinite": false, "number": )" + n + "}"; };
  const std::string none = R"({"set": false, "infinite": false, "number": 0})";
  const std::string fresh = R"({"meta": {}, "jobs": [
    {"array_job_id": )" + number("7") +
                            R"(, "array_task_id": )" + number("3") +
                            R"(, "array_task_string": "", "comment": "ods:frames:0:/f.farm", "job_id": 9,
     "job_state": ["RUNNING"], "nodes": "node7", "start_time": )" +
                            number("1000") + R"(, "end_time": )" + number("32000000") + R"(},
    {"array_job_id": )" + number("7") +
                            R"(, "array_task_id": )" + none +
                            R"(, "array_task_string": "4-5,9%8", "comment": "ods:frames:0:/f.farm", "job_id": 7,
     "job_state": ["PENDING"], "start_time": )" +
                            none + R"(, "end_time": )" + none + R"(},
    {"array_job_id": )" + number("0") +
                            R"(, "array_task_id": )" + none +
                            R"(, "array_task_string": "", "comment": "ods:video:0:/f.farm", "job_id": 8,
     "job_state": ["COMPLETED"], "start_time": )" +
                            number("900") + R"(, "end_time": )" + number("950") + R"(}]})";
  const std::vector<std::string> expected = {
      "7 /f.farm frames 3 running RUNNING 60 on node7", "7 /f.farm frames 4 waiting PENDING 0",
      "7 /f.farm frames 5 waiting PENDING 0", "7 /f.farm frames 9 waiting PENDING 0",
      "8 /f.farm video 1 done COMPLETED 50"};
  for (const std::string& text : {old, fresh}) {
    const auto tasks = read_queue_json(text, 1060.0);
    ASSERT_TRUE(tasks);
    EXPECT_EQ(words(*tasks), expected);
  }
}

TEST(SlurmAnswers, AccountsOfWhatHasEnded) {
  const std::map<std::string, SlurmArray> arrays = {{"7", {"/f.farm", "frames", 1000}}, {"8", {"/f.farm", "video", 0}}};
  const std::string text =
      "7_3|COMPLETED|61\n7_4|CANCELLED by 1000|5\n7_[5-9]|PENDING|0\n8|TIMEOUT|3600\n99|COMPLETED|1\n\nnonsense\n";
  const std::vector<std::string> expected = {"7 /f.farm frames 1003 done COMPLETED 61",
                                             "7 /f.farm frames 1004 failed CANCELLED by 1000 5",
                                             "8 /f.farm video 1 failed TIMEOUT 3600"};
  EXPECT_EQ(words(read_account(text, arrays)), expected);
}

TEST(SlurmAnswers, SettingsOfTheCluster) {
  const std::string text =
      "Configuration data as of 2026\nMaxArraySize            = 1001\nMaxJobCount             = 10000\n";
  EXPECT_EQ(slurm_setting(text, "MaxArraySize"), 1001);
  EXPECT_EQ(slurm_setting(text, "MaxJobCount"), 10000);
  EXPECT_EQ(slurm_setting(text, "MaxArray"), std::nullopt);
  EXPECT_EQ(slurm_setting("MaxArraySize = (null)\n", "MaxArraySize"), std::nullopt);
  EXPECT_EQ(slurm_setting("", "MaxArraySize"), std::nullopt);
}

}  // namespace
}  // namespace ods
