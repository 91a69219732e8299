// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods convert of videos and frames as its users meet it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <numeric>

#include "ods/base/bytes.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "ods/video/container/video_file.h"
#include "ods/video/write_video.h"
#include "tests/support/cli_runner.h"
#include "tests/support/made_frames.h"

namespace ods::convert_video_command_test {

class ConvertVideoCommand : public Cli {
 protected:
  std::string path(const std::string& name) const { return folder.path(name); }

  // A video of frames that grow brighter, ten a second; the eyes are 128x64 pixels, one above the other.
  std::string make(const std::string& name, int frames, const std::string& words = "") {
    std::vector<int> numbers(static_cast<size_t>(frames));
    std::iota(numbers.begin(), numbers.end(), 1);
    ods::made::write_frames(path("made.#.png"), numbers);
    EXPECT_EQ(run("encode " + path("made.#.png") + " -q --fps 10 --codec h264 --crf 4 -o " + path(name) + " " + words),
              0)
        << err;
    for (const int number : numbers) std::filesystem::remove(path("made." + std::to_string(number) + ".png"));
    return path(name);
  }

  int convert(const std::string& from, const std::string& to, const std::string& words = "") {
    return run("convert " + from + " -o " + path(to) + " " + words);
  }

  // Which frame of make() this is, the first one is 1: by how red its left eye is. NaN if there is none.
  double number_of(const std::string& frame) const {
    if (!std::filesystem::exists(path(frame))) return std::nan("");
    const double red = static_cast<double>(ods::srgb_encode(ods::read_image(path(frame)).at(20, 20)[0]));
    return (255.0 * red - ods::made::code_of(0)) / (ods::made::code_of(1) - ods::made::code_of(0));
  }

  void expect_error(const std::string& words) const {
    EXPECT_EQ(out, "");
    EXPECT_TRUE(err.starts_with("ods: error: ")) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_NE(err.find(words), std::string::npos) << err;
  }
};

TEST_F(ConvertVideoCommand, TrimTakesWhatBeginsInTheSpan) {
  const std::string video = make("video_360_TB.mp4", 8);
  ASSERT_EQ(convert(video, "a.#.png", "-q --trim 0.2-0:00.5"), 0) << err;
  EXPECT_NEAR(number_of("a.0.png"), 3.0, 0.4);
  EXPECT_NEAR(number_of("a.2.png"), 5.0, 0.4);
  EXPECT_FALSE(std::filesystem::exists(path("a.3.png")));

  ASSERT_EQ(convert(video, "part_360_TB.mp4", "--trim 0.35-"), 0) << err;
  EXPECT_NE(err.find(", 4 frames"), std::string::npos) << err;
  ASSERT_EQ(convert(path("part_360_TB.mp4"), "b.#.png", "-q"), 0) << err;
  EXPECT_NEAR(number_of("b.0.png"), 5.0, 0.4);
  EXPECT_NEAR(number_of("b.3.png"), 8.0, 0.4);
  EXPECT_FALSE(std::filesystem::exists(path("b.4.png")));

  for (const char* span : {"1", "-", "0.5-0.2", "a-b", "0:75-1"}) {
    EXPECT_EQ(convert(video, "c.mp4", std::string("--trim ") + span), 2) << span;
    expect_error(*span == '-' && span[1] == '\0' ? "" : "--trim");
  }
  EXPECT_EQ(convert(video, "c_360_TB.mp4", "-q --trim 20-30"), 2);
  expect_error("there is no picture in that part");
  EXPECT_FALSE(std::filesystem::exists(path("c_360_TB.mp4")));
}

// The pictures of a video whose camera was turned by 90 degrees to the right, turned back, equal the pictures of a
// video turned to the left: by a quarter of the width, without a change to a pixel.
TEST_F(ConvertVideoCommand, StabilizingTurnsBack) {
  const std::string video = make("video_360_TB.mp4", 2);
  folder.write("turned.keys", "0 90 0 0  # to the right all the time\n");
  folder.write("broken.keys", "0 90 0 0\n0:01 sideways\n");
  ASSERT_EQ(run("render mirrors -q --width 64 --samples 1 --merge none -o " + path("still_TB.1.png")), 0) << err;
  ASSERT_EQ(run("encode " + path("still_TB.#.png") + " -q --codec h264 --crf 4 -o " + path("still_360_TB.mp4")), 0);
  ASSERT_EQ(convert(path("still_360_TB.mp4"), "as_it_was.#.png", "-q"), 0) << err;
  ASSERT_EQ(convert(path("still_360_TB.mp4"), "back.#.png", "-q --stabilize " + path("turned.keys")), 0) << err;
  ASSERT_EQ(convert(path("still_360_TB.mp4"), "left.#.png", "-q --yaw -90"), 0) << err;
  const std::string compare = "compare " + path("back.0.png") + " ";
  EXPECT_EQ(run(compare + path("left.0.png") + " --max-error 0"), 0) << err << out;
  EXPECT_EQ(run(compare + path("as_it_was.0.png") + " --max-error 0.01"), 5) << err << out;

  EXPECT_EQ(convert(video, "a.mp4", "--stabilize " + path("broken.keys")), 3);
  expect_error("broken.keys");
  EXPECT_EQ(convert(video, "a.mp4", "--stabilize " + path("absent.keys")), 3);
  expect_error("absent.keys");
}

TEST_F(ConvertVideoCommand, FramesKeepTheirNumbersOrBecomeAVideo) {
  ods::made::write_frames(path("shot_360_TB.##.png"), {3, 4, 5, 6});
  const std::string shots = path("shot_360_TB.##.png");
  ASSERT_EQ(convert(shots, "half_180_LR.##.png", "-q --to vr180 --frames 4-6x2"), 0) << err;
  EXPECT_NEAR(number_of("half_180_LR.04.png"), 4.0, 0.3);
  EXPECT_NEAR(number_of("half_180_LR.06.png"), 6.0, 0.3);
  EXPECT_FALSE(std::filesystem::exists(path("half_180_LR.05.png")));

  ASSERT_EQ(convert(shots, "half_180_LR.mp4", "--to vr180 --fps 25 --codec h264"), 0) << err;
  EXPECT_NE(err.find("4 frames at 25 a second"), std::string::npos) << err;
  EXPECT_EQ(ods::read_video_file(path("half_180_LR.mp4")).tracks.size(), 1u);

  EXPECT_EQ(convert(shots, "shot_360_TB.##.png"), 2);  // themselves
  expect_error("overwritten");
  EXPECT_EQ(convert(shots, "a.##.png", "--frames 10-12"), 3);
  expect_error("10");
}

TEST_F(ConvertVideoCommand, AnInterruptLeavesWhatWasThere) {
  const std::string video = make("video_360_TB.mp4", 40);
  folder.write("new_360_TB.mp4", "the old one");
  const std::vector<std::string> before = folder.names();
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    Ods command({"convert", video, "-o", path("new_360_TB.mp4"), "--width", "1024", "--progress", "json"});
    command.wait_for("\"progress\"");
    command.kill(signal);
    const int code = command.finish();
    if (code == 0) continue;  // the signal came too late
    EXPECT_EQ(code, signal == SIGKILL ? 1000 + SIGKILL : 128 + signal);
    EXPECT_EQ(folder.read("new_360_TB.mp4"), "the old one");
    if (signal != SIGKILL) {
      EXPECT_EQ(folder.names(), before);
    }
  }
}

class KilledConversion : public ConvertVideoCommand {
 protected:
  static constexpr int kFrames = 2 * ods::kPartFrames + 40;
  static constexpr ods::Extent kSize{128, 128};

  // A long video with sound whose pictures move; `shift` makes it another one.
  std::string make_long(const std::string& name, int shift = 0) const {
    folder.write("sound.wav", ods::made::wav(2, kFrames / 30.0));
    ods::EncodeOptions options;
    options.sound = path("sound.wav");
    ods::AtomicFile file(path(name));
    ods::VideoEncoder encoder(file, *ods::container_of_path(name), kSize, options);
    for (int i = 0; i < kFrames; i++) {
      const auto frame = std::make_shared<ods::VideoFrame>(kSize, options.packing);
      const ods::Planes planes = frame->planes();
      for (size_t k = 0; k < frame->bytes(); k++) {
        planes.first[0][k] =
            static_cast<std::byte>(64 + (k % 128 * 3 + k / 128 * 5 + static_cast<size_t>(2 * i + shift)) % 128);
      }
      encoder.add(frame, {i, 1});
    }
    encoder.finish();
    file.commit();
    return path(name);
  }

  // The number of marks in a file of parts (ods/files/parts_file.h).
  static int parts_in(const std::string& bytes) {
    const size_t head = std::string("omnistereo parts, 2\n").size();
    if (bytes.size() < head + 4) return 0;
    size_t at = head + 4 + ods::get_number(bytes, head, 4);
    int count = 0;
    while (at + 12 <= bytes.size()) {
      const size_t size = ods::get_number(bytes, at, 4);
      if (size == 0xffffffff) count++;
      at += size == 0xffffffff ? 12 : 4 + size;
    }
    return count;
  }

  // Killed when a part of it is finished.
  void kill_in_the_middle(std::vector<std::string> arguments, const std::string& to) const {
    arguments.insert(arguments.begin(), "convert");
    Ods command(arguments);
    for (int i = 0; i < 60'000 && parts_in(folder.read(to + ".unfinished")) == 0; i++) usleep(1000);
    command.kill(SIGKILL);
    ASSERT_EQ(command.finish(), 1000 + SIGKILL) << command.err;
    ASSERT_GT(parts_in(folder.read(to + ".unfinished")), 0);
    ASSERT_FALSE(std::filesystem::exists(path(to)));
  }
};

TEST_F(KilledConversion, GoesOnAndGivesTheSameBytes) {
  const std::string film = make_long("film_360_TB.mp4");
  for (const std::string to : {"new_180_LR.mp4", "new_180_LR.mkv"}) {
    const std::string words = to.ends_with("mkv") ? " --codec hevc --preset ultrafast" : "";
    ASSERT_EQ(run("convert " + film + " -q --to vr180 -o " + path(to) + words), 0) << err;
    const std::string whole = folder.read(to);
    std::filesystem::remove(path(to));
    std::vector<std::string> arguments = {film, "--to", "vr180", "-o", path(to)};
    if (!words.empty()) arguments.insert(arguments.end(), {"--codec", "hevc", "--preset", "ultrafast"});
    ASSERT_NO_FATAL_FAILURE(kill_in_the_middle(arguments, to));
    ASSERT_EQ(run("convert " + film + " --to vr180 -o " + path(to) + words), 0) << err;
    EXPECT_NE(err.find("resuming after "), std::string::npos) << err;
    EXPECT_TRUE(folder.read(to) == whole) << to;
    EXPECT_FALSE(std::filesystem::exists(path(to + ".unfinished")));
  }
}

TEST_F(KilledConversion, IsRefusedWhereAnythingDiffers) {
  const std::string film = make_long("film_360_TB.mp4"), to = "new_180_LR.mp4";
  ASSERT_NO_FATAL_FAILURE(kill_in_the_middle({film, "--to", "vr180", "-o", path(to)}, to));
  const std::string parts = folder.read(to + ".unfinished"), words = "convert " + film + " --to vr180 -o " + path(to);

  EXPECT_EQ(run(words + " --crf 30"), 2);
  EXPECT_NE(err.find(".unfinished' was made with other options: arguments was "), std::string::npos) << err;
  EXPECT_TRUE(folder.read(to + ".unfinished") == parts);
  ASSERT_EQ(run(words + " --crf 30 --restart"), 0) << err;
  const std::string coarse = folder.read(to);
  ASSERT_EQ(run(words + " --crf 30"), 0) << err;
  EXPECT_TRUE(folder.read(to) == coarse);

  folder.write(to + ".unfinished", parts);
  make_long("film_360_TB.mp4", 40);
  EXPECT_EQ(run(words), 2);
  EXPECT_NE(err.find("film_360_TB.mp4' was "), std::string::npos) << err;
  ASSERT_EQ(run(words + " --restart"), 0) << err;
  const std::string other = folder.read(to);
  ASSERT_EQ(run(words), 0) << err;
  EXPECT_TRUE(folder.read(to) == other);

  folder.write(to + ".unfinished", "somebody's");
  EXPECT_EQ(run(words), 4) << err;
  EXPECT_NE(err.find(".unfinished' was not written by this version of ods"), std::string::npos) << err;
  EXPECT_EQ(folder.read(to + ".unfinished"), "somebody's");
}

TEST_F(KilledConversion, OfFramesGoesOnUnlessAFrameIsAnother) {
  const auto write = [&](int frame, int shown) {
    save_picture(ods::made::red_and_blue({64, 32}, shown), {}, path(fmt::format("shot_360_TB.{:03}.png", frame)));
  };
  for (int i = 0; i < kFrames; i++) write(i, i % 20);
  const std::string to = "new_180_LR.mp4";
  std::vector<std::string> arguments = {path("shot_360_TB.###.png"), "--to", "vr180", "--width", "64", "-o", path(to)};
  arguments.insert(arguments.end(), {"--codec", "h264", "--preset", "ultrafast"});
  const std::string words = fmt::format("convert {}", fmt::join(arguments, " "));
  ASSERT_EQ(run(words + " -q"), 0) << err;
  const std::string whole = folder.read(to);
  std::filesystem::remove(path(to));
  ASSERT_NO_FATAL_FAILURE(kill_in_the_middle(arguments, to));
  const std::string parts = folder.read(to + ".unfinished");
  ASSERT_EQ(run(words), 0) << err;
  EXPECT_NE(err.find("resuming after "), std::string::npos) << err;
  EXPECT_TRUE(folder.read(to) == whole);
  EXPECT_FALSE(std::filesystem::exists(path(to + ".unfinished")));

  folder.write(to + ".unfinished", parts);
  write(10, 25);
  EXPECT_EQ(run(words), 2) << err;
  ASSERT_EQ(run(words + " --restart"), 0) << err;
  EXPECT_FALSE(folder.read(to) == whole);
}

// A format that does not hold the codec gets another, which has what players take.
TEST_F(ConvertVideoCommand, SaysWhatBitsAndChromaTheNewCodecLacks) {
  const std::string deep = make("deep_360_TB.mp4", 2, "--bits 10 --chroma 444");
  EXPECT_EQ(convert(deep, "a_180_LR.webm", "--to vr180"), 0) << err;
  EXPECT_NE(
      err.find(
          "has 10 bits chroma 444; the new video has less, for compatibility with players: --bits 10 --chroma 444"),
      std::string::npos)
      << err;
  EXPECT_EQ(convert(deep, "b_180_LR.webm", "--to vr180 --bits 10 --chroma 444"), 0) << err;
  EXPECT_EQ(err.find("the new video has less"), std::string::npos) << err;
}

TEST_F(ConvertVideoCommand, RefusalsSayWhatToDo) {
  const std::string video = make("video_360_TB.mp4", 2);
  ods::made::write_frames(path("shot_TB.#.png"), {1, 2});
  const std::string shots = path("shot_TB.#.png"), picture = path("shot_TB.1.png");
  struct Case {
    std::string from, to, words, said;
  };
  const Case cases[] = {
      {video, "same_360_TB.mp4", "", "ods inject"},
      {video, "a.mp4", "--fps 25", "--fps needs frames"},
      {video, "a.mp4", "--frames 1-2", "--trim"},
      {video, "a.mp4", "--to-layout anaglyph", "a video's layout is"},
      {video, "a.mp4", "--mono --exposure 1", "scene-linear"},
      {video, "a.png", "", "has many pictures"},
      {video, "a.#.png", "--crf 20", "is not a video"},
      {shots, "a.png", "", "has many pictures"},
      {shots, "a.mp4", "--trim 1-2", "--trim is for videos"},
      {shots, "a.mp4", "--stabilize " + path("none.keys"), "--stabilize is for videos"},
      {picture, "a.mp4", "", "is one picture"},
      {picture, "a.#.png", "", "is one picture"},
      {picture, "a.png", "--frames 1", "--frames is for frames"},
  };
  const std::vector<std::string> before = folder.names();
  for (const Case& each : cases) {
    const int code = convert(each.from, each.to, each.words);
    EXPECT_TRUE(code == 2 || code == 3) << each.to << " " << each.words << ": " << code;
    expect_error(each.said);
  }
  EXPECT_EQ(folder.names(), before);
}

}  // namespace ods::convert_video_command_test
