// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/find_input.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/camera/file_names.h"
#include "ods/picture/face_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unknown_files.h"

namespace ods {
namespace {

class FindInput : public testing::Test {
 protected:
  void touch(const std::string& name) const {
    std::filesystem::create_directories(std::filesystem::path(folder.path(name)).parent_path());
    folder.write(name, "x");
  }
  // The other eye's file; empty if none is found.
  std::string other(const std::string& name) const {
    const std::optional<EyePair> pair = find_eye_beside(folder.path(name));
    if (!pair) return "";
    const std::string path = pair->left == folder.path(name) ? pair->right : pair->left;
    return path.substr(folder.path("").size());
  }
  void write_eye(const std::string& name, World world, int eye) const {
    std::filesystem::create_directories(std::filesystem::path(folder.path(name)).parent_path());
    const TwoEyes eyes = [&](int, const ProjectionSetting& setting, Extent size) {
      StereoCamera camera;
      camera.projection = setting;
      return seen_in(world, camera, eye, size, true);
    };
    write_unknown(folder.path(name), {std::nullopt, find_projection("lat-long")->setting}, eyes, {512, 256});
  }
  FoundInput find(const std::vector<std::string>& names, bool alone = false) const {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back(folder.path(name));
    return find_input(paths, alone);
  }
  std::string found(const std::vector<std::string>& names) const {
    return find(names).path.substr(folder.path("").size());
  }
  std::string error(const std::vector<std::string>& names) const {
    try {
      find(names);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
};

TEST_F(FindInput, TheOtherEyeByItsName) {
  const std::pair<std::string, std::string> pairs[] = {
      {"trip_L.jpg", "trip_R.jpg"},          {"a-left.png", "a-right.png"},    {"Left.png", "Right.png"},
      {"IMG LEFT 1.png", "IMG RIGHT 1.png"}, {"DSC0001L.jpg", "DSC0001R.jpg"}, {"L_0007.tif", "R_0007.tif"},
      {"left/a.png", "right/a.png"},         {"x/L/b_L.png", "x/R/b_R.png"},   {"s.left.exr", "s.right.exr"}};
  for (const auto& [left, right] : pairs) touch(left), touch(right);
  for (const auto& [left, right] : pairs) {
    EXPECT_EQ(other(left), right);
    EXPECT_EQ(other(right), left);
    EXPECT_EQ(find_eye_beside(folder.path(right))->left, folder.path(left));
  }
  for (const std::string name : {"leftover.png", "wall.png", "oil.png", "solo_L.png", "alone/left.png"}) {
    touch(name);
    EXPECT_EQ(other(name), "") << name;
  }
  EXPECT_EQ(other("missing_L.png"), "");
}

TEST_F(FindInput, FramesHaveAnOtherEyeToo) {
  touch("left/s.0001.png"), touch("right/s.0001.png");
  EXPECT_EQ(other("left/s.####.png"), "right/s.####.png");
}

TEST_F(FindInput, TwoEyesOfOneWorldBelongTogether) {
  write_eye("trip_L.jpg", World::kCave, kLeft), write_eye("trip_R.jpg", World::kCave, kRight);
  EXPECT_EQ(found({"trip_L.jpg"}), "trip_{L|R}.jpg");
  EXPECT_EQ(found({"trip_R.jpg"}), "trip_{L|R}.jpg");
  EXPECT_EQ(find({"trip_L.jpg"}).notes.size(), 1u);
  EXPECT_EQ(find({"trip_L.jpg"}, true).path, folder.path("trip_L.jpg"));
  write_eye("wall_L.jpg", World::kHall, kLeft), write_eye("wall_R.jpg", World::kField, kRight);
  EXPECT_EQ(found({"wall_L.jpg"}), "wall_L.jpg");
  EXPECT_EQ(find({"wall_L.jpg"}).notes.size(), 1u);
  folder.write("bad_L.jpg", "x"), folder.write("bad_R.jpg", "x");
  EXPECT_EQ(found({"bad_L.jpg"}), "bad_L.jpg");
}

TEST_F(FindInput, TwoFilesAreLeftAndRightUnlessTheirNamesTellTheOpposite) {
  touch("one.png"), touch("two.png"), touch("a_left.png"), touch("a_right.png");
  EXPECT_EQ(found({"two.png", "one.png"}), "{two|one}.png");
  EXPECT_EQ(found({"a_right.png", "a_left.png"}), "a_{left|right}.png");
  EXPECT_NE(error({"one.png", "two.png", "a_left.png"}), "");
  std::filesystem::create_directory(folder.path("d"));
  EXPECT_NE(error({"one.png", "d"}).find("folder"), std::string::npos);
  touch("{a}.png");
  EXPECT_NE(error({"{a}.png", "one.png"}).find("rename"), std::string::npos);
  touch("a_L.mp4"), touch("a_R.mp4");
  EXPECT_NE(error({"a_L.mp4", "a_R.mp4"}).find("hstack"), std::string::npos);
}

TEST_F(FindInput, Folders) {
  touch("p/left/a.jpg"), touch("p/right/b.jpg");
  EXPECT_EQ(found({"p"}), "p/{left/a|right/b}.jpg");
  EXPECT_EQ(found({"p/left", "p/right"}), "p/{left/a|right/b}.jpg");
  for (const std::string number : {"0001", "0002", "0010"})
    touch("q/L/f" + number + ".png"), touch("q/R/f" + number + ".png");
  EXPECT_EQ(found({"q"}), "q/{L|R}/f####.png");
  touch("q/R/other.png");
  EXPECT_NE(error({"q"}).find("name one of them"), std::string::npos);
  touch("plain/a.jpg");
  EXPECT_EQ(found({"plain"}), "plain");
}

TEST_F(FindInput, SixFaces) {
  for (const FaceWords& row : kFaceWordsTable) {
    const std::string set = fmt::format("set_{}_{}", row.words[0], row.words[2]);
    for (const std::string_view word : row.words) touch(set + "/sky_" + std::string(word) + ".png");
    if (!row.doubt.empty()) {
      EXPECT_NE(error({set}).find(row.doubt), std::string::npos) << row.words[0];
      continue;
    }
    EXPECT_TRUE(names_faces(found({set}))) << row.words[0];
    EXPECT_EQ(found({set + "/sky_" + std::string(row.words[3]) + ".png"}), found({set}));
    EXPECT_EQ(find({set + "/sky_" + std::string(row.words[3]) + ".png"}, true).path,
              folder.path(set + "/sky_" + std::string(row.words[3]) + ".png"));
  }
  EXPECT_EQ(found({"set_px_py"}), "set_px_py/sky_{px|nx|py|ny|pz|nz}.png");
  EXPECT_EQ(found({"set_0_2/sky_0.png"}), "set_0_2/sky_0.png") << "frames have such names, too";
}

TEST_F(FindInput, SixFacesOfEachEye) {
  for (const std::string eye : {"left", "right"}) {
    for (const std::string_view word : kFaceWordsTable[0].words) touch("s/" + eye + "_" + std::string(word) + ".png");
  }
  EXPECT_EQ(found({"s"}), "s/{left|right}_{px|nx|py|ny|pz|nz}.png");
}

}  // namespace
}  // namespace ods
