// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods submit.
#include <fmt/format.h>

#include <regex>
#include <set>

#include "tests/support/farm.h"

namespace ods::farm_command_test {

using SubmitCommand = Farm;

constexpr const char* kTriangle =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

TEST_F(SubmitCommand, AVideoInTasksHasTheBitsOfOneProcess) {
  ASSERT_EQ(run("submit --to slurm --chunk 4 -- " + video() + " --frames 1-11 --keep-frames"), 0) << err;
  EXPECT_EQ(out, "7 frames-1.sbatch ods:frames:0\n8 video-1.sbatch ods:video:0\n");
  EXPECT_NE(err.find("11 frames in 3 tasks, then video"), std::string::npos) << err;
  const json made = plan("a");
  ASSERT_EQ(made["groups"].size(), 2u);
  EXPECT_EQ(made["groups"][0]["tasks"], 3);
  run_all(made);
  ASSERT_EQ(run(video("b.mp4") + " --frames 1-11 --keep-frames"), 0) << err;
  for (int frame = 1; frame <= 11; frame++) {
    const std::string name = fmt::format(".mp4.frames/frame.{:06}.exr", frame);
    EXPECT_TRUE(folder.read("a" + name) == folder.read("b" + name)) << frame;
  }
  EXPECT_TRUE(folder.read("a.mp4") == folder.read("b.mp4"));
}

// Each frame is rendered once. Unusable frames are rendered again.
TEST_F(SubmitCommand, FramesThatAreRenderedFirstAndThenDenoisedHaveTheBitsOfOneProcess) {
  const std::string more = " --frames 1-11 --keep-frames --denoise own --shutter 180";
  ASSERT_EQ(run("submit --to slurm --chunk 3 --raw-first -- " + video() + more), 0) << err;
  EXPECT_NE(err.find("11 frames in 4 tasks, then frames in 2 tasks, then video; no frame is rendered twice"),
            std::string::npos)
      << err;
  EXPECT_NE(err.find("the raw frames take up to "), std::string::npos) << err;
  const json groups = plan("a")["groups"];
  ASSERT_EQ(groups.size(), 3u);
  const auto raw = [&](int frame) { return folder.path(fmt::format("a.mp4.frames/frame.{:06}.exr.raw", frame)); };
  ASSERT_EQ(run(video("b.mp4") + more), 0) << err;
  const auto frame = [&](const char* film, int number) {
    return folder.read(fmt::format("{}.mp4.frames/frame.{:06}.exr", film, number));
  };
  for (int task = 1; task <= 4; task++) run_task(groups[0], task);
  for (int number = 1; number <= 11; number++) EXPECT_TRUE(std::filesystem::is_regular_file(raw(number))) << number;
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.mp4.frames/frame.000001.exr")));
  std::filesystem::copy_file(raw(2), folder.path("kept"));
  std::filesystem::copy_file(raw(9), raw(2), std::filesystem::copy_options::overwrite_existing);
  run_task(groups[1], 1);
  EXPECT_FALSE(frame("a", 2) == frame("b", 2)) << "raw frames are read, not rendered again";
  for (int number = 1; number <= 5; number++) {
    std::filesystem::remove(folder.path(fmt::format("a.mp4.frames/frame.{:06}.exr", number)));
  }
  std::filesystem::copy_file(folder.path("kept"), raw(2), std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(raw(4), 1000);
  std::filesystem::remove(raw(10));
  run_task(groups[1], 2), run_task(groups[1], 1);
  run_task(groups[2], 1);
  for (int number = 1; number <= 11; number++) {
    EXPECT_TRUE(frame("a", number) == frame("b", number)) << number;
    EXPECT_FALSE(std::filesystem::exists(raw(number))) << number;
  }
  EXPECT_TRUE(folder.read("a.mp4") == folder.read("b.mp4"));
  for (const std::string wrong : {"video toys --raw -o a.mp4", "video toys --raw --only 1/2 --denoise none -o a.mp4",
                                  "submit --to openjd --raw-first --chunk 1 -- video toys --denoise none -o a.mp4"}) {
    EXPECT_EQ(run(wrong), 2) << wrong;
  }
}

TEST_F(SubmitCommand, ATaskOfAVideoNamesTheFramesThatItMakes) {
  for (const std::string denoise : {"none", "own"}) {
    const std::string name = denoise + ".mp4",
                      task = video(name) + " --frames 1-6 --denoise " + denoise + " --only 2/3";
    ASSERT_EQ(run(task), 0) << err;
    const std::string frame = folder.path(name + ".frames/frame.00000");
    EXPECT_EQ(out, frame + "3.exr\n" + frame + "4.exr\n");
    ASSERT_EQ(run(task), 0) << err;
    EXPECT_EQ(out, "") << "nothing was made";
  }
}

TEST_F(SubmitCommand, APictureInPartsHasTheBitsOfOneMachine) {
  const std::string still = " toys --width 32 --samples 16 --exposure 1 --brighter -0.5 --tone linear -o ";
  ASSERT_EQ(run("submit --to openjd -- render" + still + folder.path("p.png") + " --parts 5 --denoise own"), 0) << err;
  const json made = plan("p");
  EXPECT_EQ(made["groups"][0]["option"], "--part");
  run_all(made);
  EXPECT_FALSE(std::filesystem::exists(folder.path("p.png.parts"))) << "merged";
  run_task(made["groups"][1], 1);  // twice does no harm
  ASSERT_EQ(run("render" + still + folder.path("q.png") + " --noise none --denoise own"), 0) << err;
  EXPECT_TRUE(folder.read("p.png") == folder.read("q.png"));
  EXPECT_GT(folder.read("p.png").size(), 100u);
}

TEST_F(SubmitCommand, WhatPartsTakeIsSaidAndTheyGoAfterTheMerge) {
  const std::string still = "submit --to openjd -- render toys --width 128 --samples 4 --denoise own --parts 4 -o ";
  ASSERT_EQ(run(still + folder.path("p.exr") + " --keep-parts"), 0) << err;
  std::smatch said;
  const std::string text = err;
  ASSERT_TRUE(std::regex_search(text, said, std::regex("parts take up to ([0-9.]+) MB on disk together, .* are free")))
      << err;
  const double maximum = 1e6 * std::stod(said[1]);
  EXPECT_NE(err.find("memory of a task: parts 0."), std::string::npos) << err;
  EXPECT_NE(err.find("GB, merge 0."), std::string::npos) << err;
  const json made = plan("p");
  EXPECT_NE(made["groups"][1]["memory"], made["memory"]);
  run_all(made);
  double bytes = 0.0;
  for (int part = 1; part <= 4; part++) {
    bytes +=
        static_cast<double>(std::filesystem::file_size(folder.path(fmt::format("p.exr.parts/part_{:04}.exr", part))));
  }
  EXPECT_LE(bytes, maximum);
  EXPECT_GT(bytes, 0.3 * maximum) << "an estimate, not any large number";
  ASSERT_EQ(run("merge " + folder.path("p.exr.parts/part_####.exr") + " --remove-parts -q -o " + folder.path("q.exr")),
            0)
      << err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("p.exr.parts/part_0001.exr")));
  ASSERT_EQ(run(still + folder.path("p.exr") + " --keep-parts"), 0) << err;
  EXPECT_NE(err.find("is finished"), std::string::npos) << err;
  ASSERT_EQ(run("submit --dry-run --memory 3 --to openjd -- render room --width 16384 --samples 64 --parts 64 -o " +
                folder.path("huge.exr")),
            0);
  EXPECT_NE(err.find("memory of a task: parts 3.0 GB, merge 3.0 GB"), std::string::npos) << err;
  EXPECT_NE(err.find("parts take up to "), std::string::npos) << err;
}

// Frames that are pictures have the exposure of the whole.
TEST_F(SubmitCommand, FramesAndViewsAreShared) {
  const std::string frames = "render toys --width 32 --samples 2 --frames 1-6x2 --env 3 -o ";
  ASSERT_EQ(run("submit -q --to flamenco --chunk 1 -- " + frames + folder.path("s.##.png")), 0) << err;
  EXPECT_EQ(plan("s")["groups"][0]["tasks"], 3);
  run_all(plan("s"));
  ASSERT_EQ(run(frames + folder.path("t.##.png")), 0) << err;
  for (const char* frame : {"01", "03", "05"}) {
    EXPECT_TRUE(folder.read(fmt::format("s.{}.png", frame)) == folder.read(fmt::format("t.{}.png", frame))) << frame;
  }
  ASSERT_EQ(run("rig -q --nearest 1 --width 64 -o " + folder.path("rig.json")), 0) << err;
  ASSERT_EQ(run("submit -q --to kubernetes --cpus 1 --mount / --chunk 20 -- render furnace --samples 1 --rig " +
                folder.path("rig.json") + " -o " + folder.path("views/0007/####.exr")),
            0)
      << err;
  run_all(json::parse(folder.read("views/0007/frames.farm/plan.json")));
  ASSERT_EQ(run("submit -q --to opencue --chunk 1 -- stitch " + folder.path("rig.json") + " " +
                folder.path("views/####/####.exr") + " --frames 7-7 -o " + folder.path("st.####.exr")),
            0)
      << err;
  run_all(plan("st"));
  EXPECT_GT(folder.read("st.0007.exr").size(), 100u);
  const std::string stitched = "submit -q --to openjd --chunk 1 -- video " + folder.path("./views/####/####.exr") +
                               " --rig " + folder.path("rig.json") + " --frames 7-7 -o " + folder.path("v.mp4");
  ASSERT_EQ(run(stitched), 0) << err;
  run_task(plan("v")["groups"][0], 1);
  ASSERT_EQ(run(stitched), 0) << err;  // the frame is that of this video
  EXPECT_GT(folder.read("v.mp4.frames/frame.000007.exr").size(), 100u);
  run_all(plan("v"));
  EXPECT_GT(folder.read("v.mp4").size(), 100u);
}

TEST_F(SubmitCommand, FramesThatBecomeFramesAreShared) {
  ASSERT_EQ(run("render -q toys --width 64 --samples 2 --frames 1-5 -o " + folder.path("in_TB.##.png")), 0) << err;
  ASSERT_EQ(run("title -q End --width 64 --at 0,0,2 -o " + folder.path("end.exr")), 0) << err;
  for (const std::string words : {"convert IN --to cube-3x2 --frames 2-5", "over end.exr IN --opacity 0.5"}) {
    std::string command = words;
    command.replace(command.find("IN"), 2, folder.path("in_TB.##.png"));
    if (const size_t at = command.find("end.exr"); at != std::string::npos) command.insert(at, folder.path(""));
    ASSERT_EQ(run("submit -q --to openjd --chunk 2 -- " + command + " -o " + folder.path("farm_TB.##.png")), 0) << err;
    const json group = plan("farm_TB")["groups"][0];
    EXPECT_EQ(group["tasks"], words.starts_with("convert") ? 2 : 3);
    run_task(group, group["tasks"]);
    const std::string last = folder.path("farm_TB.05.png");
    const auto made = std::filesystem::last_write_time(last);
    run_all(plan("farm_TB"));
    EXPECT_EQ(std::filesystem::last_write_time(last), made) << "what is there is not made again";
    ASSERT_EQ(run(command + " -o " + folder.path("one_TB.##.png")), 0) << err;
    for (const char* frame : {"02", "03", "04", "05"}) {
      const std::string farm = folder.path(fmt::format("farm_TB.{}.png", frame));
      EXPECT_TRUE(folder.read(fmt::format("farm_TB.{}.png", frame)) == folder.read(fmt::format("one_TB.{}.png", frame)))
          << words << frame;
      std::filesystem::remove(farm);
    }
    std::filesystem::remove(folder.path("farm_TB.01.png"));
  }
}

TEST_F(SubmitCommand, OtherCommandsAreOneTask) {
  ASSERT_EQ(run("render -q toys --width 64 --samples 4 --statistics -o " + folder.path("in.exr")), 0) << err;
  ASSERT_EQ(run("submit --to slurm -- denoise " + folder.path("in.exr") + " --threads 3 -o " + folder.path("a.png")), 0)
      << err;
  EXPECT_EQ(out, "7 denoise-1.sbatch ods:denoise:0\n");
  EXPECT_NE(err.find("a: denoise in one task"), std::string::npos) << err;
  EXPECT_EQ(plan("a")["cpus"], 3);
  run_all(plan("a"));
  ASSERT_EQ(run("denoise " + folder.path("in.exr") + " -o " + folder.path("b.png")), 0) << err;
  EXPECT_TRUE(folder.read("a.png") == folder.read("b.png"));
  ASSERT_EQ(run("submit -q --to flamenco -- lint " + folder.path("a.png") + " --layout top-bottom"), 0) << err;
  const std::vector<std::string> lint = {"lint", folder.path("a.png"), "--layout", "top-bottom"};
  EXPECT_EQ(plan("a")["groups"][0]["command"], lint);
  for (const std::string to : {"slurm", "openjd", "opencue", "kubernetes"}) {
    const std::string convert = "-- convert " + folder.path("in.exr") + " --to cube-3x2 -o " + folder.path(to + ".png");
    ASSERT_EQ(run("submit -q --cpus 2 --mount / --to " + to + " " + convert), 0) << err;
    EXPECT_EQ(plan(to)["groups"].size(), 1u);
  }
}

// The files that options name, except built-in lights and scenes. @: the folder.
TEST_F(SubmitCommand, ThePlanNamesEveryFile) {
  const std::string at = folder.path("");
  const auto placed = [&](const std::string& words) { return std::regex_replace(words, std::regex("@"), at); };
  for (const char* name : {"views", "out"}) std::filesystem::create_directory(at + name);
  ASSERT_EQ(run(placed("render -q furnace --width 32 --samples 1 --sidecar -o @in.png")), 0) << err;
  ASSERT_EQ(run(placed("render -q furnace --width 32 --samples 1 --eyes mono -o @map.exr")), 0) << err;
  ASSERT_EQ(run(placed("rig -q --nearest 1 --width 64 -o @rig.json")), 0) << err;
  struct Job {
    std::string words;
    std::set<std::string> paths;
  };
  const std::vector<Job> jobs = {
      {"video toys --env @map.exr --background 0,0.5,1 -o @v.mp4", {"input @map.exr", "output @v.mp4"}},
      {"video toys --env studio --background @map.exr -o @v.mp4", {"input @map.exr", "output @v.mp4"}},
      {"video toys --env sky:elevation=9 --confine @views -o @v.mp4", {"input @views", "output @v.mp4"}},
      {"video toys --merge-map @map.exr -o @v.mp4", {"input @map.exr", "output @v.mp4"}},
      {"render toys --parts 2 --head-tilt-map @map.exr -o @p.exr", {"input @map.exr", "output @p.exr"}},
      {"stitch @rig.json @views/####/#.exr --report @s.png -o @out/s.#.exr",
       {"input @rig.json", "input @views", "output @out", "output @s.png"}},
      {"convert @in.png --camera-file @in.camera.json --to cube-3x2 -o @c.png",
       {"input @in.png", "input @in.camera.json", "output @c.png"}}};
  for (const Job& job : jobs) {
    const bool frames = job.words.find("--parts") == std::string::npos && !job.words.starts_with("convert");
    const std::string submit = "submit -q --to openjd --chunk 1 -o @farm -- ";
    ASSERT_EQ(run(placed(submit + job.words + (frames ? " --frames 1-2" : ""))), 0) << job.words << "\n" << err;
    std::set<std::string> paths;
    const json made = json::parse(folder.read("farm/plan.json"));
    for (const json& path : made["paths"]) {
      paths.insert(path["use"].get<std::string>() + " " + path["path"].get<std::string>());
    }
    std::set<std::string> expected;
    for (const std::string& path : job.paths) expected.insert(placed(path));
    EXPECT_EQ(paths, expected) << job.words;
  }
}

TEST_F(SubmitCommand, WithoutAChunkTheFirstFrameIsMeasured) {
  ASSERT_EQ(run("submit --to slurm -- " + video() + " --frames 3-4 --keep-frames --denoise none"), 0) << err;
  EXPECT_NE(err.find("making frame 3 here"), std::string::npos) << err;
  EXPECT_GT(folder.read("a.mp4.frames/frame.000003.exr").size(), 100u);
  EXPECT_EQ(plan("a")["groups"][0]["tasks"], 2);
}

TEST_F(SubmitCommand, AJobHasTheNameOfWhatItMakes) {
  ASSERT_EQ(run("submit -q --to openjd --chunk 1 -o " + folder.path("bundle") + " -- " + video() + " --frames 1-2"), 0)
      << err;
  EXPECT_EQ(json::parse(folder.read("bundle/plan.json"))["name"], "a");
  EXPECT_EQ(json::parse(folder.read("bundle/template.json"))["name"], "a");
}

TEST_F(SubmitCommand, WhatTheDenoiserCostsIsSaid) {
  const std::string own = video() + " --denoise own";
  ASSERT_EQ(run("submit --to openjd --chunk 2 -- " + own + " --frames 1-20"), 0) << err;
  EXPECT_NE(err.find("20 frames in 10 tasks, then video; 90 % more frames are rendered"), std::string::npos) << err;
  EXPECT_NE(err.find("a larger --chunk needs fewer"), std::string::npos) << err;
  ASSERT_EQ(run("submit --to openjd --chunk 2 -- " + video() + " --denoise none --frames 1-20"), 0) << err;
  EXPECT_EQ(err.find("denoiser"), std::string::npos) << err;
  ASSERT_EQ(run("submit --to openjd -- " + own + " --frames 1-20"), 0) << err;  // chunks of eight
  EXPECT_EQ(plan("a")["groups"][0]["tasks"], 3) << err;
}

TEST_F(SubmitCommand, AFinishedVideoIsNotMadeAgain) {
  namespace fs = std::filesystem;
  ods::TemporaryFolder source;
  const std::string scene = source.path("scene.gltf"), note = folder.path("a.farm/plan.json");
  source.write("scene.gltf", kTriangle);
  const auto submit = [&](const std::string& more) {
    EXPECT_EQ(run("submit --to slurm --chunk 2 -- video " + scene + " --width 32 --frames 1-2 --denoise none -o " +
                  folder.path("a.mp4 ") + more),
              0)
        << err;
    EXPECT_EQ(out.empty(), err.find("a.mp4' is finished") != std::string::npos) << out << err;
    return out.empty() ? "finished" : "sent";
  };
  const auto make_older = [](const std::string& file) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  };
  make_older(scene);
  EXPECT_STREQ(submit("--samples 1"), "sent");
  run_all(plan("a"));
  EXPECT_STREQ(submit("--samples 1"), "finished");
  EXPECT_STREQ(submit("--samples 1 --threads 2"), "finished");
  EXPECT_FALSE(fs::exists(folder.path("a.mp4.frames")));
  EXPECT_STREQ(submit("--samples 1 --restart"), "sent");
  make_older(note);
  EXPECT_STREQ(submit("--samples 1"), "finished");
  fs::last_write_time(scene, fs::file_time_type::clock::now());
  EXPECT_STREQ(submit("--samples 1"), "sent") << "the scene is another one";
  make_older(scene), make_older(note);
  EXPECT_STREQ(submit("--samples 2"), "sent") << "that is another video";
}

// A folder in the place of a frame is not a frame of ours; only the task that makes the frame checks it.
TEST_F(SubmitCommand, ATaskLooksAtItsOwnFramesOnly) {
  ASSERT_EQ(run("submit -q --to openjd --chunk 2 -- " + video() + " --denoise none --frames 1-8"), 0) << err;
  std::filesystem::create_directories(folder.path("a.mp4.frames/frame.000007.exr"));
  const std::string task = video() + " --denoise none --frames 1-8 --only ";
  EXPECT_EQ(run(task + "1/4"), 0) << err;
  EXPECT_EQ(run(task + "4/4"), 2);
  EXPECT_NE(err.find("frame.000007.exr' is not a frame of this video"), std::string::npos) << err;
}

TEST_F(SubmitCommand, DryRunsWriteNothing) {
  for (const char* to : {"slurm", "openjd", "opencue", "flamenco", "kubernetes"}) {
    ASSERT_EQ(
        run(fmt::format("submit --to {} --cpus 2 --mount / --dry-run --chunk 5 --copy-scene -- {} --frames 1-1000", to,
                        video())),
        0)
        << err;
    EXPECT_NE(out.find("\"tasks\": 200"), std::string::npos) << out;
    EXPECT_NE(out.find("# " + folder.path("a.farm/plan.json")), std::string::npos) << out;
    EXPECT_EQ(files(), 0u);
  }
}

TEST_F(SubmitCommand, ArraysAreAsLongAsTheClusterTakes) {
  ASSERT_EQ(run("submit --to slurm --chunk 1 -- " + video() + " --frames 1-12"), 0) << err;
  EXPECT_EQ(out,
            "7 frames-1.sbatch ods:frames:0\n8 frames-2.sbatch ods:frames:5\n9 frames-3.sbatch ods:frames:10\n"
            "10 video-1.sbatch ods:video:0\n");
  EXPECT_EQ(run("submit --to slurm --chunk 1 -- " + video("b.mp4") + " --frames 1-2000"), 2);
  EXPECT_NE(err.find("MaxJobCount of 100"), std::string::npos) << err;
}

TEST_F(SubmitCommand, TheSceneIsCopiedWithWhatLiesBesideIt) {
  ods::TemporaryFolder source;
  std::filesystem::create_directory(source.path("maps"));
  source.write("scene.gltf",
               R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "maps/data.bin"}]})");
  const std::string job = "submit --to openjd --chunk 1 --copy-scene -- video " + source.path("scene.gltf") +
                          " --frames 1-2 --width 32 --samples 1 -o " + folder.path("a.mp4");
  EXPECT_EQ(run(job), 3);
  EXPECT_NE(err.find("data.bin': no such file"), std::string::npos) << err;
  EXPECT_EQ(files(), 0u);
  const std::array<float, 9> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  source.write("maps/data.bin", {reinterpret_cast<const char*>(corners.data()), sizeof(corners)});
  ASSERT_EQ(run(job), 0) << err;
  EXPECT_EQ(folder.read("a.farm/inputs/maps/data.bin").size(), 36u);
  EXPECT_EQ(plan("a")["groups"][0]["command"][1], folder.path("a.farm/inputs/scene.gltf"));
  const json values = json::parse(folder.read("a.farm/parameter_values.json"));
  EXPECT_NE(values.dump().find("\"value\":\"inputs/scene.gltf\""), std::string::npos) << values;
  std::filesystem::remove(source.path("scene.gltf"));
  run_all(plan("a"));
}

TEST_F(SubmitCommand, BadOptionsAreOneLineAndLeaveNothing) {
  struct Fault {
    std::string words;
    int code;
    std::string says;
  };
  const std::string at = folder.path("");
  const std::vector<Fault> faults = {
      {"submit -- video toys -o " + at + "a.mp4", 2, "--to slurm|openjd"},
      {"submit --to slurm", 2, "no command"},
      {"submit --to lsf -- video toys", 2, "'lsf'"},
      {"submit --to slurm video toys -o " + at + "a.mp4", 2, "'video' belongs after --"},
      {"submit --to slurm -- vidoe toys", 2, "did you mean 'video'"},
      {"submit --to slurm -- convert a.png -o b.png", 3, "a.png"},
      {"submit --to slurm -- video toys -o " + at + "a.mp4 --widht 5", 2, "--widht"},
      {"submit --to slurm -- video absent.glb --frames 1-2 -o " + at + "a.mp4", 3, "absent.glb"},
      {"submit --to slurm -- video toys --audio absent.wav -o " + at + "a.mp4", 3, "absent.wav"},
      {"submit --to slurm -- video toys --env absent.hdr --frames 1-2 -o " + at + "a.mp4", 3, "absent.hdr"},
      {"submit --to slurm -- video toys -o /proc/a.mp4", 4, "/proc"},
      {"submit --to slurm -- video toys --frames 1-2 --only 1 -o " + at + "a.mp4", 2, "--only"},
      {"submit --to slurm -- render toys -o " + at + "a.png", 2, "--parts N"},
      {"submit --to slurm -- render toys --parts 4 --noise 0.1 -o " + at + "a.png", 2, "--noise"},
      {"submit --to slurm -- render toys --parts 9 --samples 4 -o " + at + "a.png", 2,
       "4 samples cannot be split into 9 parts"},
      {"submit --to slurm --sbatch partition -- render toys --parts 4 -o " + at + "a.png", 2, "--sbatch"},
      {"submit --to kubernetes --cpus 1 --chunk 1 --mount /x -- video toys --frames 1-2 -o " + at + "a.mp4", 2,
       "--mount"},
      {"submit --to openjd --copy-scene -- video toys --confine / --frames 1-2 -o " + at + "a.mp4", 2, "--confine"},
      {"submit --to slurm -- view " + at, 2, "one of video, render, stitch, convert"},
      {"submit --to slurm -- convart a.png -o " + at + "b.png", 2, "convert"},
      {"submit --to slurm -- denoise absent.exr -o " + at + "b.exr", 3, "absent.exr"},
      {"submit --to slurm -- encode " + at + "#.png -o " + at + "b.mp4 --only 1", 2, "--only"},
      {"convert a.png -o " + at + "b.png --only 1/2", 3, "a.png"},
      {"over a.png b.png -o " + at + "c.png --skip-existing", 2, "frames that become frames"},
      {"render toys --parts 4 -o " + at + "a.png", 2, "ods submit"},
      {"jobs nothing", 3, "no job 'nothing'"},
  };
  for (const Fault& fault : faults) {
    EXPECT_EQ(run(fault.words), fault.code) << fault.words << "\n" << err;
    const size_t start = err.rfind("ods: error: ");
    ASSERT_NE(start, std::string::npos) << fault.words << "\n" << err;
    EXPECT_NE(err.find(fault.says, start), std::string::npos) << fault.words << "\n" << err;
    EXPECT_EQ(err.find('\n', start), err.size() - 1) << err;
    EXPECT_EQ(files(), 0u) << fault.words;
  }
}

TEST_F(SubmitCommand, ALineBreakInANameIsRefused) {
  Ods submit({"submit", "--to", "openjd", "--chunk", "1", "--", "video", "toys", "--frames", "1-2", "-o",
              folder.path("a\nb.mp4")});
  EXPECT_EQ(submit.finish(), 2);
  EXPECT_NE(submit.err.find("line break"), std::string::npos) << submit.err;
  EXPECT_EQ(files(), 0u);
}

TEST_F(SubmitCommand, NoTaskChangesItsInput) {
  folder.write("film.mp4", "a film");
  const std::string tag = "submit --to openjd -- inject " + folder.path("film.mp4") + " --layout top-bottom";
  EXPECT_EQ(run(tag), 2);
  EXPECT_NE(err.find("-o"), std::string::npos) << err;
  EXPECT_EQ(run(tag + " -o " + folder.path("tagged.mp4")), 0) << err;
}

TEST_F(SubmitCommand, PartsOfAnotherPictureAreNotTakenForOurs) {
  const std::string still = "submit -q --to openjd -- render toys --width 32 --parts 2 -o " + folder.path("p.exr");
  ASSERT_EQ(run(still + " --samples 4"), 0) << err;
  run_task(plan("p")["groups"][0], 2);
  ASSERT_EQ(run(still + " --samples 4"), 0) << err;
  EXPECT_EQ(run(still + " --samples 8"), 2);
  EXPECT_NE(err.find("part_0002.exr' was made with other options: --samples was 4, now 8"), std::string::npos) << err;
}

// The last command of a video, on another machine than its frames.
TEST_F(SubmitCommand, FramesThatAreLateAreWaitedFor) {
  ASSERT_EQ(run("submit -q --to openjd --chunk 1 -- " + video() + " --denoise none --frames 1-2 --keep-frames"), 0)
      << err;
  const json groups = plan("a")["groups"];
  run_task(groups[0], 1);
  std::vector<std::string> last = groups[1]["command"];
  EXPECT_EQ(last.at(last.size() - 2), "--wait");
  last.back() = "3600";
  Ods whole(last);
  whole.wait_for("waiting up to 3600 s for 1 missing frames");
  run_task(groups[0], 2);
  EXPECT_EQ(whole.finish(), 0) << whole.err;
  EXPECT_NE(whole.err.find("2 of 2 frames exist already"), std::string::npos) << whole.err;
}

TEST_F(SubmitCommand, WithoutSlurmItIsSaid) {
  program("squeue", "echo 'slurm_load_jobs error: no controller' >&2\nexit 1");
  EXPECT_EQ(run("submit --to slurm -- " + video()), 3);
  EXPECT_NE(err.find("there is no Slurm here: squeue failed: slurm_load_jobs error: no controller"), std::string::npos)
      << err;
  EXPECT_EQ(files(), 0u);
  EXPECT_EQ(run("jobs"), 3);
  EXPECT_NE(err.find("there is no Slurm here"), std::string::npos) << err;
}

TEST_F(SubmitCommand, WhatIsInTheQueueIsNotSentAgain) {
  ASSERT_EQ(run("submit -q --to slurm --chunk 4 -- " + video() + " --frames 1-8"), 0) << err;
  tools.write("queue", "7|1|RUNNING|0:05|one|ods:frames:0:" + folder.path("a.farm") + "\n");
  EXPECT_EQ(run("submit --to slurm --chunk 4 -- " + video() + " --frames 1-8"), 2);
  EXPECT_NE(err.find("tasks in the queue, job 7"), std::string::npos) << err;
  tools.write("queue", "7|1|CANCELLED|0:05||ods:frames:0:" + folder.path("a.farm") + "\n");
  EXPECT_EQ(run("submit --to slurm --chunk 4 -- " + video() + " --frames 1-8"), 0) << err;
}

TEST_F(SubmitCommand, WhatSlurmRefusesIsAnError) {
  program("sbatch", "echo 'sbatch: error: no partition' >&2; exit 1");
  EXPECT_EQ(run("submit --to slurm --chunk 4 -- " + video() + " --frames 1-8"), 4);
  EXPECT_NE(err.find("sbatch: error: no partition"), std::string::npos) << err;
}

}  // namespace ods::farm_command_test
