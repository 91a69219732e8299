// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of other programs, with a script in the place of Blender.
#include "tests/support/bridge_fixture.h"

namespace ods::bridge_test {

TEST_F(Bridge, ConvertsOnceWhileTheFileIsTheSame) {
  Ods first(info());
  EXPECT_EQ(first.finish(), 0) << first.err;
  EXPECT_NE(first.out.find("scene          house"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("triangles      1 "), std::string::npos) << first.out;
  EXPECT_NE(first.err.find("Blender converts '" + scene_), std::string::npos) << first.err;
  Ods second(info());
  EXPECT_EQ(second.finish(), 0);
  EXPECT_EQ(second.err, "");
  EXPECT_EQ(runs(), 1u);
  std::vector<std::string> baked = info();
  baked.insert(baked.end(), {"--bake", "64"});
  EXPECT_EQ(Ods(baked).finish(), 0);
  EXPECT_EQ(runs(), 2u) << "other options";
  write(scene_, "BLENDER-v304 and something else");
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(runs(), 3u) << "another file";
}

// A virtual environment's python3 has nothing of what Blender's Python needs.
TEST_F(Bridge, TheSystemsPythonComesFirst) {
  answer(R"({"omnistereo_bridge": 1})", "case $PATH in /usr/local/bin:/usr/bin:/bin:*) ;; *) exit 1 ;; esac");
  Ods ods(info());
  EXPECT_EQ(ods.finish(), 0) << ods.err;
}

TEST_F(Bridge, ConvertsAgainWhenAPictureHasChanged) {
  const std::string picture = folder_ + "/wood.png";
  write(picture, "12345");
  struct stat found = {};
  ASSERT_EQ(stat(picture.c_str(), &found), 0);
  const int64_t stamp = int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec;
  answer(R"({"omnistereo_bridge": 1, "reads": [[")" + picture + "\", 5, " + std::to_string(stamp) + "]]}");
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(runs(), 1u);
  write(picture, "123456");
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(runs(), 2u);
}

TEST_F(Bridge, TwoProcessesConvertOnce) {
  answer(R"({"omnistereo_bridge": 1})", "sleep 1");
  Ods a(info()), b(info());
  EXPECT_EQ(a.finish(), 0) << a.err;
  EXPECT_EQ(b.finish(), 0) << b.err;
  EXPECT_EQ(runs(), 1u);
}

TEST_F(Bridge, AFailingBlenderIsOneLine) {
  program("kill -SEGV $$");
  expect_failure("Blender crashed (signal 11)");
  program("echo 'ods-bridge error it was saved by Blender 9.1' >&2\nexit 3");
  expect_failure("it was saved by Blender 9.1");
  program("echo 'no display' >&2\nexit 1");
  expect_failure("Blender ended before it was done; its output: no display");
  program("echo 'ods-bridge done 1' >&2");
  expect_failure("Blender ended before it was done");
  program("head -c 3000000 /dev/zero >&2\nexit 0");
  expect_failure("Blender ended before it was done");
}

// Itself, what it has started, what has a session of its own, and what hears no SIGTERM.
TEST_F(Bridge, AHangingBlenderIsEndedWithAllThatItHasStarted) {
  program(hanging());
  expect_failure("Blender did not finish within 0.5 seconds (--blender-limit gives it more)",
                 {"--blender-limit", "0.5"});
  expect_ended();
}

TEST_F(Bridge, ABlenderThatIsDoneLeavesNoProcess) {
  answer(R"({"omnistereo_bridge": 1})", "setsid sleep 1000 & echo $! >>" + folder_ + "/process");
  Ods ods(info());
  EXPECT_EQ(ods.finish(), 0) << ods.err;
  expect_ended();
}

TEST_F(Bridge, WhateverEndsUsEndsBlenderAndLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    fs::remove(folder_ + "/started");
    program(hanging());
    Ods ods(info());
    while (!fs::exists(folder_ + "/started")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ods.kill(signal);
    EXPECT_EQ(ods.finish(), signal == SIGKILL ? 1000 + signal : 128 + signal);
    expect_ended();
    for (int i = 0; i < 200 && has_folder(); i++) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(has_folder()) << signal;
    EXPECT_EQ(kept(), signal == SIGKILL ? 1u : 0u) << "the claim, which is free when its holder is dead";
    fs::remove_all(folder_ + "/cache");
  }
}

TEST_F(Bridge, TemporaryFilesAreRemoved) {
  const std::string shared = folder_ + "/shared";
  fs::create_directory(shared);
  for (const char* name : {"TMPDIR", "TMP", "TEMP"}) setenv(name, shared.c_str(), 1);
  const std::string leave =
      "for f in \"$TMPDIR\" \"$TMP\" \"$TEMP\"; do mkdir -p \"$f/blender_1/deep\"; touch \"$f/x\"; done";
  answer(R"({"omnistereo_bridge": 1})", leave);
  Ods well(info());
  EXPECT_EQ(well.finish(), 0) << well.err;
  EXPECT_EQ(kept(), 1u);
  EXPECT_TRUE(fs::is_empty(shared));
  for (const char* name : {"TMPDIR", "TMP", "TEMP"}) unsetenv(name);
}

TEST_F(Bridge, AHangingAssimpIsEnded) {
  write(folder_ + "/car.3ds", "x");
  write(folder_ + "/assimp", "#!/bin/sh\n" + hanging());
  fs::permissions(folder_ + "/assimp", fs::perms::owner_all);
  const std::string path = getenv("PATH");
  setenv("PATH", (folder_ + ":/usr/bin:/bin").c_str(), 1);
  Ods ods({"info", folder_ + "/car.3ds", "--blender-limit", "0.5"});
  EXPECT_EQ(ods.finish(), 3);
  EXPECT_NE(ods.err.find("car.3ds': Assimp did not finish within 0.5 seconds (--blender-limit gives it more)"),
            std::string::npos)
      << ods.err;
  expect_ended();
  write(folder_ + "/assimp", "#!/bin/sh\necho 'ERROR: Failed to load file: bad chunk'\nexit 10\n");
  Ods said({"info", folder_ + "/car.3ds"});
  EXPECT_EQ(said.finish(), 3);
  EXPECT_NE(said.err.find("its output: ERROR: Failed to load file: bad chunk"), std::string::npos) << said.err;
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(kept(), 0u);
}

// A faulty command line is told before Blender starts.
TEST_F(Bridge, TheCommandLineComesFirst) {
  const std::vector<std::vector<std::string>> faulty = {
      {"render", scene_, "-o", folder_ + "/p.png", "--widht", "512"},
      {"render", scene_},
      {"render", scene_, "-o", folder_ + "/p.png", "--width", "0"},
      {"render", scene_, "-o", folder_ + "/p.png", "--parts", "2"},
      {"render", "room", "-o", folder_ + "/p.png", "--camera-file", scene_, "--ipd", "x"},
      {"video", scene_, "-o", folder_ + "/v.mp4", "--time", "1"},
      {"comfort", scene_, "--gaze", "0"},
      {"info", scene_, "--jsn"},
  };
  for (std::vector<std::string> words : faulty) {
    words.insert(words.end(), {"--blender", folder_ + "/blender"});
    Ods ods(words);
    EXPECT_EQ(ods.finish(), 2) << words[0] << " " << words.back() << ods.err;
  }
  EXPECT_EQ(runs(), 0u);
}

TEST_F(Bridge, QuietIsQuiet) {
  for (const std::vector<std::string>& scene :
       {std::vector<std::string>{scene_}, std::vector<std::string>{"furnace", "--camera-file", scene_}}) {
    answer(R"({"omnistereo_bridge": 1, "camera": {"omnistereo_camera": 1, "ipd": 0.08}})");
    fs::remove_all(folder_ + "/cache");
    std::vector<std::string> words = {"render"};
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), {"--blender", folder_ + "/blender", "-o", folder_ + "/p.png", "--width", "16",
                               "--samples", "1", "--bounces", "1", "-q"});
    Ods ods(words);
    EXPECT_EQ(ods.finish(), 0);
    EXPECT_EQ(ods.err, "");
  }
  EXPECT_EQ(runs(), 2u);
}

// The numbers of a lens are for the projection of the file's camera, which is unknown before the file is converted.
TEST_F(Bridge, LensOptionsAreForTheFilesProjection) {
  answer(R"({"omnistereo_bridge": 1, "camera": {"omnistereo_camera": 1,
      "projection": {"name": "fisheye", "fov": 170}, "merge_top": {"mode": "none"}, "merge_bottom": {"mode": "none"}}})");
  const std::string picture = folder_ + "/p.exr";
  std::vector<std::string> words = {"render", scene_,    "--blender", folder_ + "/blender", "-o", picture,
                                    "-q",     "--width", "16",        "--samples",          "1",  "--bounces",
                                    "1",      "--fov",   "120",       "--sidecar"};
  Ods ods(words);
  ASSERT_EQ(ods.finish(), 0) << ods.err;
  std::vector<std::string> warnings;
  const StereoCamera camera = load_sidecar(folder_ + "/p.camera.json", warnings).camera;
  EXPECT_TRUE(is_fisheye(camera.projection.kind));
  EXPECT_EQ(camera.projection.fov, 120.0f);
  words.insert(words.end(), {"--range", "-90,90"});
  Ods wrong(words);
  EXPECT_EQ(wrong.finish(), 2);
  EXPECT_NE(wrong.err.find("--range is for"), std::string::npos) << wrong.err;
}

TEST_F(Bridge, SaysWhatIsMissing) {
  Ods none({"info", scene_, "--blender", folder_ + "/nothing"});
  EXPECT_EQ(none.finish(), 3);
  EXPECT_NE(none.err.find("--blender: there is no program"), std::string::npos) << none.err;
  write(folder_ + "/car.fbx", "x");
  const std::string path = getenv("PATH");
  setenv("PATH", (folder_ + "/nowhere").c_str(), 1);
  write(folder_ + "/car.3ds", "x");
  Ods blend({"info", scene_}), fbx({"info", folder_ + "/car.fbx"}), old({"info", folder_ + "/car.3ds"});
  EXPECT_EQ(blend.finish(), 3);
  EXPECT_EQ(fbx.finish(), 3);
  EXPECT_EQ(old.finish(), 3);
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(blend.err.find("needs Blender to be read: install it, or name it with --blender PATH"), std::string::npos)
      << blend.err;
  EXPECT_NE(fbx.err.find("needs Blender or Assimp's command to be read"), std::string::npos) << fbx.err;
  EXPECT_NE(old.err.find("needs Assimp's command to be read: install it"), std::string::npos) << old.err;
}

// Blender does not read FBX in ASCII, and an OBJ may be in any encoding. Assimp leaves the pictures where they are, by
// the paths of the program that wrote the scene.
TEST_F(Bridge, WhatBlenderCannotReadAssimpDoes) {
  GltfBuilder made = make_triangle();
  made.primitive()["attributes"]["TEXCOORD_0"] = made.add<float>({0, 0, 1, 0, 0, 1}, kFloat, "VEC2");
  made.primitive()["material"] = 0;
  made.json["images"] = {{{"uri", ".\\Wood.PNG"}}, {{"uri", "C:\\gone.png"}}, {{"uri", folder_ + "/out/there.png"}}};
  made.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  made.json["materials"] = {{{"name", "B*r"},
                             {"emissiveFactor", {1, 1, 1}},
                             {"emissiveTexture", {{"index", 1}}},
                             {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  Binary glb = made.glb();
  *std::search_n(glb.begin(), glb.end(), 1, '*') = 0xe4;  // in Latin-1
  write(folder_ + "/made.glb", {glb.begin(), glb.end()});
  const Binary png = small_png();
  write(folder_ + "/wood.png", {png.begin(), png.end()});
  fs::create_directories(folder_ + "/out");
  write(folder_ + "/out/there.png", {png.begin(), png.end()});
  write(folder_ + "/car.fbx", "; FBX 7.4.0 project file");
  program("echo 'ods-bridge error Blender cannot read it' >&2\nexit 3");
  const std::vector<std::string> words = {"info", folder_ + "/car.fbx", "--blender", folder_ + "/blender"};
  const std::string path = getenv("PATH");
  setenv("PATH", (folder_ + ":/usr/bin:/bin").c_str(), 1);
  write(folder_ + "/assimp", "#!/bin/sh\ncp " + folder_ + "/made.glb \"$3\"\n");
  fs::permissions(folder_ + "/assimp", fs::perms::owner_all);
  Ods first(words);
  EXPECT_EQ(first.finish(), 0) << first.err;
  EXPECT_NE(first.err.find("car.fbx': Blender cannot read it"), std::string::npos) << first.err;
  EXPECT_NE(first.err.find("Assimp converts '"), std::string::npos) << first.err;
  EXPECT_NE(first.out.find("materials      1, 1 textures"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("0 glowing triangles"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("there is no picture 'C:\\gone.png'"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("/out/there.png'"), std::string::npos) << "an absolute path is not followed: " << first.out;
  Ods second(words);
  EXPECT_EQ(second.finish(), 0);
  EXPECT_EQ(second.err, "");
  write(folder_ + "/wood.png", "no picture any more");
  Ods third(words);
  EXPECT_EQ(third.finish(), 0) << third.err;
  EXPECT_NE(third.out.find("materials      1, 0 textures"), std::string::npos) << third.out;
  write(folder_ + "/assimp", "#!/bin/sh\nexit 10\n");
  fs::remove(folder_ + "/wood.png");
  Ods fourth(words);
  EXPECT_EQ(fourth.finish(), 3);
  EXPECT_NE(fourth.err.find("car.fbx': Assimp cannot read it"), std::string::npos) << fourth.err;
  setenv("PATH", path.c_str(), 1);
}

TEST_F(Bridge, RefusesWhatIsNoBlenderFile) {
  write(scene_, "hello");
  Ods ods(info());
  EXPECT_EQ(ods.finish(), 3);
  EXPECT_NE(ods.err.find("is not a Blender file, or is damaged"), std::string::npos) << ods.err;
  EXPECT_EQ(runs(), 0u);
  EXPECT_EQ(Ods({"info", folder_ + "/none.blend"}).finish(), 3);
  Ods confined({"info", scene_, "--confine", folder_});
  EXPECT_EQ(confined.finish(), 2);
  EXPECT_NE(confined.err.find("--confine does not hold"), std::string::npos) << confined.err;
}

// Options win over the file, and the file over what is usual.
TEST_F(Bridge, CameraAndLightAreTheFiles) {
  answer(R"({"omnistereo_bridge": 1, "environment": "0.5,0.5,0.5", "fps": 25, "warnings": ["hair of 'x' is lost"],
      "camera": {"omnistereo_camera": 1, "ipd": 0.08, "pitch": 5,
                 "projection": {"name": "lat-long", "longitude": [-90, 90]},
                 "merge_top": {"mode": "cosine", "start": 50, "end": 80}, "merge_bottom": {"mode": "none"},
                 "convergence": {"mode": "toe-in", "distance": 3}}})");
  const std::string picture = folder_ + "/p.exr";
  std::vector<std::string> words = {"render",    scene_,    "--blender", folder_ + "/blender", "-o", picture,
                                    "--sidecar", "--width", "16",        "--samples",          "1",  "--bounces",
                                    "1"};
  for (const bool given : {false, true}) {
    if (given) words.insert(words.end(), {"--ipd", "0.05"});
    Ods ods(words);
    ASSERT_EQ(ods.finish(), 0) << ods.err;
    EXPECT_NE(ods.err.find("hair of 'x' is lost"), std::string::npos) << ods.err;
    std::vector<std::string> warnings;
    const StereoCamera camera = load_sidecar(folder_ + "/p.camera.json", warnings).camera;
    EXPECT_EQ(camera.ipd, given ? 0.05f : 0.08f);
    EXPECT_EQ(camera.pitch, 5.0f);
    EXPECT_EQ(camera.projection.longitude, vec2(-90.0f, 90.0f));
    EXPECT_EQ(camera.top.mode, kMergeCosine);
    EXPECT_EQ(camera.top.start, 50.0f);
    EXPECT_EQ(camera.bottom.mode, kMergeNone);
    EXPECT_EQ(camera.convergence, kToeIn);
    EXPECT_EQ(camera.convergence_distance, 3.0f);
  }
}

}  // namespace ods::bridge_test
