// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that are dropped onto the studio's page.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "ods/image/image_file.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/studio_server.h"

using namespace std::chrono_literals;

namespace ods::studio_files_test {

class StudioDrops : public StudioServer {};

// A triangle; image: the address of a texture, empty: none.
static std::string triangle(const std::string& image = "") {
  ods::GltfBuilder file = ods::make_triangle();
  if (!image.empty()) {
    file.add(std::vector<float>{0, 0, 1, 0, 0, 1}, ods::kFloat, "VEC2");
    file.primitive()["attributes"]["TEXCOORD_0"] = 1;
    file.primitive()["material"] = 0;
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["images"] = {{{"uri", image}}};
  }
  const ods::Binary bytes = file.glb();
  return {bytes.begin(), bytes.end()};
}

// The camera that suits a scene, in numbers that people read: to a millimetre, a hundredth of a degree or of a stop.
constexpr const char* kShortNumbers =
    R"(position -?\d+(\.\d{1,3})?,-?\d+(\.\d{1,3})?,-?\d+(\.\d{1,3})? --yaw -?\d+(\.\d\d?)? .*--exposure -?\d+(\.\d\d?)? )";

TEST_F(StudioDrops, TakesFileAfterFileThatIsDropped) {
  for (const char* name : {"first.glb", "second.glb"}) {
    const std::string answer = drop(name, triangle());
    ASSERT_EQ(status_of(answer), 200) << answer;
    EXPECT_EQ(shown()["scene"], name);
    const Json set = asked("set", Json::parse(body_of(answer))["settings"]);
    EXPECT_TRUE(std::regex_search(set["command"].get<std::string>(),
                                  std::regex(std::string("^ods render ") + name + " --" + kShortNumbers)))
        << set;
    frame_of(set["revision"], "base", 160);
  }
  ASSERT_EQ(run("render furnace -q --width 16 --samples 1 -o sky.exr"), 0) << err;
  ASSERT_EQ(run("render furnace -q --width 16 --samples 1 -o sky.hdr"), 0) << err;
  for (const char* light : {"sky.exr", "sky.hdr", "sky.hdr"}) {
    const std::string answer = drop(light, folder.read(light));
    ASSERT_EQ(status_of(answer), 200) << answer;
    Json settings = Json::parse(body_of(answer))["settings"];
    EXPECT_EQ(settings["env"], light);
    settings["env"] = "studio";
    asked("set", settings);
    settings["env"] = light;
    const Json set = asked("set", settings);
    EXPECT_NE(set["command"].get<std::string>().find("--env " + std::string(light)), std::string::npos) << set;
    frame_of(set["revision"], "base", 160);
  }
  // The command is exact: what it reads is in the user's folder after Save camera, and it says so before.
  folder.write("second.glb", "another scene of this name");
  Json settings = Json::parse(body_of(drop("sky.hdr", folder.read("sky.hdr"))))["settings"];
  settings["width"] = 64;
  EXPECT_EQ(asked("set", settings)["note"],
            "This command reads second.glb and sky.hdr: Save camera writes what it reads");
  EXPECT_EQ(status_of(post("studio/save", "{}")), 200);
  const Json set = asked("set", settings);
  EXPECT_EQ(set["note"], "");
  EXPECT_EQ(folder.read("second.glb"), "another scene of this name");
  EXPECT_EQ(folder.read("second-2.glb"), triangle());
  EXPECT_FALSE(std::filesystem::exists("sky-2.hdr")) << "it was there already";
  EXPECT_EQ(run(set["command"].get<std::string>().substr(4) + " -q --quality preview"), 0) << set << err;
  for (const char* bad : {"bad.glb", "bad.zip", "bad.hdr", "bad.exr", "house.blend"}) {
    EXPECT_EQ(status_of(drop(bad, "glTF, or so it says")), 400) << bad;
    EXPECT_EQ(shown()["scene"], "second.glb");
    EXPECT_EQ(shown()["settings"]["env"], "sky.hdr");
    frame_of(asked("set", shown()["settings"])["revision"], "base", 160);
  }
}

TEST_F(StudioDrops, KeepsWhatIsDroppedToItself) {
  namespace fs = std::filesystem;
  const std::string drops = fs::directory_iterator(folder.path("tmp"))->path().filename().native();
  const ods::Binary png = ods::small_png();
  folder.write("tmp/private.png", {png.begin(), png.end()});
  fs::create_directory(folder.path("tmp/else"));
  for (const std::string& image :
       {std::string("../private.png"), folder.path("tmp/private.png"), "file://" + folder.path("tmp/private.png"),
        std::string("%2e%2e/private.png"), std::string("../absent.png"), std::string("else/../../private.png")}) {
    const std::string answer = drop("scene.glb", triangle(image));
    EXPECT_EQ(status_of(answer), 400) << image;
    EXPECT_EQ(std::regex_replace(answer, std::regex(image), "").find(folder.path("")), std::string::npos) << answer;
    EXPECT_EQ(answer.find(drops), std::string::npos) << answer;
  }
  fs::remove_all(folder.path("tmp/else"));
  fs::remove(folder.path("tmp/private.png"));
  ASSERT_EQ(status_of(drop("scene.glb", triangle())), 200);
  const auto entry = *fs::directory_iterator(folder.path("tmp"));
  EXPECT_EQ(fs::status(entry).permissions(), fs::perms::owner_all);
  EXPECT_EQ(std::distance(fs::directory_iterator(entry), {}), 1) << "what was refused stays";
  EXPECT_EQ(fs::status(*fs::directory_iterator(entry)).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(body_of(get("view.json")).find(drops), std::string::npos);
}

// Half of an upload is on the disk before the other half has been sent, so memory need not hold it.
TEST_F(StudioDrops, PutsWhatIsDroppedOnTheDisk) {
  namespace fs = std::filesystem;
  const std::string half(size_t{8} << 20, 'x');
  const Connection connection(port);
  connection.send_text(head(fmt::format("/{}/studio/drop?name=large.glb", secret), "POST",
                            fmt::format("Content-Length: {}\r\n", 2 * half.size())) +
                       half);
  const auto written = [&] {
    uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("tmp"))) {
      if (entry.is_regular_file()) bytes += entry.file_size();
    }
    return bytes;
  };
  for (int i = 0; i < 600 && written() < half.size(); i++) std::this_thread::sleep_for(100ms);
  EXPECT_EQ(written(), half.size());
  connection.send_text(half);
  EXPECT_EQ(status_of(connection.read_all()), 400);
}

}  // namespace ods::studio_files_test
