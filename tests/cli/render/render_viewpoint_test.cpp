// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The settings that ods finds for a file by itself: the viewer's place, the unit, the exposure, the merge at the poles.
#include <fstream>
#include <iterator>
#include <regex>

#include "tests/support/cli_runner.h"
#include "tests/support/gltf_builder.h"

namespace ods::stage_command_test {

// A file with a closed box of single walls that face inwards, `width` wide, or outwards: an object.
class RenderViewpoint : public Cli {
 protected:
  std::string box(const std::string& name, float x, float y, float z, bool inwards) const {
    ods::GltfBuilder file = ods::make_triangle();
    const float h[3] = {0.5f * x, 0.5f * y, 0.5f * z};
    std::vector<float> positions;
    std::vector<uint16_t> indices;
    for (int axis = 0; axis < 3; axis++) {
      for (const float side : {-1.0f, 1.0f}) {
        const auto first = static_cast<uint16_t>(positions.size() / 3);
        for (const auto& [u, v] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
          float p[3];
          p[axis] = side * h[axis];
          p[(axis + 1) % 3] = u * h[(axis + 1) % 3];
          p[(axis + 2) % 3] = v * h[(axis + 2) % 3];
          positions.insert(positions.end(), {p[0], p[1], p[2]});
        }
        const bool forwards = (side > 0.0f) != inwards;
        for (const int corner : {0, 1, 2, 0, 2, 3}) {
          indices.push_back(static_cast<uint16_t>(first + (forwards ? corner : (4 - corner) % 4)));
        }
      }
    }
    file.primitive()["attributes"] = {{"POSITION", file.add(positions, ods::kFloat, "VEC3")}};
    file.primitive()["indices"] = file.add(indices, ods::kUshort, "SCALAR");
    const ods::Binary bytes = file.glb();
    const std::string path = scenes.path(name);
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    return path;
  }

  std::string bytes(const std::string& name) const {
    std::ifstream file(folder.path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ods::TemporaryFolder scenes;
};

// The number after this text.
std::string number_after(const std::string& text, const std::string& words) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(words + "([-+0-9.]+)")) ? found[1].str() : "none";
}

const std::string kTiny = " --width 32 --samples 1 -o ";

TEST_F(RenderViewpoint, ARoomInCentimetresIsRecognisedAndSaid) {
  const std::string room = box("room.glb", 600, 260, 500, true);
  ASSERT_EQ(run("render " + room + kTiny + folder.path("a.png")), 0) << err;
  EXPECT_NE(err.find("taken for centimetres (--unit cm; --unit m keeps its size)"), std::string::npos) << err;
  EXPECT_NE(err.find("1.6 m above the floor of the room"), std::string::npos) << err;
  const std::string guessed = bytes("a.png");
  ASSERT_EQ(run("render " + room + " --unit cm" + kTiny + folder.path("a.png")), 0) << err;
  EXPECT_EQ(err.find("taken for"), std::string::npos) << "a unit that is given is not worth a line";
  EXPECT_TRUE(bytes("a.png") == guessed);
  ASSERT_EQ(run("info " + room), 0) << err;
  EXPECT_NE(out.find("a closed room"), std::string::npos) << out;
  EXPECT_NE(out.find("size           6 x 2.6 x 5 m"), std::string::npos) << out;
  ASSERT_EQ(run("info " + room + " --unit m"), 0) << err;
  EXPECT_NE(out.find("size           600 x 260 x 500 m"), std::string::npos) << out;
  ASSERT_EQ(run("info --json " + room), 0) << err;
  const ods::GltfJson json = ods::GltfJson::parse(out);
  EXPECT_EQ(json["kind"], "a closed room");
  EXPECT_NEAR(json["metres_per_unit"].get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(json["viewer"]["position"][1].get<double>(), 0.3, 0.01) << "1.6 m above the floor at -1.3";
}

TEST_F(RenderViewpoint, UnitsHaveNamesOrAreNumbers) {
  const std::string object = box("box.glb", 1, 1, 1, false);
  for (const auto& [unit, size] : {std::pair{"in", "0.0254"}, {"ft", "0.3048"}, {"km", "1000"}, {"2.5", "2.5"}}) {
    ASSERT_EQ(run("info " + object + " --unit " + unit), 0) << err;
    EXPECT_NE(out.find(std::string("size           ") + size + " x"), std::string::npos) << out;
  }
  for (const std::string unit : {"yard", "0", "-1", "nan", "1e7", "1,2"}) {
    EXPECT_EQ(run("info " + object + " --unit " + unit), 2) << unit;
    EXPECT_NE(err.find("--unit is auto, m, cm, mm, in, ft, km"), std::string::npos) << err;
  }
}

TEST_F(RenderViewpoint, AnObjectIsShownAsAModelUnlessPlacesAreGiven) {
  const std::string tower = box("tower.glb", 10, 50, 10, false);
  ASSERT_EQ(run("info " + tower), 0) << err;
  EXPECT_NE(out.find("an object"), std::string::npos) << out;
  EXPECT_NE(out.find("shown as a model"), std::string::npos) << out;
  ASSERT_EQ(run("info " + tower + " --position 0,1.6,40"), 0) << err;
  EXPECT_NE(out.find("size           10 x 50 x 10 m"), std::string::npos) << out;
}

TEST_F(RenderViewpoint, ACameraWithNothingToSeeIsSaidBeforeAnHourOfRendering) {
  const std::string room = box("room.glb", 6, 2.6f, 5, true);
  const std::string render = "render " + room + kTiny + folder.path("a.png") + " --position ";
  ASSERT_EQ(run(render + "0,1.27,0"), 0) << err;
  EXPECT_NE(err.find("the camera is 3 cm from the nearest surface"), std::string::npos) << err;
  EXPECT_NE(err.find("without --position it would be at"), std::string::npos) << err;
  ASSERT_EQ(run(render + "0,0,0"), 0) << err;
  EXPECT_EQ(err.find("the camera is"), std::string::npos) << err;
  const std::string solid = box("solid.glb", 4, 4, 4, false);
  ASSERT_EQ(run("render " + solid + kTiny + folder.path("a.png") + " --position 0,0,0"), 0) << err;
  EXPECT_NE(err.find("the camera is inside a solid model"), std::string::npos) << err;
  ASSERT_EQ(run("render " + solid + kTiny + folder.path("a.png") + " --env 0"), 0) << err;
  EXPECT_NE(err.find("the picture is black: no light reaches the camera"), std::string::npos) << err;
}

TEST_F(RenderViewpoint, TheExposureIsSaidAndCanBeRepeated) {
  const std::string render = "render axis --env 40" + kTiny;
  ASSERT_EQ(run(render + folder.path("auto.png")), 0) << err;
  const std::string stops = number_after(err, "--exposure ");
  ASSERT_NE(stops, "none") << err;
  EXPECT_LT(std::stof(stops), -0.5f) << err;
  ASSERT_EQ(run(render + folder.path("repeated.png") + " --exposure " + stops), 0) << err;
  EXPECT_TRUE(bytes("auto.png") == bytes("repeated.png"));
  ASSERT_EQ(run(render + folder.path("zero.png") + " --exposure 0"), 0) << err;
  EXPECT_FALSE(bytes("auto.png") == bytes("zero.png"));
  ASSERT_EQ(run(render + folder.path("light.exr")), 0) << err;
  EXPECT_EQ(err.find("exposure"), std::string::npos) << "an .exr keeps the light";
  ASSERT_EQ(run("render axis" + kTiny + folder.path("own.png")), 0) << err;
  EXPECT_EQ(err.find("exposure"), std::string::npos) << "the built-in scenes are made for exposure 0";
  for (const std::string word : {"bright", "1,2", "31", "nan", "inf"})
    EXPECT_EQ(run(render + "a.png --exposure " + word), 2);
}

TEST_F(RenderViewpoint, BrighterIsAStopMoreThanWhatIsChosenOrGiven) {
  const std::string render = "render axis --env 40 --denoise none" + kTiny;
  ASSERT_EQ(run(render + folder.path("auto.png")), 0) << err;
  const std::string chosen = number_after(err, "--exposure ");
  ASSERT_NE(chosen, "none") << err;
  ASSERT_EQ(run(render + folder.path("brighter.png") + " --brighter 1.5"), 0) << err;
  EXPECT_NE(err.find("from a first look at the light and --brighter 1.5 ("), std::string::npos) << err;
  EXPECT_NE(err.find("(--exposure " + chosen + " --brighter 1.5)"), std::string::npos) << err;
  const std::string stops = number_after(err, "exposure ");
  EXPECT_NEAR(std::stof(stops), std::stof(chosen) + 1.5f, 1e-3f);
  for (const std::string& same : {"--exposure " + stops, "--brighter 1.5 --exposure " + chosen}) {
    ASSERT_EQ(run(render + folder.path("same.png") + " " + same), 0) << err;
    EXPECT_TRUE(bytes("brighter.png") == bytes("same.png")) << same;
  }
  EXPECT_FALSE(bytes("auto.png") == bytes("brighter.png"));
  const std::string own = "render axis --denoise none" + kTiny;
  ASSERT_EQ(run(own + folder.path("own.png") + " --brighter -1"), 0) << err;
  ASSERT_EQ(run(own + folder.path("given.png") + " --exposure -1"), 0) << err;
  EXPECT_TRUE(bytes("own.png") == bytes("given.png")) << "a built-in scene is made for exposure 0";
  ASSERT_EQ(run(own + folder.path("light.exr") + " --brighter 1"), 0) << err;
  EXPECT_NE(err.find("--brighter does not change .exr and .hdr"), std::string::npos) << err;
  EXPECT_EQ(run(own + folder.path("a.png") + " --brighter 31"), 2);
}

TEST_F(RenderViewpoint, FramesAndPartsShareTheExposure) {
  const std::string room = box("room.glb", 6, 2.6f, 5, false);
  const std::string video = "render " + room + kTiny + folder.path("shot.#.png") + " --turntable 1 --frames ";
  ASSERT_EQ(run(video + "0-8"), 0) << err;
  const std::string stops = number_after(err, "--exposure ");
  const size_t first = err.find("stops, from a first look");
  EXPECT_NE(first, std::string::npos) << err;
  EXPECT_EQ(err.find("stops, from a first look", first + 1), std::string::npos) << err;
  std::filesystem::remove(folder.path("shot.4.png"));
  ASSERT_EQ(run(video + "0-8 --skip-existing"), 0) << err;
  EXPECT_EQ(number_after(err, "--exposure "), stops) << "frames that are resumed get the same";
  const std::string part = "render " + room + " --width 32 --samples 2 -o ";
  for (const std::string i : {"1", "2"}) {
    ASSERT_EQ(run(part + folder.path("part_" + i + ".exr") + " --part " + i + "/2"), 0) << err;
  }
  ASSERT_EQ(run("merge " + folder.path("part_#.exr") + " --denoise none -o " + folder.path("parts.png")), 0) << err;
  ASSERT_EQ(run(part + folder.path("whole.png") + " --noise none --denoise none"), 0) << err;
  EXPECT_TRUE(bytes("parts.png") == bytes("whole.png"));
}

TEST_F(RenderViewpoint, ViewsOfARigHaveTheExposureThatIsGiven) {
  ASSERT_EQ(run("rig --width 16 --slits 6 --pitches 3 -q -o " + scenes.path("rig.json")), 0) << err;
  const std::string views = "render axis -q --samples 1 --rig " + scenes.path("rig.json") + " -o ";
  std::vector<std::string> firsts;
  for (const std::string exposure : {"", " --exposure 0", " --exposure 3"}) {
    ASSERT_EQ(run(views + folder.path("v_####.png") + exposure), 0) << err;
    firsts.push_back(bytes(folder.names().back()));
  }
  EXPECT_TRUE(firsts[0] == firsts[1]);
  EXPECT_FALSE(firsts[0] == firsts[2]);
}

TEST_F(RenderViewpoint, AnObjectTurnsOnTheSpot) {
  const std::string object = box("box.glb", 1, 1, 0.2f, false);
  const std::string video =
      "render " + object + kTiny + folder.path("shot.#.png") + " --frames 0-2 --fps 8 --duration 1 ";
  ASSERT_EQ(run(video + "--turntable 1"), 0) << err;
  EXPECT_NE(err.find("the object turns on the spot"), std::string::npos) << err;
  EXPECT_FALSE(bytes("shot.0.png") == bytes("shot.2.png"));
  ASSERT_EQ(run(video + "--turntable 1,0,0,0"), 0) << err;
  EXPECT_EQ(err.find("the object turns"), std::string::npos) << err;
  const std::string room = box("room.glb", 6, 2.6f, 5, true);
  ASSERT_EQ(run("render " + room + kTiny + folder.path("room.#.png") + " --frames 0 --turntable 1"), 0) << err;
  EXPECT_EQ(err.find("the object turns"), std::string::npos) << "in a room the viewer turns";
  ASSERT_EQ(run("render " + object + kTiny + folder.path("all.###.png") + " --turntable 1 --duration 0.1"), 0) << err;
  EXPECT_GT(bytes("all.002.png").size(), 100u) << "a turntable alone is a video";
}

TEST_F(RenderViewpoint, ThePolesAreMergedByDefault) {
  const std::string render = "render axis" + kTiny + folder.path("a.png") + " --sidecar ";
  const auto merge = [&] { return ods::GltfJson::parse(bytes("a.camera.json")).dump(); };
  ASSERT_EQ(run(render), 0) << err;
  EXPECT_NE(merge().find("\"mode\":\"cosine\""), std::string::npos) << merge();
  const std::string usual = bytes("a.png");
  ASSERT_EQ(run(render + "--merge cosine,60,90"), 0) << err;
  EXPECT_TRUE(bytes("a.png") == usual);
  ASSERT_EQ(run(render + "--merge none"), 0) << err;
  EXPECT_EQ(merge().find("cosine"), std::string::npos) << merge();
  EXPECT_FALSE(bytes("a.png") == usual);
  ASSERT_EQ(run(render + "--camera-preset google"), 0) << err;
  EXPECT_EQ(merge().find("cosine"), std::string::npos) << "another system's camera has that system's merge";
}

}  // namespace ods::stage_command_test
