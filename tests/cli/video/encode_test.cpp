// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods encode as its users meet it.
#include "ods/video/encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ods/video/container/video_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/made_frames.h"
#include "tests/support/programs.h"

namespace ods::encode_command_test {

using ods::Layout;

class EncodeCommand : public Cli {
 protected:
  std::string pattern(const std::string& name = "a.#.png") const { return folder.path(name); }

  void expect_one_line(const std::string& words) const {
    EXPECT_EQ(out, "");
    EXPECT_TRUE(err.starts_with("ods: error: ")) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_NE(err.find(words), std::string::npos) << err;
  }
};

TEST_F(EncodeCommand, FramesBecomeAVideo) {
  ods::made::write_frames(pattern(), {1, 2, 3});
  const std::string video = folder.path("video_360_TB.mp4");
  ASSERT_EQ(run("encode " + pattern() + " --codec h264 --fps 29.97 -o " + video), 0) << err;
  EXPECT_EQ(out, video + "\n");
  EXPECT_NE(err.find("h264, 8 bits, 420, level 1.1, 128x128, 3 frames at 29.97 a second"), std::string::npos) << err;
  EXPECT_NE(err.find("top-bottom: it has the shape of two eyes"), std::string::npos) << err;
  EXPECT_EQ(err.find("warning"), std::string::npos) << err;
}

// FFmpeg's test picture moves in many ways: x265 finds other motion in it with other threads, if it may. Without /sys,
// as in some containers, libnuma counts no processors.
TEST_F(EncodeCommand, HevcHasTheSameBytesWhateverThreadsAndWithoutSys) {
  if (!ods::has_encoder("libx265")) GTEST_SKIP() << "skipped: this machine encodes no HEVC";
  const std::string frames = "ffmpeg -v error -f lavfi -i testsrc2=size=640x640 -frames:v 30 " + pattern("a.%d.png");
  if (const std::string why = ods::missing("ffmpeg", frames); !why.empty()) GTEST_SKIP() << why;
  const auto encode = [&](int threads, const std::string& in = "") {
    const ods::Ran ran =
        ods::run_line(fmt::format("{} '{}' encode {} -q --layout mono --codec hevc --threads {} -o {}", in,
                                  ods::ods_command(), pattern(), threads, folder.path("video.mp4")));
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, "");
    return folder.read("video.mp4");
  };
  const std::string video = encode(1);
  EXPECT_TRUE(encode(5) == video);
  const std::string hidden = "unshare --map-root-user --mount sh -c 'mount -t tmpfs none /sys && exec \"$@\"' sh";
  if (ods::run_line(hidden + " true").code != 0) GTEST_SKIP() << "skipped: nothing hides /sys here";
  EXPECT_TRUE(encode(0, hidden) == video);
}

TEST_F(EncodeCommand, TheSoundOfAnExistingVideoCanBeTaggedAsAmbisonics) {
  ods::made::write_frames(pattern(), {1, 2, 3, 4, 5, 6});
  folder.write("sound.wav", ods::made::wav(4, 0.2));
  const std::string video = folder.path("video.mov"), encode = "encode -q " + pattern() + " --codec h264 -o ";
  ASSERT_EQ(run(encode + video + " --audio " + folder.path("sound.wav")), 0) << err;
  const std::string said = folder.read("video.mov");
  std::string unsaid = said;
  unsaid.replace(unsaid.find("SA3D"), 4, "free");
  folder.write("video.mov", unsaid);
  EXPECT_FALSE(ods::read_video_file(video).sound.at(0).ambisonics);
  ASSERT_EQ(run("inject --ambisonics --layout top-bottom --projection lat-long " + video), 0) << err;
  EXPECT_TRUE(ods::read_video_file(video).sound.at(0).ambisonics);
  ASSERT_EQ(run(encode + video), 0) << err;
  EXPECT_EQ(run("inject --ambisonics " + video), 2);
  expect_one_line("has 0 sound tracks");
}

TEST_F(EncodeCommand, SoundOfAnotherLengthIsReported) {
  ods::made::write_frames(pattern(), {1, 2, 3, 4, 5, 6});
  const std::string words =
      "encode " + pattern() + " --codec h264 -o " + folder.path("video.mp4") + " --audio " + folder.path("sound.wav");
  folder.write("sound.wav", ods::made::wav(2, 1.0));
  ASSERT_EQ(run(words), 0) << err;
  EXPECT_NE(err.find("the sound, 1.0 s, is cut where the pictures end, at 0.2 s"), std::string::npos) << err;
  folder.write("sound.wav", ods::made::wav(2, 0.1));
  ASSERT_EQ(run(words), 0) << err;
  EXPECT_NE(err.find("warning: the sound ends at 0.1 s, the pictures at 0.2 s"), std::string::npos) << err;
  folder.write("sound.wav", ods::made::wav(3, 0.1));
  EXPECT_EQ(run(words), 3);
  expect_one_line("it has 3 channels");
}

// Whatever of a sound file's header is wrong: one line without addresses, of the input; nothing is left.
TEST_F(EncodeCommand, BrokenSoundIsOneCleanLine) {
  ods::made::write_frames(pattern(), {1, 2, 3});
  const std::string words = "encode -q " + pattern() + " --codec h264 --preset ultrafast -o " +
                            folder.path("video.mp4") + " --audio " + folder.path("sound.wav");
  const std::string whole = ods::made::wav(2, 0.2);
  const auto expect_clean = [&] {
    EXPECT_EQ(err.find(" @ 0x"), std::string::npos) << err;
    expect_one_line("sound.wav");
    EXPECT_EQ(files(), 4u);
  };
  std::string fast = whole;
  fast.replace(24, 4, std::string("\xff\xff\xff\x7f", 4));  // samples a second
  folder.write("sound.wav", fast);
  EXPECT_EQ(run(words), 3);
  expect_clean();
  EXPECT_NE(err.find("it claims 2147483647 samples per second"), std::string::npos) << err;
  for (size_t at = 0; at < 44; at += 4) {
    std::string bad = whole;
    for (size_t i = at; i < at + 4; i++) bad[i] = '\xff';
    folder.write("sound.wav", bad);
    const int code = run(words);
    if (code == 0) {
      std::filesystem::remove(folder.path("video.mp4"));
      continue;
    }
    EXPECT_EQ(code, 3) << at;
    expect_clean();
  }
}

// --- what goes wrong -------------------------------------------------------------------------------------------------

TEST_F(EncodeCommand, ExitCodesSayWhatWasWrong) {
  ods::made::write_frames(pattern(), {1, 2, 4});
  const size_t before = files();
  const std::string video = folder.path("video.mp4"), all = "encode " + pattern() + " --frames 1-2 ";
  const std::tuple<std::string, int, const char*> kCases[] = {
      {"encode " + pattern() + " -o " + video, 3, "frames are missing: 3 of"},
      {all, 2, "-o video.mp4"},
      {all + "-o " + folder.path("video.avi"), 2, "ends in .mp4, .mov, .mkv or .webm"},
      {all + "-o " + folder.path("video.webm") + " --codec h264", 2,
       "webm holds av1, vp9, not h264, which goes into mp4, mov, mkv"},
      {all + "-o " + video + " --target master", 2, "not prores, which goes into mov, mkv"},
      {all + "-o " + video + " --codec mpeg1", 2, "--codec is one of h264, hevc, av1, vp9, prores, not 'mpeg1'"},
      {all + "-o " + video + " --encoder h263", 2, "--encoder is one of"},
      {all + "-o " + video + " --encoder libx265 --codec h264", 2, "libx265 does not encode h264"},
      {all + "-o " + video + " --bits 9", 2, "there is no h264 of 9 bits"},
      {all + "-o " + video + " --crf 60", 2, "from 0, the best, to 51"},
      {all + "-o " + video + " --fps 0", 2, "--fps is a number or a fraction"},
      {all + "-o " + video + " --fps 30/0", 2, "--fps is a number or a fraction"},
      {all + "-o " + video + " --fps nan", 2, "--fps is a number or a fraction"},
      {all + "-o " + video + " --to-layout anaglyph", 2, "top-bottom or side-by-side"},
      {all + "-o " + folder.path("a.1.png/video.mp4"), 4, "video.mp4"},
      {"encode " + pattern() + " --frames 1-x -o " + video, 2, "frames '1-x'"},
      {"encode " + folder.path("b.#.png") + " -o " + video, 3, "there is no file like"},
  };
  for (const auto& [words, code, why] : kCases) {
    EXPECT_EQ(run(words), code) << words << err;
    expect_one_line(why);
  }
  EXPECT_EQ(files(), before);
}

TEST_F(EncodeCommand, AFullDiskLeavesNothing) {
  ods::TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: this machine lets nobody mount a disk";
  ods::made::write_frames(pattern(), {1, 2, 3});
  disk.fill();
  for (const char* name : {"video.mp4", "video.mkv"}) {
    EXPECT_EQ(run("encode " + pattern() + " -q --codec h264 -o " + disk.folder().path(name)), 4);
    expect_one_line("cannot write");
  }
  EXPECT_EQ(disk.folder().names(), std::vector<std::string>{"ballast"});
}

TEST_F(EncodeCommand, ALimitOnFilesLeavesNothing) {
  ods::made::write_frames(pattern(), {1, 2, 3});
  const size_t before = files();
  EXPECT_EQ(run("encode " + pattern() + " -q --codec h264 -o " + folder.path("video.mp4"), 200), 4);
  expect_one_line("cannot write");
  EXPECT_EQ(files(), before);
}

TEST_F(EncodeCommand, AnInterruptLeavesNothing) {
  std::vector<int> frames;
  for (int i = 1; i <= 40; i++) frames.push_back(i);
  ods::made::write_frames(pattern(), frames, Layout::kTopBottom, {512, 256});  // small ones are done too soon
  const size_t before = files();
  for (const char* encoder : {"libx264", "libsvtav1"}) {
    if (!ods::has_encoder(encoder)) continue;
    Ods command({"encode", pattern(), "-o", folder.path("video.mp4"), "--encoder", encoder, "--progress", "json"});
    command.wait_for("\"progress\"");
    command.kill(SIGINT);
    EXPECT_EQ(command.finish(), 130);
    if (std::filesystem::exists(folder.path("video.mp4"))) {  // it came when the video was there: all of it
      EXPECT_EQ(ods::read_video_file(folder.path("video.mp4")).tracks.size(), 1u);
      std::filesystem::remove(folder.path("video.mp4"));
    }
    EXPECT_EQ(files(), before);
  }
}

TEST_F(EncodeCommand, SizesBeyondEveryLevelAreReportedWithTheLargest) {
  ods::made::write_frames(pattern(), {1}, Layout::kTopBottom, {4096, 544});
  const std::string words = "encode " + pattern() + " --layout top-bottom --projection lat-long --codec h264 " +
                            "--preset ultrafast -o " + folder.path("video.mp4");
  ASSERT_EQ(run(words + " --fps 900"), 0) << err;
  EXPECT_EQ(err.find("no level"), std::string::npos) << err;
  ASSERT_EQ(run(words + " --fps 1000"), 0) << err;
  EXPECT_NE(err.find("no level of H.264 holds 4096x1088 at 1000 frames a second"), std::string::npos) << err;
  EXPECT_NE(err.find("the largest is 3968x1054"), std::string::npos) << err;
}

TEST_F(EncodeCommand, NamesThatPlayersGoByAreSuggested) {
  ods::made::write_frames(pattern(), {1});
  ASSERT_EQ(run("encode " + pattern() + " --codec h264 -o " + folder.path("video.mp4")), 0) << err;
  EXPECT_NE(err.find("would recognise video_360_TB.mp4"), std::string::npos) << err;
  ASSERT_EQ(run("encode " + pattern() + " --codec h264 -o " + folder.path("video_360_LR.mp4")), 0) << err;
  EXPECT_NE(err.find("its name declares side-by-side"), std::string::npos) << err;
  ASSERT_EQ(run("encode " + pattern() + " --codec h264 --bits 10 -o " + folder.path("video_360_TB.mp4")), 0) << err;
  EXPECT_NE(err.find("few players accept h264 of 10 bits"), std::string::npos) << err;
  EXPECT_EQ(err.find("its name declares"), std::string::npos) << err;
}

TEST_F(EncodeCommand, ATitleGoesOverAVideo) {
  ods::made::write_frames(pattern(), {1, 2, 3, 4, 5, 6});
  folder.write("sound.wav", ods::made::wav(2, 0.2));
  const std::string video = folder.path("video_360_TB.mp4"), made = folder.path("made_360_TB.mp4");
  const std::string title = folder.path("title.exr"), over = "over " + title + " " + video + " --progress none -o ";
  ASSERT_EQ(run("encode " + pattern() + " --codec h264 --audio " + folder.path("sound.wav") + " -q -o " + video), 0);
  ASSERT_EQ(run("title End --merge none --at 0,0,2 --text-height 1 --width 64 -o " + title), 0) << err;
  ASSERT_EQ(run("over " + title + " " + video + " -o " + made), 0) << err;
  EXPECT_EQ(out, made + "\n");
  EXPECT_NE(err.find("h264, 8 bits, 420, level 1.1, 128x128, 6 frames at 30 a second"), std::string::npos) << err;
  EXPECT_EQ(ods::read_video_file(made).sound.size(), 1u);
  ASSERT_EQ(run(over + folder.path("x.#.png") + " --frames 2-4x2"), 0) << err;
  EXPECT_EQ(out, folder.path("x.2.png") + "\n" + folder.path("x.4.png") + "\n");
  const std::pair<std::string, const char*> kWrong[] = {{made + " --frames 1-5x2", "must be consecutive"},
                                                        {made + " --frames 3-1", "ascending"},
                                                        {video, "overwritten"},
                                                        {folder.path("x.png"), "place for their number"}};
  for (const auto& [words, fault] : kWrong) {
    EXPECT_EQ(run(over + words), 2) << words;
    expect_one_line(fault);
  }
}

TEST_F(EncodeCommand, TheTestCardIsAVideo) {
  const std::string video = folder.path("card_360_TB.mp4");
  ASSERT_EQ(run("testcard --video --width 128 --duration 0.2 -o " + video), 0) << err;
  EXPECT_EQ(out, video + "\n");
  EXPECT_NE(err.find("128x128, 6 frames at 30 a second"), std::string::npos) << err;
  EXPECT_EQ(run("testcard --video --layout anaglyph -o " + video), 2);
  expect_one_line("a video's layout must be");
  EXPECT_EQ(run("testcard --video -o " + folder.path("card.png")), 2);
  expect_one_line("is not the name of a video");
}

}  // namespace ods::encode_command_test
