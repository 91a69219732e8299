// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every kind of error has its exit code, and one line that names the option or the file at fault.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/cli_runner.h"

namespace ods::cli_errors_test {

constexpr int kFailure = 1, kUsage = 2, kInput = 3, kOutput = 4;

struct Fault {
  std::string words;  // a name that starts with @ is in the test's folder
  int code;
  std::string says;
};

// The files that the commands below read, and no trace of files that they must not write.
class Errors : public Cli {
 protected:
  // The files that the table reads, and nothing else: making all of them takes longer than most tables.
  void provide(const std::vector<Fault>& faults) {
    const auto is_read = [&](const std::string& name) {
      return std::any_of(faults.begin(), faults.end(),
                         [&](const Fault& fault) { return fault.words.find(name) != std::string::npos; });
    };
    const auto make = [&](const std::string& words) { ASSERT_EQ(run(in_folder(words)), 0) << err; };
    const bool has_video = is_read("@f_360_TB.mp4");
    if (is_read("@p_TB.png")) make("render furnace -q --width 32 --samples 1 -o @p_TB.png");
    if (is_read("@p.exr")) make("render furnace -q --width 32 --samples 1 -o @p.exr");
    if (has_video || is_read("@f.")) make("render furnace -q --width 32 --samples 1 --frames 0-3 -o @f.####.png");
    if (has_video) make("encode -q @f.####.png -o @f_360_TB.mp4");
    if (is_read("@rig.json")) make("rig -q --nearest 1 --width 64 -o @rig.json");
    for (const char* name : {"broken.png", "broken.mp4", "broken.glb", "broken.json"}) folder.write(name, "glTF");
    folder.write("empty.json", "{}");
  }

  void expect(const std::vector<Fault>& faults) {
    provide(faults);
    const std::vector<std::string> before = folder.names();
    for (const Fault& fault : faults) {
      EXPECT_EQ(run(in_folder(fault.words)), fault.code) << fault.words << "\n" << err;
      const size_t start = err.rfind("ods: error: ");  // notes may stand before it
      ASSERT_NE(start, std::string::npos) << fault.words << "\n" << err;
      EXPECT_EQ(err.find('\n', start), err.size() - 1) << "the error is the last line\n" << err;
      EXPECT_NE(err.find(fault.says, start), std::string::npos) << fault.words << "\n" << err;
      EXPECT_EQ(folder.names(), before) << fault.words;
    }
  }

 private:
  std::string in_folder(std::string words) const {
    for (size_t at = 0; (at = words.find('@', at)) != std::string::npos;) words.replace(at, 1, folder.path(""));
    return words;
  }
};

TEST_F(Errors, OfTheCommandLine) {
  expect({{"rendr", kUsage, "'rendr'"},
          {"render", kUsage, "SCENE"},
          {"render furnace", kUsage, "-o"},
          {"render furnace -o @a.png --width 0", kUsage, "--width"},
          {"render furnace -o @a.png --width", kUsage, "--width"},
          {"render furnace -o @a.png --unknown", kUsage, "--unknown"},
          {"render furnace surplus -o @a.png", kUsage, "'surplus'"},
          {"denoise @p.exr", kUsage, "-o"},
          {"denoise @p.exr -o @p.exr", kUsage, "p.exr"},
          {"denoise @p.exr -o @a.exr --half-a x", kUsage, "--half-b"},
          {"denoise @p.exr -o @a.exr --variance x --half-a x --half-b x", kUsage, "not both"},
          {"denoise @p.exr -o @a.xyz", kUsage, "a.xyz"},
          {"render furnace -o @a.png --statistics", kUsage, "--statistics"},
          {"render furnace -o @a.png --device NoSuchCard", kFailure, "NoSuchCard"},
          {"render furnace -o @v/#.png --rig @rig.json --device auto", kUsage, "--device"},
          {"video @v/#/#.png -o @a.mp4 --rig @rig.json --device auto", kUsage, "--device"},
          {"compare @p.exr", kUsage, "B"},
          {"compare @p.exr @p.exr --max-rmse x", kUsage, "--max-rmse"},
          {"compare @p.exr @p.exr --diff @p.exr", kUsage, "p.exr"},
          {"lint @p.exr --min-certainty 2", kUsage, "--min-certainty"},
          {"lint @p.exr --every 2", kUsage, "--every"},
          {"camera --for nope", kUsage, "--for"},
          {"camera --for povray-fork --pitch 5", kUsage, "--for"},
          {"camera --for povray -o @a.png", kUsage, "a.png"},
          {"project 1,2", kUsage, "'1,2'"},
          {"project --from-pixel up,1,2,3", kUsage, "--from-pixel"},
          {"sizes nope", kUsage, "'nope'"},
          {"probe", kUsage, "input file"},
          {"info", kUsage, "SCENE"}});
}

TEST_F(Errors, OfOptionsThatTheSceneJudges) {
  expect({{"render furnace -o @a.png --scene 99", kUsage, "--scene"},
          {"render furnace -o @a.####.png --frames 1-999999999", kUsage, "frames '1-999999999'"},
          {"render furnace -o @a.####.png --frames 1-x", kUsage, "frames '1-x'"},
          {"render furnace -o @a.png --frames 1-3", kUsage, "shot.####.png"},
          {"render furnace -o @a.####.png --frames 1-3 --time 1", kUsage, "--time"},
          {"render furnace -o @a.png --camera nope", kUsage, "--camera"},
          {"render furnace -o @a.png --animation nope", kUsage, "--animation"},
          {"render furnace -o @a.png --transparent --shadow-catcher nope", kUsage, "--shadow-catcher"},
          {"render furnace -o @a.png --shadow-catcher floor", kUsage, "--shadow-catcher"},
          {"render furnace -o @a.png --env 1,2", kUsage, "--env"},
          {"render furnace -o @a.png --env @absent.hdr", kInput, "absent.hdr"},
          {"render furnace -o @a.png --env @broken.png", kInput, "broken.png"},
          {"render furnace -o @a.png --merge map", kUsage, "--merge-map"},
          {"render furnace -o @a.png --merge map --merge-map @absent.png", kInput, "absent.png"},
          {"render furnace -o @a.png --camera-preset cycles:cheese=1", kUsage, "--camera-preset"},
          {"render @absent.glb -o @a.png", kInput, "absent.glb"},
          {"render @broken.glb -o @a.png", kInput, "broken.glb"},
          {"render furnace -o @a.png --with @absent.glb --at 0,0,0", kInput, "absent.glb"},
          {"render furnace -o @a.png --with @broken.glb --at 0,0,0", kInput, "broken.glb"},
          {"render furnace -o @a.png --with spheres", kUsage, "--with needs --at"},
          {"render furnace -o @a.png --at 0,0,0", kUsage, "--at is given 1 times and --with 0 times"},
          {"render furnace -o @a.png --with spheres --at 0,0", kUsage, "--at is X,Y,Z"},
          {"render furnace -o @a.png --with spheres --at 0,0,0 --turn left", kUsage, "--turn is a number"},
          {"info @absent.glb", kInput, "absent.glb"},
          {"rig --scene @absent.glb -o @r.json", kInput, "absent.glb"}});
}

TEST_F(Errors, OfPicturesThatCannotBeWritten) {
  expect({{"render furnace -o @a.xyz", kUsage, "a.xyz"},
          {"render furnace -o @a", kUsage, "known are png"},
          {"render furnace -o @a.png --layout multiview", kUsage, "a.png"},
          {"render furnace -o @a.png --layout separate", kUsage, "%V"},
          {"render furnace -o @a_%V.png --eyes mono", kUsage, "%V"},
          {"render furnace -o @a.exr --layout anaglyph-dubois", kUsage, "a.exr"},
          {"render furnace -o @a.png --layout anaglyph-dubois --eyes mono", kUsage, "a.png"},
          {"render furnace -o @a.webp --width 30000 --samples 1", kUsage, "a.webp"},
          {"render furnace -o @a.vr.jpg --projection cube-3x2", kUsage, "a.vr.jpg"},
          {"render furnace -o @a.jpg --transparent", kUsage, "--transparent"},
          {"render furnace -o /proc/a.png", kOutput, "/proc/a.png"},
          {"render furnace -o /dev/null/a.png", kOutput, "/dev/null"},
          {"testcard -o @a.xyz", kUsage, "a.xyz"},
          {"testcard -o /proc/a.png", kOutput, "/proc/a.png"},
          {"convert @p.exr -o @a.xyz", kUsage, "a.xyz"},
          {"compare @p.exr @p.exr --diff @a.xyz", kUsage, "a.xyz"},
          {"title X -o @a.xyz", kUsage, "a.xyz"},
          {"title X -o @a.jpg", kUsage, "alpha"},
          {"camera --for povray -o /proc/a.inc", kOutput, "/proc/a.inc"},
          {"rig --nearest 1 --width 64 -o /proc/a.json", kOutput, "/proc/a.json"}});
}

TEST_F(Errors, OfPicturesThatAreRead) {
  expect({{"convert @absent.png -o @a.png", kInput, "absent.png"},
          {"convert @broken.png -o @a.png", kInput, "broken.png"},
          {"convert @p_TB.png -o @p_TB.png", kUsage, "p_TB.png"},
          {"convert @p_TB.png -o @a.png --ipd 0.05", kUsage, "p_TB.png"},
          {"convert @p_TB.png -o @a.png --height 8", kUsage, "--height"},
          {"convert @p_TB.png -o @a.png --right-gain 1,2", kUsage, "--right-gain"},
          {"convert @p_TB.png -o @a.png --right-gain 1,0,1", kUsage, "--right-gain"},
          {"convert @p_TB.png -o @a.png --right-zoom 0", kUsage, "--right-zoom"},
          {"convert @p_TB.png -o @a.png --mono --eyes left --ipd 0.05 --right-roll 200", kUsage, "--right-roll"},
          {"convert @p_TB.png -o @a.png --to nope", kUsage, "--to"},
          {"denoise @absent.exr -o @a.exr", kInput, "absent.exr"},
          {"denoise @broken.png -o @a.exr", kInput, "broken.png"},
          {"denoise @p.exr -o @a.exr", kInput, "--statistics"},
          {"denoise @p_TB.png -o @a.exr", kInput, "p_TB.png"},
          {"denoise @p.exr -o @a.exr --variance nope", kUsage, "nope"},
          {"compare @p_TB.png @absent.png", kInput, "absent.png"},
          {"compare @p_TB.png @broken.png", kInput, "broken.png"},
          {"lint @absent.png", kInput, "absent.png"},
          {"lint @broken.png", kInput, "broken.png"},
          {"probe @absent.png", kInput, "absent.png"},
          {"probe @broken.png", kInput, "broken.png"},
          {"inject @absent.png", kInput, "absent.png"},
          {"inject @broken.png", kInput, "broken.png"},
          {"inject @p_TB.png", kInput, "p_TB.png"},
          {"inject @p_TB.png --track 1", kUsage, "--track"},
          {"inject @p_TB.png --projection nope", kUsage, "--projection"},
          {"over @p_TB.png @p_TB.png -o @a.png", kUsage, "alpha"},
          {"over @absent.png @p_TB.png -o @a.png", kInput, "absent.png"},
          {"over @p.exr @p.exr -o @a.mp4", kUsage, "a video output needs a video as background"},
          {"camera --camera-file @absent.json", kInput, "absent.json"},
          {"render furnace -o @", kUsage, "it is a folder: add the name of a file"},
          {"camera --camera-file @empty.json", kInput, "empty.json"},
          {"camera --camera-file @broken.json", kInput, "broken.json"}});
}

TEST_F(Errors, OfTitles) {
  expect({{"title X --at 1 -o @a.png", kUsage, "--at"},
          {"title X --color red -o @a.png", kUsage, "--color"},
          {"title X --font @absent.ttf -o @a.png", kInput, "absent.ttf"},
          {"title X --font absent.ttf -o @a.png", kInput, "absent.ttf"},
          {"title X --font @broken.png -o @a.png", kInput, "broken.png"},
          {"title X --fade-in 1 -o @a.png", kUsage, "--fps"},
          {"title X --frames 1-3 -o @a.png", kUsage, "shot.####.png"},
          {"title X --frames 5-1x0 -o @a.####.png", kUsage, "frames '5-1x0'"},
          {"title \\n -o @a.png", kUsage, "text"},
          {"title \xff -o @a.png", kUsage, "text"}});
}

TEST_F(Errors, OfVideos) {
  const std::string encode = "encode @f.####.png -o @a.mp4 ";
  expect({{"encode @f.####.png", kUsage, "-o"},
          {"encode @f.####.png -o @a.avi", kUsage, "a.avi"},
          {"encode @f.png -o @a.mp4", kUsage, "f.png"},
          {"encode @absent.####.png -o @a.mp4", kInput, "absent.####.png"},
          {encode + "--frames 0-9", kInput, "4-9"},
          {encode + "--frames 0-z", kUsage, "frames '0-z'"},
          {encode + "--preset nope", kUsage, "'nope'"},
          {encode + "--encoder nope", kUsage, "--encoder"},
          {encode + "--encoder libvpx-vp9 --codec h264", kUsage, "libvpx-vp9"},
          {encode + "--crf 99", kUsage, "--crf"},
          {encode + "--bits 7", kUsage, "--bits"},
          {encode + "--fps x", kUsage, "--fps"},
          {encode + "--fps 10000", kUsage, "--fps"},
          {encode + "--to-layout anaglyph-dubois", kUsage, "--to-layout"},
          {encode + "--audio @absent.wav", kInput, "absent.wav"},
          {encode + "--audio @broken.png", kInput, "broken.png"},
          {encode + "--audio @p_TB.png", kInput, "p_TB.png': it is not a sound or video file"},
          {"encode @f.####.png -o /proc/a.mp4", kOutput, "/proc/a.mp4"},
          {"video furnace", kUsage, "-o"},
          {"video furnace -o @a.mp4", kUsage, "--duration"},
          {"video furnace --duration 1 -o @a.avi", kUsage, "a.avi"},
          {"video furnace --time 1 -o @a.mp4", kUsage, "--time"},
          {"video furnace --duration 1 --preset nope -o @a.mp4", kUsage, "'nope'"},
          {"video furnace --duration 1 --target nope -o @a.mp4", kUsage, "--target"},
          {"video furnace --duration 1e6 --width 16 -o @a.mp4", kUsage, "--frames"},
          {"video furnace --rig @rig.json -o @a.mp4", kUsage, "--frames"},
          {"video @absent.glb --duration 1 -o @a.mp4", kInput, "absent.glb"},
          {"testcard --sidecar -o @a.mp4", kUsage, "--sidecar"}});
}

TEST_F(Errors, OfVideosThatAreRead) {
  expect({{"probe @absent.mp4", kInput, "absent.mp4"},
          {"probe @broken.mp4", kInput, "broken.mp4"},
          {"inject @absent.mp4", kInput, "absent.mp4"},
          {"inject @broken.mp4", kInput, "broken.mp4"},
          {"inject @f_360_TB.mp4 --track 9", kUsage, "--track"},
          {"inject @f_360_TB.mp4 --projection nope", kUsage, "--projection"},
          {"inject @f_360_TB.mp4 --remove --layout top-bottom", kUsage, "--remove"},
          {"inject @f_360_TB.mp4 --ambisonics", kUsage, "--ambisonics"},
          {"inject @f_360_TB.mp4 --layout bottom-top", kUsage, "f_360_TB.mp4"},
          {"inject @f_360_TB.mp4 --layout anaglyph-dubois", kUsage, "anaglyph-dubois"},
          {"inject @f_360_TB.mp4 -o /proc/a.mp4", kOutput, "/proc/a.mp4"},
          {"over @p.exr @f_360_TB.mp4 -o @a.mp4 --by-depth", kUsage, "f_360_TB.mp4"},
          {"over @p.exr @f_360_TB.mp4 -o @a.####.png --by-depth --frames 90", kUsage, "no picture 90"}});
}

TEST_F(Errors, OfSlits) {
  expect({{"rig --for nope -o @r.json", kUsage, "--for"},
          {"rig --slits 4 --max-error 1 -o @r.json", kUsage, "--slits"},
          {"rig --nearest 1 --scene room -o @r.json", kUsage, "--nearest"},
          {"render furnace --rig @rig.json -o @v.png", kUsage, "v.png"},
          {"render furnace --rig @rig.json --width 3 -o @v.####.png", kUsage, "--width"},
          {"render furnace --rig @empty.json -o @v.####.png", kInput, "empty.json"},
          {"stitch", kUsage, "RIG"},
          {"stitch @rig.json @v.####.png", kUsage, "-o"},
          {"stitch @absent.json @v.####.png -o @a.png", kInput, "absent.json"},
          {"stitch @rig.json @v.png -o @a.png", kUsage, "v.png"},
          {"stitch @rig.json @v.####.png -o @a.png", kInput, "--partial"},
          {"stitch @rig.json @v.####.png -o @a.xyz", kUsage, "a.xyz"},
          {"stitch @rig.json @v.####.png --frames 1-2 -o @a.####.png", kUsage, "--frames"}});
}

// Also one that has barely begun. Here it waits until its 80 KB are read.
TEST_F(Errors, EveryCommandSaysThatItWasInterrupted) {
  Ods command({"--help=zsh"});
  const auto catches = [&] {
    std::ifstream file(fmt::format("/proc/{}/status", command.process()));
    std::string line;
    while (std::getline(file, line) && !line.starts_with("SigCgt:")) {
    }
    return line.size() > 7 && (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  };
  for (int i = 0; i < 100 && !catches(); i++) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_TRUE(catches());
  command.kill(SIGINT);
  EXPECT_EQ(command.finish(), 130);
  EXPECT_EQ(command.err, "ods: interrupted\n");
}

}  // namespace ods::cli_errors_test
