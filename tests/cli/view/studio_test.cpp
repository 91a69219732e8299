// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio of ods view as its page uses it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "ods/camera/layout.h"
#include "ods/camera/projection.h"
#include "ods/camera/stereo_camera.h"
#include "ods/image/image_file.h"
#include "ods/image/tone.h"
#include "tests/support/places.h"
#include "tests/support/studio_server.h"

using namespace std::chrono_literals;

namespace ods::studio_command_test {

class StudioCommand : public StudioServer {};

// The process that renders a picture for a server: the supervisor, which the server has started, started it.
int renderer_of(int server) {
  const std::vector<int> supervisors = children_of(server);
  const std::vector<int> programs = supervisors.size() == 1 ? children_of(supervisors[0]) : std::vector<int>();
  EXPECT_EQ(programs.size(), 1u);
  return programs.empty() ? 0 : programs[0];
}

// The mean of code values 0..255 of each half, one above the other.
std::array<double, 2> means_of_halves(const std::vector<float>& values) {
  std::array<double, 2> sums{};
  for (size_t i = 0; i < values.size(); i++) sums[i * 2 / values.size()] += static_cast<double>(values[i]);
  for (double& sum : sums) sum /= static_cast<double>(values.size()) / 2.0;
  return sums;
}

TEST_F(StudioCommand, DescribesItsControls) {
  const Json studio = Json::parse(body_of(get("view.json")))["studio"];
  EXPECT_EQ(studio["scene"], "toys");
  EXPECT_EQ(studio["settings"]["sidecar"]["merge_top"]["mode"], "cosine");
  EXPECT_EQ(studio["ranges"]["ipd"][0], 0.0);
  EXPECT_EQ(studio["settings"]["exposure"], 0.0);
  for (const ods::NamedProjection& named : ods::named_projections()) {
    const Json controls = studio["controls"][std::string(named.name)];
    const auto has = [&](const char* number) { return std::ranges::find(controls, number) != controls.end(); };
    EXPECT_EQ(has("range"), ods::has_range(named.setting.kind)) << named.name;
    EXPECT_EQ(has("fov"), ods::has_fov(named.setting.kind)) << named.name;
    EXPECT_EQ(has("lens"), ods::has_lens(named.setting.kind)) << named.name;
    EXPECT_EQ(has("polynomial"), named.name == "fisheye-polynomial") << named.name;
  }
  for (const auto& row : ods::kMergeTable) EXPECT_EQ(studio["kernel_merges"][std::string(row.name)], row.member);
  // The page's numbers are those that the server takes where none are given.
  Json settings = studio["settings"];
  settings["sidecar"]["projection"] = {{"name", "fisheye-polynomial"}};
  const std::string usual = asked("set", settings)["command"];
  settings["sidecar"]["projection"].update(studio["polynomial_lens"]);
  EXPECT_EQ(asked("set", settings)["command"], usual);
  settings["sidecar"]["projection"]["polynomial"][1] = -0.05;
  settings["sidecar"]["axis"] = {0.0, 1.0, 0.5};
  const std::string own = asked("set", settings)["command"];
  EXPECT_NE(own.find("--axis 0,1,0.5 "), std::string::npos) << own;
  EXPECT_NE(own.find("--lens-polynomial "), std::string::npos) << own;
  settings["sidecar"]["projection"] = {{"name", "vr180"}};
  settings["sidecar"]["picture"]["layout"] = "side-by-side";
  const Json half = asked("set", settings);
  EXPECT_EQ(half["end"], "_180_LR.png");
  EXPECT_TRUE(half["command"].get<std::string>().ends_with(" -o toys_180_LR.png")) << half;
}

// Thirty changes in quick succession; then the picture equals the output of the command that the page shows.
TEST_F(StudioCommand, ShowsWhatItsCommandRenders) {
  Json settings = Json::parse(body_of(get("view.json")))["studio"]["settings"];
  settings["merge_limit"] = nullptr;
  Json answer;
  for (int i = 0; i < 30; i++) {
    settings["sidecar"]["yaw"] = 3 * i;
    settings["sidecar"]["merge_top"] = {{"mode", "linear"}, {"start", 30 + i}, {"end", 85}, {"exponent", 1}};
    settings["exposure"] = 0.5;
    settings["width"] = 256;
    answer = asked("set", settings);
    std::this_thread::sleep_for(20ms);
  }
  const StudioFrame frame = frame_of(answer["revision"], "base", 256);
  ASSERT_FALSE(frame.pixels.empty());
  const std::string command = answer["command"];
  EXPECT_NE(command.find("--yaw 87"), std::string::npos) << command;
  EXPECT_NE(command.find("--merge-top linear,59,85,1"), std::string::npos) << command;
  ASSERT_TRUE(command.starts_with("ods ")) << command;
  ASSERT_EQ(run(command.substr(4) + " -q --samples 16 --noise none"), 0) << err;
  std::vector<float> shown;
  for (const char c : frame.pixels) shown.push_back(static_cast<float>(static_cast<unsigned char>(c)));
  std::vector<float> rendered;
  for (const float light : ods::read_image(folder.path("toys_360_TB.png")).pixels) {
    rendered.push_back(255.0f * ods::srgb_encode(light));
  }
  const auto ours = means_of_halves(shown), theirs = means_of_halves(rendered);
  for (size_t eye = 0; eye < 2; eye++) EXPECT_NEAR(ours[eye], theirs[eye], 1.0) << eye;
}

// A scene that is made in no time: its command is run for every merge and every layout.
class StudioOfAxis : public StudioCommand {
  const char* scene() const override { return "axis"; }
};

// Options name files, and the page's camera has its maps with it.
TEST_F(StudioOfAxis, HasACommandForEveryMergeAndLayout) {
  Json settings = shown()["settings"];
  settings["merge_limit"] = nullptr;
  settings["width"] = 64;
  const Json map = {{"width", 4}, {"height", 2}, {"values", {0, 0.25, 0.5, 0.75, 1, 0.3, 0.6, 0.9}}};
  settings["sidecar"]["merge_map"] = settings["sidecar"]["head_tilt_map"] = map;
  const auto renders = [&](const std::string& what) {
    const std::string command = asked("set", settings)["command"];
    EXPECT_EQ(run(command.substr(4) + " -q --samples 1 --noise none"), 0) << what << ": " << command << err;
    return command;
  };
  const Json first = asked("set", settings);
  EXPECT_NE(first["command"].get<std::string>().find("--head-tilt-map axis.head-tilt-map.exr"), std::string::npos);
  EXPECT_NE(first["note"], "");
  settings["sidecar"]["merge_top"]["mode"] = "map";
  asked("set", settings);
  EXPECT_EQ(asked("save")["file"], "axis.camera.json");
  for (const int mode : ods::kMerges) {
    for (const auto& [which, other] : {std::pair{"merge_top", "merge_bottom"}, {"merge_bottom", "merge_top"}}) {
      settings["sidecar"][which]["mode"] = ods::merge_name(mode);
      settings["sidecar"][other]["mode"] = "none";
      renders(std::string(which) + " " + std::string(ods::merge_name(mode)));
    }
  }
  settings["sidecar"]["merge_top"]["mode"] = settings["sidecar"]["merge_bottom"]["mode"] = "map";
  const std::string restated = renders("map");
  EXPECT_NE(restated.find(" --merge map,60,90,1 "), std::string::npos) << restated;
  EXPECT_NE(restated.find(" --merge-map axis.merge-map.exr "), std::string::npos) << restated;
  asked("render", {{"output", "page.png"}, {"quality", "draft"}});
  const Json job = ended_job();
  EXPECT_EQ(job["state"], "done") << job;
  for (const ods::Layout layout : ods::kLayouts) {
    settings["sidecar"]["picture"]["layout"] = ods::layout_name(layout);
    renders(std::string(ods::layout_name(layout)));
  }
}

// The page sends all settings at each change: maps stay here.
TEST_F(StudioCommand, TakesACameraWithLargeMaps) {
  ASSERT_EQ(asked("save")["file"], "toys.camera.json");
  Json camera = Json::parse(folder.read("toys.camera.json"));
  std::vector<float> values(256 * 128);
  for (size_t i = 0; i < values.size(); i++) values[i] = static_cast<float>(i % 257) / 256.0f;
  camera["merge_map"] = camera["head_tilt_map"] = {{"width", 256}, {"height", 128}, {"values", values}};
  camera["merge_top"]["mode"] = "map";
  const std::string answer = drop("with_maps.camera.json", camera.dump());
  ASSERT_EQ(status_of(answer), 200) << answer.substr(0, 500);
  Json settings = Json::parse(body_of(answer))["settings"];
  EXPECT_LT(settings.dump().size(), 4096u);
  settings["sidecar"]["yaw"] = 10;
  settings["width"] = 64;
  const std::string command = asked("set", settings)["command"];
  EXPECT_EQ(asked("save")["file"], "toys.camera.json");
  const Json saved = Json::parse(folder.read("toys.camera.json"));
  EXPECT_EQ(saved["yaw"], 10);
  for (const char* map : {"merge_map", "head_tilt_map"}) EXPECT_TRUE(saved[map] == camera[map]) << map;
  EXPECT_EQ(run(command.substr(4) + " -q --samples 1 --noise none"), 0) << command << err;
  settings["maps"]["merge"] = 99;
  EXPECT_EQ(status_of(post("studio/set", settings.dump())), 400);
}

TEST_F(StudioCommand, HasTheSunAndTheEnvironmentsTurn) {
  Json settings = Json::parse(body_of(get("view.json")))["studio"]["settings"];
  EXPECT_EQ(settings["sun"], Json({{"elevation", 35.0}, {"azimuth", 120.0}}));
  settings["env"] = "sky";
  const std::string usual = asked("set", settings)["command"];
  EXPECT_NE(usual.find(" --env sky "), std::string::npos) << usual;
  EXPECT_EQ(usual.find("--env-"), std::string::npos) << usual;
  settings["sun"] = {{"elevation", 10}, {"azimuth", -20}};
  settings["turn"] = 30;
  settings["strength"] = 0.5;
  const Json set = asked("set", settings);
  const std::string command = set["command"];
  EXPECT_NE(command.find("--env sky:elevation=10,azimuth=-20 --env-turn 30 --env-strength 0.5"), std::string::npos)
      << command;
  frame_of(set["revision"], "base", 128);
  EXPECT_EQ(status_of(post("studio/set", R"({"sun":{"elevation":91}})")), 400);
  EXPECT_EQ(status_of(post("studio/set", R"({"strength":-1})")), 400);
}

TEST_F(StudioCommand, SaysWhatIsWrongWithASetting) {
  for (const char* wrong :
       {R"({"sidecar":{"omnistereo_camera":1,"ipd":-1}})", R"({"exposure":"bright"})", R"({"tone":"x"})",
        R"({"env":"/etc/passwd"})", R"({"variant":"none"})", R"({"width":1})", "{", "[]", "null",
        R"({"sidecar":{"omnistereo_camera":1,"merge_top":{"mode":"linear","start":90,"end":90}}})"}) {
    const std::string answer = post("studio/set", wrong);
    EXPECT_EQ(status_of(answer), 400) << wrong << answer;
    const std::string text = body_of(answer);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << wrong << text;
  }
  EXPECT_EQ(status_of(post("studio/set", std::string(1 << 17, ' '))), 413);
}

TEST_F(StudioCommand, RendersUnderANewNameOnly) {
  for (const char* name : {"", "../up.png", "/tmp/x.png", ".hidden.png", "-x.png", "no_picture.txt", "a/b.png",
                           "a%V.png", "100%.png", "a\nb.png", "a\x1b[2J.png", "a\x7f.png"}) {
    EXPECT_EQ(status_of(post("studio/render", Json({{"output", name}, {"quality", "draft"}}).dump())), 400) << name;
  }
  EXPECT_EQ(status_of(post("studio/render", R"({"output":"x.png\u0000.png","quality":"draft"})")), 400);
  asked("set", {{"width", 64}});
  asked("render", {{"output", "small_360_TB.png"}, {"quality", "draft"}});
  EXPECT_EQ(status_of(post("studio/render", R"({"output":"other.png","quality":"draft"})")), 400) << "one at a time";
  const Json job = ended_job();
  EXPECT_EQ(job["state"], "done") << job;
  EXPECT_EQ(job["item"], 0);
  EXPECT_EQ(job["output"], "small_360_TB.png");
  EXPECT_TRUE(std::filesystem::exists(folder.path("small_360_TB.png")));
  EXPECT_NE(get("item/0/picture.png").find("\x89PNG"), std::string::npos);
  EXPECT_EQ(status_of(post("studio/render", R"({"output":"small_360_TB.png","quality":"draft"})")), 400) << "it exists";
}

TEST_F(StudioCommand, WritesThroughNoLink) {
  namespace fs = std::filesystem;
  asked("set", {{"width", 64}});
  fs::create_symlink(folder.path("elsewhere.png"), folder.path("dangling.png"));
  EXPECT_EQ(status_of(post("studio/render", R"({"output":"dangling.png","quality":"draft"})")), 400);
  // A link appears there while the picture is rendered.
  asked("render", {{"output", "late.png"}, {"quality", "draft"}});
  fs::create_symlink(folder.path("elsewhere.png"), folder.path("late.png"));
  fs::create_symlink(folder.path("elsewhere.png"), folder.path("late.png.unfinished"));
  const Json job = ended_job();
  EXPECT_EQ(job["state"], "done") << job;
  EXPECT_EQ(job["output"], "late-2.png");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder.path("late-2.png"))));
  fs::create_symlink(folder.path("elsewhere.png"), folder.path("toys.camera.json"));
  EXPECT_EQ(asked("save")["file"], "toys-2.camera.json");
  fs::remove(folder.path("toys-2.camera.json"));
  fs::create_symlink(folder.path("elsewhere.png"), folder.path("toys-2.camera.json"));
  EXPECT_EQ(asked("save")["file"], "toys-2.camera.json");
  EXPECT_FALSE(fs::exists(folder.path("elsewhere.png")));
}

TEST_F(StudioCommand, CancelsWhatItRendersAndKeepsNothing) {
  const std::vector<std::string> before = folder.names();
  asked("set", {{"width", 1024}});
  asked("render", {{"output", "large_360_TB.png"}, {"quality", "final"}});
  wait_for_progress();
  asked("cancel");
  EXPECT_EQ(Json::parse(body_of(get("studio/job")))["state"], "cancelled");
  for (int i = 0; i < 100 && folder.names() != before; i++) std::this_thread::sleep_for(100ms);
  EXPECT_EQ(folder.names(), before);
}

// Whatever ends the server, what it has started ends, and leaves nothing.
TEST_F(StudioCommand, TakesWhatItRendersWithIt) {
  const std::vector<std::string> before = folder.names();
  for (const int signal : {SIGINT, SIGKILL}) {
    asked("set", {{"width", 1024}});
    asked("render", {{"output", "large_360_TB.png"}, {"quality", "final"}});
    wait_for_progress();
    std::vector<int> children = children_of(server->process());
    ASSERT_EQ(children.size(), 1u);
    children.push_back(renderer_of(server->process()));
    server->kill(signal);
    server->finish();
    for (const int child : children) EXPECT_TRUE(has_ended(child)) << "after signal " << signal;
    for (int i = 0; i < 100 && folder.names() != before; i++) std::this_thread::sleep_for(100ms);
    EXPECT_EQ(folder.names(), before) << "after signal " << signal;
    serve({"toys"});
  }
}

// A tab that is loaded again and again while a picture is rendered: it requests the page and a frame, and disconnects.
// The renderer is stopped meanwhile: it would take the server's time, and its progress does not matter.
TEST_F(StudioCommand, ReloadsWhileRenderingTakeNoMemory) {
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer keeps what is freed";
  const Json settings = Json::parse(body_of(get("view.json")))["studio"]["settings"];
  const auto reload = [&](int i) {
    for (const char* path : {"", "studio.js", "view.json"}) EXPECT_EQ(status_of(get(path)), 200) << path;
    Json changed = settings;
    changed["sidecar"]["yaw"] = i;
    changed["width"] = 4096;
    const int revision = asked("set", changed)["revision"];
    const Connection gone(port);
    gone.send_text(head(fmt::format("/{}/studio/frame?after=0", secret)));
    if (i == 0) frame_of(revision, "base", 160);
  };
  asked("set", {{"width", 4096}});
  asked("render", {{"output", "large_360_TB.png"}, {"quality", "final"}});
  wait_for_progress();
  const int stopped = renderer_of(server->process());
  ASSERT_GT(stopped, 0);
  kill(stopped, SIGSTOP);
  EXPECT_LT(leaked_by(reload), 300);
  EXPECT_EQ(Json::parse(body_of(get("studio/job")))["state"], "running");
  kill(stopped, SIGCONT);
  asked("cancel");
}

TEST_F(StudioCommand, SavesTheCameraAndTakesItBack) {
  Json settings = Json::parse(body_of(get("view.json")))["studio"]["settings"];
  settings["sidecar"]["roll"] = 12.5;
  asked("set", settings);
  folder.write("toys.camera.json", "of somebody else");
  EXPECT_EQ(asked("save")["file"], "toys-2.camera.json");
  EXPECT_EQ(asked("save")["file"], "toys-2.camera.json");
  EXPECT_EQ(folder.read("toys.camera.json"), "of somebody else");
  settings["sidecar"]["roll"] = 0;
  asked("set", settings);
  const std::string answer = post("studio/drop?name=toys-2.camera.json", folder.read("toys-2.camera.json"));
  ASSERT_EQ(status_of(answer), 200) << answer;
  EXPECT_EQ(Json::parse(body_of(answer))["settings"]["sidecar"]["roll"], 12.5);
  EXPECT_EQ(status_of(post("studio/drop?name=x.exe", "MZ")), 400);
  EXPECT_EQ(status_of(post("studio/drop?name=x.glb", "no scene")), 400);
  EXPECT_EQ(status_of(get("studio/status")), 200) << "the old scene is still there";
}

TEST_F(StudioCommand, SaysWhatAClickMeets) {
  const Json settings = Json::parse(body_of(get("view.json")))["studio"]["settings"];
  frame_of(asked("set", settings)["revision"], "base", 192);
  const Json ground = asked("pick", {{"yaw", 0}, {"pitch", -60}, {"eye", "left"}});
  ASSERT_TRUE(ground.contains("distance")) << ground;
  EXPECT_GT(ground["distance"], 0.1);
  EXPECT_GT(ground["disparity"], 0.0);
  const Json comfort = ground["comfort"];
  EXPECT_NEAR(comfort["distance"], ground["distance"], 0.03);
  EXPECT_GT(comfort["vertical"], 1.0);
  EXPECT_TRUE(comfort["level"].is_string()) << comfort;
}

// The layer that the page lays over the picture, and the line beside the merge's curve.
TEST_F(StudioCommand, KnowsWhereEyesStrain) {
  Json settings = Json::parse(body_of(get("view.json")))["studio"]["settings"];
  settings["sidecar"]["position"] = {0, 0.3, 0};
  frame_of(asked("set", settings)["revision"], "base", 192);
  const Json comfort = Json::parse(body_of(get("studio/comfort")));
  ASSERT_EQ(comfort["auto"].size(), 180u) << comfort;
  EXPECT_LT(comfort["auto"][179], 0.3) << "the ground is near";
  EXPECT_EQ(comfort["auto"][90], 1.0);
  EXPECT_NE(comfort["level"], "ok") << comfort;
  for (const char* eye : {"left", "right"}) {
    const std::string heat = get(fmt::format("studio/heat.png?eye={}", eye));
    ASSERT_EQ(status_of(heat), 200) << heat.substr(0, 300);
    const std::string png = body_of(heat);
    const ods::CodeImage image = ods::decode_image(std::as_bytes(std::span(png)), "heat.png");
    size_t hot = 0;
    for (const uint32_t pixel : image.pixels) hot += (pixel & 0xffu) != (pixel >> 8 & 0xffu);  // what is ok is grey
    EXPECT_GT(hot, image.pixels.size() / 50);
    EXPECT_LT(hot, image.pixels.size() * 9 / 10);
  }
}

// A scene opens with a merge that its depth allows; with the usual merge, the floor strains the eyes.
class StudioComfort : public StudioServer, public testing::WithParamInterface<const char*> {
  std::string opened_;
  const char* scene() const override { return opened_.c_str(); }
  void SetUp() override {
    opened_ = GetParam();
    if (opened_.ends_with(".glb")) opened_ = (std::filesystem::path(shared_scenes()) / opened_).string();
    StudioServer::SetUp();
  }
};

TEST_P(StudioComfort, IsNoErrorAtTheDefaults) {
  Json settings = shown()["settings"];
  const auto level_of = [&](const Json& limit) {
    settings["merge_limit"] = limit;
    frame_of(asked("set", settings)["revision"], "base", 512);
    return Json::parse(body_of(get("studio/comfort")))["level"];
  };
  EXPECT_EQ(level_of(settings["merge_limit"]), "caution");
  EXPECT_EQ(level_of(nullptr), "error") << "this test cannot fail";
}

std::vector<const char*> opened_scenes() {
  std::vector<const char*> scenes{"toys", "room"};
  if (std::filesystem::exists(std::filesystem::path(shared_scenes()) / "atrium.glb")) scenes.push_back("atrium.glb");
  return scenes;
}
INSTANTIATE_TEST_SUITE_P(OfScenes, StudioComfort, testing::ValuesIn(opened_scenes()));

// The merge follows the camera, and the command, the saved camera and the frame have the same.
TEST_F(StudioCommand, MergesByDepthAsItsCommandDoes) {
  Json settings = shown()["settings"];
  settings["width"] = 64;
  std::vector<Json> merges;
  for (const double height : {1.5, 0.7}) {
    settings["sidecar"]["position"][1] = height;
    const Json set = asked("set", settings);
    const std::string command = set["command"];
    EXPECT_NE(command.find(" --merge auto "), std::string::npos) << command;
    EXPECT_EQ(command.find("-map"), std::string::npos) << command;
    EXPECT_EQ(set["note"], "");
    const Json shares = frame_of(set["revision"], "base", 128).about["merge"];
    EXPECT_EQ(asked("save")["file"], "toys.camera.json");
    ASSERT_EQ(run(command.substr(4) + " -q --samples 1 --noise none --sidecar"), 0) << command << err;
    const Json saved = Json::parse(folder.read("toys.camera.json"));
    const Json rendered = Json::parse(folder.read("toys_360_TB.camera.json"));
    EXPECT_EQ(saved["merge_map"], rendered["merge_map"]);
    EXPECT_EQ(saved["merge_top"]["mode"], "map");
    ASSERT_EQ(shares.size(), 180u);
    EXPECT_NEAR(shares[179], saved["merge_map"]["values"].back(), 0.0006);
    std::filesystem::remove("toys_360_TB.png");
    merges.push_back(shares);
  }
  EXPECT_LT(merges[1][179], merges[0][179]) << "the ground is nearer";
  settings["merge_limit"] = 40;
  const std::string command = asked("set", settings)["command"];
  EXPECT_NE(command.find(" --merge auto,40 "), std::string::npos) << command;
  EXPECT_EQ(status_of(post("studio/set", R"({"merge_limit":0})")), 400);
  const Json dropped = Json::parse(body_of(drop("toys.camera.json", folder.read("toys.camera.json"))));
  EXPECT_EQ(dropped["settings"]["merge_limit"], nullptr) << "a camera's own merge is not kept";
}

}  // namespace ods::studio_command_test
