// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods video: frames that are kept, shared and resumed.
#include <iterator>
#include <sstream>

#include "tests/support/video_fixture.h"

namespace ods::cli_video_test {

using VideoCommand = Video;

TEST_F(VideoCommand, OneCommandMakesATaggedVideoAndCleansUp) {
  ASSERT_EQ(run(words("video_360_TB.mp4", "--fps 25")), 0) << err;
  EXPECT_EQ(out, folder.path("video_360_TB.mp4") + "\n");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"video_360_TB.mp4"});
  const ods::VideoFile video = ods::read_video_file(folder.path("video_360_TB.mp4"));
  ASSERT_EQ(video.tracks.size(), 1u);
  EXPECT_EQ(metadata_text(*video.tracks[0].v1), "top-bottom, lat-long");
  EXPECT_EQ(metadata_text(*video.tracks[0].v2), "top-bottom, lat-long");
  EXPECT_EQ(video.tracks[0].fps, 25.0);
  EXPECT_EQ(video.tracks[0].size.height, 32);
}

TEST_F(VideoCommand, FormsOfFrames) {
  ASSERT_EQ(run(words("a_180_LR.mkv", "--projection vr180")), 0) << err;
  EXPECT_EQ(metadata_text(*ods::read_video_file(folder.path("a_180_LR.mkv")).tracks[0].v2),
            "side-by-side, lat-long 180x180");
  ASSERT_EQ(run(words("b_360.mp4", "--eyes mono --grain changing --turntable 1")), 0) << err;
  EXPECT_EQ(metadata_text(*ods::read_video_file(folder.path("b_360.mp4")).tracks[0].v2), "mono, lat-long");
}

// Misleading metadata are removed; the metadata of the new video are added.
TEST_F(VideoCommand, ANameThatPlayersUnderstandIsProposed) {
  const std::tuple<const char*, const char*, const char*> kCases[] = {
      {"a_180.mp4", "", "a_360_TB.mp4"},
      {"a_180_LR.mp4", "", "a_360_TB.mp4"},
      {"a_LR_180.mp4", "--layout side-by-side", "a_360_LR.mp4"},
      {"a_360.mp4", "--projection vr180", "a_180_LR.mp4"},
      {"a_360_TB.mp4", "--eyes mono", "a_360.mp4"},
      {"a.mp4", "", "a_360_TB.mp4"},
      {"a_360_TB.mp4", "", ""},
      {"a_TB.mp4", "", ""},
      {"a_180_LR.mp4", "--projection vr180", ""},
      {"a.mp4", "--eyes mono --grain changing --turntable 1", ""},
  };
  for (const auto& [name, options, proposed] : kCases) {
    ASSERT_EQ(run(words(name, options)), 0) << err;
    const size_t at = err.find("would recognise ");
    if (!*proposed) {
      EXPECT_EQ(at, std::string::npos) << name << options << err;
      continue;
    }
    ASSERT_NE(at, std::string::npos) << name << options << err;
    EXPECT_EQ(err.substr(at + 16, err.find('\n', at) - at - 16), proposed) << options;
    EXPECT_EQ(err.find("would recognise ", at + 1), std::string::npos) << "once";
    EXPECT_EQ(err.find("players differ"), err.rfind("players differ")) << "once";
  }
}

TEST_F(VideoCommand, FramesAreKeptWhereAskedAndUsedAgain) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  ASSERT_EQ(folder.names(), (std::vector<std::string>{"a.mp4", "a.mp4.frames"}));
  const std::string video = folder.read("a.mp4");
  // Another packing of the same frames, and more of them.
  ASSERT_EQ(run(words("a.mp4", "--keep-frames --tone linear --frames 1-5")), 0) << err;
  EXPECT_NE(err.find("4 of 5 frames exist already"), std::string::npos) << err;
  EXPECT_NE(folder.read("a.mp4"), video);
  ASSERT_EQ(run("encode " + folder.path("a.mp4.frames/frame.######.exr") + " --codec h264 --frames 1-4 -o " +
                folder.path("b.mp4")),
            0)
      << err;
  EXPECT_EQ(folder.read("b.mp4"), video);
}

// Frames whose pixels stop when they are clean belong to the exposure at which they were judged; others to none.
TEST_F(VideoCommand, FramesJudgedAtAnotherExposureAreNotMixedIn) {
  const auto video = [&](const std::string& more) {
    return "video toys --width 16 --samples 64 --denoise none --keep-frames --frames 1-2 -o " + folder.path("a.mp4") +
           " " + more;
  };
  ASSERT_EQ(run(video("--noise 0.05")), 0) << err;
  EXPECT_EQ(run(video("--noise 0.05 --exposure 4")), 2);
  EXPECT_NE(err.find("--exposure was 0, now 4; --restart"), std::string::npos) << err;
  ASSERT_EQ(run(video("--noise none --restart")), 0) << err;
  const std::string first = folder.read("a.mp4");
  ASSERT_EQ(run(video("--noise none --exposure 4")), 0) << err;
  EXPECT_NE(folder.read("a.mp4"), first);
  // An exposure that a first look has found holds for frames that are added.
  ASSERT_EQ(run(video("--noise 0.05 --env 0.05 --restart")), 0) << err;
  EXPECT_NE(err.find(" stops, from a first look"), std::string::npos) << err;
  ASSERT_EQ(run(video("--noise 0.05 --env 0.05 --frames 1-4")), 0) << err;
  EXPECT_NE(err.find(" stops, as in the existing frames"), std::string::npos) << err;
}

// Frames beside a missing one are rendered again, for its sake.
TEST_F(VideoCommand, DenoisedFramesDrawOnEachOtherAndNotOnInterruptions) {
  const auto path = [&](int number) { return folder.path(fmt::format("a.mp4.frames/frame.{:06}.exr", number)); };
  const auto read = [&](int number) { return folder.read(fmt::format("a.mp4.frames/frame.{:06}.exr", number)); };
  for (const std::string grain : {"fixed", "changing"}) {
    const auto job = [&](const std::string& more) {
      return "video toys --width 32 --samples 4 --turntable 30 --keep-frames -o " + folder.path("a.mp4") + " --grain " +
             grain + " " + more;
    };
    ASSERT_EQ(run(job("--frames 1-4 --restart")), 0) << err;
    std::vector<std::string> frames;
    for (int number = 1; number <= 4; number++) frames.push_back(read(number));
    std::filesystem::remove(path(1));
    std::filesystem::remove(path(3));
    ASSERT_EQ(run(job("--frames 1-4")), 0) << err;
    EXPECT_NE(err.find("2 of 4 frames exist already"), std::string::npos) << err;
    for (int number = 1; number <= 4; number++) EXPECT_TRUE(read(number) == frames[static_cast<size_t>(number - 1)]);
    ASSERT_EQ(run(job("--frames 2 --restart")), 0) << err;
    EXPECT_FALSE(read(2) == frames[1]) << "on its own";
  }
}

TEST_F(VideoCommand, FramesOfAnotherJobAreNotMixedIn) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  const std::string video = folder.read("a.mp4");
  EXPECT_EQ(run(words("a.mp4", "--samples 2")), 2);
  for (const char* part : {"a.mp4.frames' was made with other options: ", "--samples was 1, now 2; ", "; --restart"}) {
    EXPECT_NE(err.find(part), std::string::npos) << part << "\n" << err;
  }
  EXPECT_EQ(folder.read("a.mp4"), video);
  ASSERT_EQ(run(words("a.mp4", "--samples 2 --restart")), 0) << err;
  EXPECT_NE(folder.read("a.mp4"), video);
  EXPECT_EQ(files(), 1u);
  std::filesystem::create_directory(folder.path("b.mp4.frames"));
  folder.write("b.mp4.frames/diary.txt", "mine");
  EXPECT_EQ(run(words("b.mp4")), 2);
  EXPECT_EQ(run(words("b.mp4", "--restart")), 0) << err;
  EXPECT_EQ(folder.read("b.mp4.frames/diary.txt"), "mine");
}

// A truncated note is reported as damaged, not as made with other options, and the frames stay.
TEST_F(VideoCommand, ACutNoteIsDamaged) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  const std::string note = folder.read("a.mp4.frames/job.txt");
  const std::string frame = folder.read("a.mp4.frames/frame.000001.exr");
  std::string changed = note;
  changed[note.size() / 2] ^= 1;
  for (const std::string& damaged :
       {std::string(), note.substr(0, 10), note.substr(0, 27), note.substr(0, note.size() / 2),
        note.substr(0, note.size() - 1), note + "x", changed}) {
    folder.write("a.mp4.frames/job.txt", damaged);
    EXPECT_EQ(run(words("a.mp4")), 3) << damaged.size();
    EXPECT_NE(err.find("a.mp4.frames/job.txt' is damaged: remove '"), std::string::npos) << err;
    EXPECT_EQ(folder.read("a.mp4.frames/frame.000001.exr"), frame);
  }
  folder.write("a.mp4.frames/job.txt", note);
  EXPECT_EQ(run(words("a.mp4")), 0) << err;
}

TEST_F(VideoCommand, TheSceneIsOfTheJob) {
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --eyes mono -q -o " + folder.path("sky.png")), 0) << err;
  const std::string video = words("a.mp4", "--keep-frames --env " + folder.path("sky.png"));
  ASSERT_EQ(run(video), 0) << err;
  ASSERT_EQ(run(video), 0) << err;
  EXPECT_NE(err.find("4 of 4 frames exist already"), std::string::npos) << err;
  ASSERT_EQ(run("render furnace --width 32 --samples 1 --eyes mono -q -o " + folder.path("sky.png")), 0) << err;
  EXPECT_EQ(run(video), 2);
  EXPECT_NE(err.find("--env '" + folder.path("sky.png") + "' has changed"), std::string::npos) << err;
}

// The files of a scene are known by what is in them, wherever they lie and however old they are.
TEST_F(VideoCommand, ACopyOfTheSceneIsTheSameSceneAndAChangedFileIsNamed) {
  ods::GltfBuilder scene = ods::make_triangle();
  scene.json["images"] = ods::GltfJson::parse(R"([{"uri": "wood%20panel.png"}])");
  scene.json["textures"] = ods::GltfJson::parse(R"([{"source": 0}])");
  scene.json["materials"] = ods::GltfJson::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  scene.primitive()["material"] = 0;
  scene.json["buffers"] = {{{"byteLength", scene.binary.size()}, {"uri", "shape.bin"}}};
  const ods::Binary png = ods::small_png();
  const auto write = [&](const std::string& to) {
    std::filesystem::create_directory(folder.path(to));
    folder.write(to + "/scene.gltf", scene.json.dump());
    folder.write(to + "/shape.bin", {scene.binary.begin(), scene.binary.end()});
    folder.write(to + "/wood panel.png", {png.begin(), png.end()});
  };
  const auto video = [&](const std::string& from) {
    return run("video " + folder.path(from) + "/scene.gltf --width 16 --samples 1 --frames 1-2 --keep-frames -o " +
               folder.path("a.mp4"));
  };
  write("one"), write("two");
  ASSERT_EQ(video("one"), 0) << err;
  ASSERT_EQ(video("two"), 0) << err;
  EXPECT_NE(err.find("2 of 2 frames exist already"), std::string::npos) << err;
  scene.binary[0] ^= 1;
  write("two");
  EXPECT_EQ(video("two"), 2);
  EXPECT_NE(err.find("SCENE's file shape.bin '" + folder.path("two/shape.bin") + "' has changed"), std::string::npos)
      << err;
  scene.binary[0] ^= 1;
  write("two");
  folder.write("two/wood panel.png", "x");
  EXPECT_EQ(video("two"), 2);
  EXPECT_NE(err.find("wood panel.png' has changed"), std::string::npos) << err;
  write("two");
  EXPECT_EQ(video("two"), 0) << err;
}

TEST_F(VideoCommand, OneProcessAtATimeMakesAVideo) {
  const std::vector<std::string> job = {"video", "toys",     "--width", "32", "--samples",
                                        "64",    "--frames", "1-4",     "-o", folder.path("a.mp4")};
  Ods first(job);
  first.wait_for("to render: ");
  first.kill(SIGSTOP);  // so that it is at work for as long as we like
  for (const std::string other : {"", "--samples 2 --restart", "--crf 30 --keep-frames"}) {
    EXPECT_EQ(run(words("a.mp4", other)), 4) << err;
    const std::string who = "another ods is at work on '" + folder.path("a.mp4") + "': process " +
                            std::to_string(first.process()) + " on '";
    EXPECT_NE(err.find(who), std::string::npos) << err;
    EXPECT_NE(err.find(", since 20"), std::string::npos) << err;
  }
  first.kill(SIGCONT);
  EXPECT_EQ(first.finish(), 0) << first.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.mp4"});
  Ods killed(job);
  killed.wait_for("to render: ");
  killed.kill(SIGKILL);
  killed.finish();
  EXPECT_EQ(run(words("a.mp4", "--samples 64")), 0) << "the dead hold nothing: " << err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.mp4"});
  Ods interrupted(job);
  interrupted.wait_for("to render: ");
  interrupted.kill(SIGTERM);
  EXPECT_EQ(interrupted.finish(), 128 + SIGTERM);
  EXPECT_FALSE(std::filesystem::exists(folder.path(".a.mp4.claim")));
}

TEST_F(VideoCommand, FramesBehindALinkAreNotOurs) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  std::filesystem::rename(folder.path("a.mp4.frames"), folder.path("precious"));
  std::filesystem::create_directory_symlink(folder.path("precious"), folder.path("a.mp4.frames"));
  for (const std::string more : {"", "--restart", "--restart --samples 2"}) {
    EXPECT_EQ(run(words("a.mp4", more)), 2) << err;
    EXPECT_NE(err.find("it is a link"), std::string::npos) << err;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path("precious")), {}), 5);
}

TEST_F(VideoCommand, FramesThatNoJobOfOursMadeStay) {
  ASSERT_EQ(run(words("a.mp4", "--keep-frames")), 0) << err;
  folder.write("a.mp4.frames/frame.000005.exr", "mine");
  ASSERT_EQ(run(words("a.mp4", "--keep-frames --restart --samples 2")), 0) << err;
  EXPECT_EQ(folder.read("a.mp4.frames/frame.000005.exr"), "mine");
  EXPECT_EQ(run(words("a.mp4", "--samples 2 --frames 1-5")), 2);
  EXPECT_NE(err.find("frame.000005.exr' is not a frame of this video"), std::string::npos) << err;
  ASSERT_EQ(run(words("a.mp4", "--samples 2")), 0) << err;
  EXPECT_EQ(folder.read("a.mp4.frames/frame.000005.exr"), "mine");
  // A folder without our note: nothing in it is taken for a frame, nothing is written through a link.
  std::filesystem::create_directory(folder.path("b.mp4.frames"));
  folder.write("b.mp4.frames/frame.000002.exr", "mine");
  EXPECT_EQ(run(words("b.mp4", "--restart")), 2);
  EXPECT_EQ(folder.read("b.mp4.frames/frame.000002.exr"), "mine");
  folder.write("victim", "mine");
  std::filesystem::create_directory(folder.path("c.mp4.frames"));
  std::filesystem::create_symlink(folder.path("victim"), folder.path("c.mp4.frames/job.txt"));
  EXPECT_EQ(run(words("c.mp4", "--restart")), 2);
  EXPECT_EQ(folder.read("victim"), "mine");
}

// Noise, which no file makes small: 0.4 MB a frame before compression.
const std::string kNoisyFrames =
    "video room --width 256 --samples 1 --denoise none --frames 1-6 --grain changing --indirect path -o ";

TEST_F(VideoCommand, WhatTheDiskCannotHoldIsNotBegun) {
  const ods::TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: a small tmpfs can only be mounted by root with CAP_SYS_ADMIN";
  EXPECT_EQ(run(kNoisyFrames + disk.folder().path("a.mp4")), 4) << err;
  EXPECT_NE(err.find("error: the frames need about "), std::string::npos) << err;
  EXPECT_NE(err.find(" MB in '" + disk.folder().path("a.mp4.frames") + "'; "), std::string::npos) << err;
  EXPECT_NE(err.find("or render them anyway with --force"), std::string::npos) << err;
  EXPECT_TRUE(disk.folder().names().empty()) << "nothing is left of the look";
  EXPECT_EQ(run(kNoisyFrames + disk.folder().path("a.mp4") + " --force"), 4) << err;
  EXPECT_NE(err.find("warning: the frames need about "), std::string::npos) << err;
  EXPECT_EQ(err.find("or render them anyway with --force"), std::string::npos) << "until it is full: " << err;
}

// The pattern stands for what the files have: a fifth more or less.
TEST_F(VideoCommand, TheRoomThatFramesNeedIsKnownBeforeTheyAre) {
  ASSERT_EQ(run(kNoisyFrames + folder.path("a.mp4") + " --keep-frames"), 0) << err;
  const size_t at = err.find("the frames need about ");
  ASSERT_NE(at, std::string::npos) << err;
  double bytes = 0.0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path("a.mp4.frames"))) {
    bytes += static_cast<double>(file.file_size());
  }
  EXPECT_NEAR(std::stod(err.substr(at + 22)) * 1e6 / bytes, 1.0, 0.2) << err << bytes;
}

// Days are told in seconds, from what was measured.
TEST_F(VideoCommand, ALongRenderingIsKnownAndWhatWouldBeFaster) {
  Ods command({"video", "toys", "--width", "64", "--samples", "128", "--noise", "none", "--frames", "1-80000", "-o",
               folder.path("a.mp4")});
  command.wait_for("faster: ");
  command.kill(SIGTERM);
  EXPECT_EQ(command.finish(), 128 + SIGTERM) << command.err;
  EXPECT_NE(command.err.find(" h, "), std::string::npos) << command.err;
  EXPECT_NE(command.err.find(" for each frame, by a first look\n"), std::string::npos) << command.err;
  EXPECT_NE(command.err.find("faster: --width 32 for a quarter of the time, --time-limit "), std::string::npos)
      << command.err;
  EXPECT_EQ(command.err.find(".look-"), std::string::npos) << command.err;
  if (std::filesystem::exists(folder.path("a.mp4.frames"))) {
    for (const auto& file : std::filesystem::directory_iterator(folder.path("a.mp4.frames"))) {
      EXPECT_FALSE(file.path().filename().native().starts_with(".look")) << file.path();
    }
  }
}

// However often it is killed, wherever: at last there is the video of an undisturbed run.
TEST_F(VideoCommand, AKilledVideoResumes) {
  const std::string more = "--samples 256 --frames 1-12";
  ASSERT_EQ(run(words("whole.mp4", "-q " + more)), 0) << err;
  std::istringstream stream(words("killed.mp4", more + " --progress json"));
  const std::vector<std::string> job{std::istream_iterator<std::string>(stream), {}};
  for (const char* line : {"players that rely", "to render: ", "\"progress\":0.2", "\"progress\":0.7"}) {
    Ods command(job);
    command.limit_unread();  // 0.3 of the job report more than that: it cannot end before it is killed
    command.wait_for(line);
    command.kill(SIGKILL);
    EXPECT_EQ(command.finish(), 1000 + SIGKILL) << line << "\n" << command.err;
  }
  ASSERT_EQ(run(words("killed.mp4", more)), 0) << err;
  EXPECT_NE(err.find(" of 12 frames exist already"), std::string::npos) << err;
  EXPECT_EQ(folder.read("killed.mp4"), folder.read("whole.mp4"));
  EXPECT_EQ(files(), 2u);
}

TEST_F(VideoCommand, ImpossibleOptionsFailBeforeAnythingIsRendered) {
  const std::tuple<std::string, int, const char*> kCases[] = {
      {words("a.avi"), 2, "ends in .mp4"},
      {words("a.mp4", "--codec prores"), 2, "not prores, which goes into mov, mkv"},
      {words("a.mp4", "--layout anaglyph"), 2, "a video's layout is top-bottom or side-by-side"},
      {words("a.mp4", "--time 3"), 2, "--frames"},
      {words("a.mp4", "--width 30"), 2, "must be even"},
      {words("a.mp4", "--audio " + folder.path("none.wav")), 3, "no such file"},
      {"video room --width 32 -o " + folder.path("a.mp4"), 2, "the scene has no animation: add --duration SECONDS"},
      {"video none.glb --width 32 -o " + folder.path("a.mp4"), 3, "none.glb"},
  };
  for (const auto& [command, code, why] : kCases) {
    EXPECT_EQ(run(command), code) << command << err;
    EXPECT_NE(err.find(why), std::string::npos) << err;
    EXPECT_EQ(files(), 0u) << command;
  }
}

}  // namespace ods::cli_video_test
