// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/farm/plan.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"

namespace ods {
namespace {

FarmPlan example() {
  FarmPlan plan;
  plan.name = "film";
  plan.folder = "/disk/film.farm";
  plan.program = "ods";
  plan.cpus = 4;
  plan.memory = 3'000'000'000;
  plan.scheduler = "slurm";
  plan.paths = {{"/disk/a scene.glb"}, {"/disk/film.mp4", true}, {"/disk/views", false, true}};
  plan.groups = {{"frames",
                  {"video", "/disk/a scene.glb", "-o", "/disk/film.mp4"},
                  "--only",
                  7,
                  size_t{1} << 30,
                  "/disk/film.mp4.frames/frame.######.exr",
                  "1-70"},
                 {"video", {"video", "/disk/a scene.glb", "-o", "/disk/film.mp4"}, "", 1}};
  return plan;
}

TEST(Plan, ATaskIsACommandLine) {
  const FarmPlan plan = example();
  const std::vector<std::string> third = {"ods", "video", "/disk/a scene.glb", "-o", "/disk/film.mp4", "--only", "3/7"};
  EXPECT_EQ(task_arguments(plan, plan.groups[0], 3), third);
  EXPECT_EQ(task_arguments(plan, plan.groups[1], 1), std::vector<std::string>(third.begin(), third.end() - 2));
}

TEST(Plan, ComesBackFromItsFile) {
  const FarmPlan plan = example(), back = read_plan(write_plan(plan), "plan.json");
  EXPECT_EQ(write_plan(back), write_plan(plan));
  EXPECT_EQ(back.memory, plan.memory);
  ASSERT_EQ(back.groups.size(), 2u);
  EXPECT_EQ(back.groups[0].tasks, 7);
  EXPECT_EQ(back.groups[0].files, plan.groups[0].files);
  EXPECT_EQ(memory_of(back, back.groups[0]), size_t{1} << 30);
  EXPECT_EQ(memory_of(back, back.groups[1]), plan.memory);
  EXPECT_EQ(back.groups[0].numbers, "1-70");
  EXPECT_EQ(back.scheduler, "slurm");
  EXPECT_EQ(back.groups[1].option, "");
  EXPECT_TRUE(back.paths[1].is_output);
  EXPECT_TRUE(back.paths[2].is_folder);
}

TEST(Plan, OtherFilesAreErrorsThatNameThem) {
  for (const std::string text : {"", "{}", "[]", "{\"omnistereo_farm_plan\": 2}", "{\"omnistereo_farm_plan\": 1}",
                                 "{\"omnistereo_farm_plan\": 1, \"name\": 5}"}) {
    try {
      read_plan(text, "other.json");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find("'other.json'"), std::string::npos) << error.what();
    }
  }
}

TEST(Plan, NamesSuitEveryScheduler) {
  EXPECT_EQ(plan_name("scene_360_TB"), "scene_360_TB");
  EXPECT_EQ(plan_name("my film"), "my_film");
  EXPECT_EQ(plan_name("-x"), "job-x");
  EXPECT_EQ(plan_name(""), "job");
  EXPECT_EQ(plan_name(std::string(100, 'a')).size(), 64u);
  EXPECT_EQ(plan_name("ö\n'\""), "job_____");
}

TEST(Plan, WordsWithLineBreaksAreRefused) {
  for (const std::string word : {"a\nb", "\xff"}) {
    FarmPlan in_command = example(), in_path = example();
    in_command.groups[1].command.push_back(word);
    in_path.paths[0].path = "/disk/" + word;
    EXPECT_THROW(check_quotable(in_command), Error);
    EXPECT_THROW(check_quotable(in_path), Error);
  }
  EXPECT_NO_THROW(check_quotable(example()));
}

TEST(Plan, ATaskTakesTenMinutesAndNoMachineIsIdle) {
  for (const int halo : {0, 1}) {
    EXPECT_EQ(suitable_chunk(6.0, 100'000, halo), 100);
    EXPECT_EQ(suitable_chunk(6.0, 320, halo), 20);
    EXPECT_EQ(suitable_chunk(1e-6, 1'000'000, halo), 62'500);
  }
  EXPECT_EQ(suitable_chunk(3600.0, 100, 0), 1);
  EXPECT_EQ(suitable_chunk(0.001, 5, 0), 1);
}

// Each of two neighbouring tasks renders a frame of the other.
TEST(Plan, FramesBesideATasksOwnCostAtMostAQuarter) {
  EXPECT_DOUBLE_EQ(halo_cost(1, 10, 100), 0.18);
  EXPECT_DOUBLE_EQ(halo_cost(1, 100, 100), 1.98);
  EXPECT_DOUBLE_EQ(halo_cost(1, 1, 5), 0.0);
  EXPECT_DOUBLE_EQ(halo_cost(0, 100, 100), 0.0);
  for (const double seconds : {0.001, 6.0, 3600.0, 1e6}) {
    for (size_t frames = 1; frames < 500; frames++) {
      const int chunk = suitable_chunk(seconds, frames, 1);
      EXPECT_LE(halo_cost(1, tasks_for(frames, chunk), frames), kMaxHaloCost) << seconds << " " << frames;
    }
  }
}

TEST(Plan, FramesAreRenderedFirstWhereRenderingTwiceCostsMore) {
  const size_t gigabyte = 1'000'000'000;
  EXPECT_TRUE(raw_first_is_cheaper(600.0, 48, 1, gigabyte)) << "ten of 48 are rendered twice: 125 s a frame";
  EXPECT_FALSE(raw_first_is_cheaper(80.0, 48, 1, gigabyte)) << "17 s, and the disk takes 22";
  EXPECT_TRUE(raw_first_is_cheaper(80.0, 48, 1, gigabyte / 10));
  EXPECT_FALSE(raw_first_is_cheaper(60.0, 48, 1, gigabyte / 10)) << "a task of ten minutes has ten of them";
  EXPECT_FALSE(raw_first_is_cheaper(2.0, 10'000, 1, gigabyte / 100)) << "long tasks have few frames beside them";
  EXPECT_FALSE(raw_first_is_cheaper(600.0, 48, 0, 1)) << "nothing is rendered twice";
  EXPECT_EQ(min_chunk(1), 8);
  EXPECT_EQ(min_chunk(0), 1);
}

TEST(Plan, TasksHoldAllFrames) {
  EXPECT_EQ(tasks_for(100, 10), 10);
  EXPECT_EQ(tasks_for(101, 10), 11);
  EXPECT_EQ(tasks_for(1, 1000), 1);
  EXPECT_EQ(tasks_for(1'000'000, 1), 1'000'000);
}

}  // namespace
}  // namespace ods
