// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/placements.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods::placements_test {

TEST(Placements, AreBesideTheScene) {
  EXPECT_EQ(placements_path("a/room.layers.glb"), "a/room.objects.json");
  EXPECT_EQ(placements_path("room.glb"), "room.objects.json");
  EXPECT_EQ(placements_path("a.b/v1.2.layers.glb"), "a.b/v1.2.objects.json");
}

TEST(Placements, AreReadAsWritten) {
  const TemporaryFolder folder;
  const std::string layered = folder.path("room.layers.glb");
  EXPECT_TRUE(read_placements(layered).empty());
  folder.write("robot.glb", "x");
  const std::vector<Placement> placements = {{folder.path("robot.glb"), vec3(0.4f, 0.9f, -1.0f), 30.0f},
                                             {"toys", vec3(1, 2, 3), -0.5f}};
  EXPECT_EQ(write_placements(layered, placements), folder.path("room.objects.json"));
  EXPECT_NE(folder.read("room.objects.json").find("\"robot.glb\""), std::string::npos);  // without the folder
  const std::vector<Placement> again = read_placements(layered);
  ASSERT_EQ(again.size(), 2u);
  for (size_t i = 0; i < 2; i++) {
    EXPECT_EQ(again[i].file, placements[i].file);
    EXPECT_EQ(again[i].at, placements[i].at);
    EXPECT_EQ(again[i].turn, placements[i].turn);
  }
}

TEST(Placements, OfAnotherFolderHaveTheWholePath) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("scenes"));
  folder.write("robot.glb", "x");
  const std::string layered = folder.path("scenes/room.layers.glb");
  write_placements(layered, std::vector<Placement>{{folder.path("scenes/../robot.glb")}});
  EXPECT_EQ(read_placements(layered).at(0).file, std::filesystem::path(folder.path("robot.glb")).lexically_normal());
}

TEST(Placements, AreChecked) {
  const TemporaryFolder folder;
  for (const char* text :
       {"", "[]", "{}", R"({"objects": 7})", R"({"objects": [7]})", R"({"objects": [{}]})",
        R"({"objects": [{"file": "a", "at": [1, 2]}]})", R"({"objects": [{"file": "a"}]})",
        R"({"objects": [{"file": "", "at": [1, 2, 3]}]})", R"({"objects": [{"file": "a\nb", "at": [1, 2, 3]}]})",
        R"({"objects": [{"file": "a", "at": [1, 2, 1e9]}]})",
        R"({"objects": [{"file": "a", "at": [1, 2, 3], "turn": "left"}]})"}) {
    folder.write("room.objects.json", text);
    EXPECT_THROW(read_placements(folder.path("room.layers.glb")), Error) << text;
  }
}

TEST(Placements, AreMovedByAPage) {
  std::vector<Placement> placements = {{"a.glb"}, {"b.glb"}};
  move_placements(
      R"({"objects": [{"name": "a", "at": [1, 2, 3], "turn": 90}, {"name": "b", "at": [4, 5, 6], "turn": 0}]})",
      placements);
  EXPECT_EQ(placements[0].at, vec3(1, 2, 3));
  EXPECT_EQ(placements[0].turn, 90.0f);
  EXPECT_EQ(placements[0].file, "a.glb");
  EXPECT_EQ(placements[1].at, vec3(4, 5, 6));
  for (const char* text : {R"({"objects": [{"at": [0, 0, 0]}]})", R"({"objects": [{"at": [0, 0, 0]}, {"at": [1]}]})"}) {
    EXPECT_THROW(move_placements(text, placements), Error) << text;
    EXPECT_EQ(placements[0].at, vec3(1, 2, 3));
  }
}

}  // namespace ods::placements_test
