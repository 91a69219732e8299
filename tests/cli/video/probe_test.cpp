// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods inject and ods probe as their users meet them, and what other programs read in tagged videos.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/cli_runner.h"
#include "tests/support/decoded_video.h"
#include "tests/support/made_videos.h"

namespace ods::video_command_test {

using Json = nlohmann::json;

class ProbeCommand : public Cli {
 protected:
  std::string make(const std::string& name, const ods::made::Mp4Options& options = {}) {
    folder.write(name, ods::made::mp4(options));
    return folder.path(name);
  }

  Json probe(const std::string& path) {
    EXPECT_EQ(run("probe --json " + path), 0) << err;
    return Json::parse(out, nullptr, false);
  }

  // Nothing but one line, which starts as every error does.
  void expect_one_line() const {
    EXPECT_EQ(out, "");
    EXPECT_TRUE(err.starts_with("ods: error: ")) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  }
};

TEST_F(ProbeCommand, InjectGoesByTheNameAndSaysSo) {
  const std::string path = make("video_360_TB.mp4");
  ASSERT_EQ(run("inject " + path), 0) << err;
  EXPECT_EQ(out, path + "\n");
  EXPECT_NE(err.find("its name ends in _TB"), std::string::npos) << err;
  EXPECT_NE(err.find("written as V1 and V2"), std::string::npos) << err;
  const Json video = probe(path)["video"]["video"][0];
  EXPECT_EQ(video["v1"]["stereo"], "top-bottom");
  EXPECT_EQ(video["v2"]["projection"], "lat-long");
  ASSERT_EQ(video["warnings"].size(), 1u) << video["warnings"] << "the file has no pictures";
  EXPECT_TRUE(video["warnings"][0].get<std::string>().starts_with("cannot read '" + path)) << video["warnings"];
  EXPECT_TRUE(video["vexu"].is_null());
  EXPECT_EQ(video["players"].size(), 5u);
  ASSERT_EQ(run("inject --apple " + path), 0) << err;
  EXPECT_NE(err.find("Apple's players"), std::string::npos) << err;
  ASSERT_EQ(run("inject " + path), 0) << err;
  EXPECT_EQ(probe(path)["video"]["video"][0]["vexu"]["stereo"], "top-bottom") << "it was there";
}

TEST_F(ProbeCommand, InjectWritesAnotherFileAndSaysWhatV1CannotHold) {
  const std::string path = make("video.mp4"), other = folder.path("other.mp4");
  const std::string before = folder.read("video.mp4");
  ASSERT_EQ(run("inject " + path + " -o " + other + " --layout LR --projection vr180 --yaw 90"), 0) << err;
  EXPECT_NE(err.find("V1 cannot express that"), std::string::npos) << err;
  EXPECT_EQ(folder.read("video.mp4"), before);
  const Json metadata = probe(other)["video"]["video"][0]["v2"];
  EXPECT_EQ(metadata["stereo"], "side-by-side");
  EXPECT_EQ(metadata["bounds"], Json({0, 0, 0x40000000, 0x40000000}));
  EXPECT_EQ(metadata["yaw"], 90.0);
  ASSERT_EQ(run("inject --remove " + other), 0) << err;
  EXPECT_TRUE(probe(other)["video"]["video"][0]["v2"].is_null());
}

TEST_F(ProbeCommand, ExitCodesSayWhatWasWrong) {
  const std::string path = make("video.mp4");
  for (const char* words :
       {" --projection cube-3x2", " --projection ball", " --layout ball", " --yaw 181", " --remove --yaw 3",
        " --track -1", " --track 9", " --layout bottom-top", " --layout anaglyph", " --projection fisheye"}) {
    EXPECT_EQ(run("inject " + path + words), 2) << words;
    expect_one_line();
  }
  folder.write("text.mp4", "no video at all");
  for (const char* command : {"inject ", "probe "}) {
    EXPECT_EQ(run(command + folder.path("text.mp4")), 3);
    expect_one_line();
    EXPECT_EQ(run(command + folder.path("absent.mp4")), 3);
    expect_one_line();
    EXPECT_EQ(run(command + folder.path("")), 3);
    expect_one_line();
  }
  EXPECT_EQ(run("inject " + path + " -o " + folder.path("")), 4);
  expect_one_line();
  EXPECT_EQ(run("inject " + path, 100), 4) << "files of more than 100 bytes are not allowed";
  expect_one_line();
  EXPECT_EQ(folder.read("video.mp4"), ods::made::mp4({}));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"text.mp4", "video.mp4"}));
}

TEST_F(ProbeCommand, AFullDiskLeavesTheOldVideo) {
  ods::TinyDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "skipped: this machine lets nobody mount a disk";
  ods::made::Mp4Options options;
  options.padding = 50000;
  const std::string video = ods::made::mp4(options);
  disk.folder().write("video_360_TB.mp4", video);
  EXPECT_EQ(run("inject " + disk.folder().path("video_360_TB.mp4")), 4);
  expect_one_line();
  EXPECT_EQ(disk.folder().read("video_360_TB.mp4"), video);
  EXPECT_EQ(disk.folder().names().size(), 1u);
}

TEST_F(ProbeCommand, HugeVideosNeedLittleMemory) {
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer takes all the address space";
  const std::string path = make("video_360_TB.mp4");
  // A hole of 1 GiB behind the samples, as a box of its own.
  std::ofstream(path, std::ios::app | std::ios::binary) << ods::made::number((1 << 30) + 8, 4) << "free";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) + (1 << 30));
  ASSERT_EQ(run("probe " + path, RLIM_INFINITY, rlim_t{2} << 30), 0) << err;
  EXPECT_NE(out.find("avc1"), std::string::npos);
}

TEST_F(ProbeCommand, PicturesAreProbedToo) {
  ASSERT_EQ(run("render furnace --width 16 --samples 1 -q -o " + folder.path("a_360_TB.png")), 0) << err;
  const Json picture = probe(folder.path("a_360_TB.png"))["picture"];
  EXPECT_EQ(picture["layout"], "top-bottom");
  EXPECT_EQ(picture["projection"], "lat-long");
  EXPECT_FALSE(picture["gpano"]);
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --eyes mono -q -o " + folder.path("mono.jpg")), 0) << err;
  EXPECT_TRUE(probe(folder.path("mono.jpg"))["picture"]["gpano"]);
  EXPECT_EQ(run("probe " + folder.path("mono.jpg")), 0);
  EXPECT_NE(out.find("reads GPano"), std::string::npos) << out;
}

TEST_F(ProbeCommand, PicturesAreTaggedToo) {
  const std::string mono = folder.path("a.jpg"), both = folder.path("a_360_TB.jpg"), photo = folder.path("a.vr.jpg");
  ASSERT_EQ(run("render furnace --width 32 --samples 1 -q -o " + both), 0) << err;
  ASSERT_EQ(run("convert " + both + " -q -o " + photo), 0) << err;
  const Json picture = probe(photo)["picture"];
  EXPECT_EQ(picture["right_eye"], "32x16");
  EXPECT_EQ(picture["players"][0]["takes_it_for"], "both eyes, lat-long");
  EXPECT_TRUE(picture["warnings"].empty());
  EXPECT_EQ(run("inject " + both), 3) << "GPano has no stereo";
  expect_one_line();
  ASSERT_EQ(run("convert " + both + " --eyes mono -q -o " + mono), 0) << err;
  ASSERT_EQ(run("inject --remove " + mono), 0) << err;
  EXPECT_FALSE(probe(mono)["picture"]["gpano"]);
  ASSERT_EQ(run("inject --yaw 90 " + mono), 0) << err;
  EXPECT_EQ(out, mono + "\n");
  EXPECT_NE(err.find("mono, lat-long: written"), std::string::npos) << err;
  EXPECT_EQ(run("probe " + mono), 0);
  EXPECT_NE(out.find("lat-long 360x180 degrees, yaw 90"), std::string::npos) << out;
  EXPECT_EQ(run("inject --track 1 " + mono), 2);
  expect_one_line();
}

TEST_F(ProbeCommand, APictureWhoseNameContradictsItNeedsAWord) {
  const std::string path = folder.path("a_360_LR.exr");
  ASSERT_EQ(run("render furnace --width 32 --samples 1 -q -o " + path), 0) << err;  // top-bottom
  const std::string before = folder.read("a_360_LR.exr");
  EXPECT_EQ(run("inject " + path), 3);
  expect_one_line();
  EXPECT_NE(err.find("its name ends in _LR, but it is top-bottom"), std::string::npos) << err;
  EXPECT_TRUE(folder.read("a_360_LR.exr") == before);
  ASSERT_EQ(run("inject --yaw 10 " + path), 0);
  EXPECT_NE(err.find("warning"), std::string::npos) << err;
  EXPECT_EQ(probe(path)["picture"]["layout"], "top-bottom");
  ASSERT_EQ(run("inject --layout side-by-side " + path), 0) << err;
  EXPECT_EQ(probe(path)["picture"]["layout"], "side-by-side");
}

// Beyond what the libraries take, there is room for the tables of millions of samples once, not twice.
TEST_F(ProbeCommand, InjectNeedsLittleMemory) {
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer takes all the address space";
  ods::made::Mp4Options options;
  options.table_boxes = ods::made::box("ctts", std::string(size_t{64} << 20, 'c'));
  const std::string path = make("video_360_TB.mp4", options);
  const std::string small = make("small_360_TB.mp4", {});
  rlim_t libraries = rlim_t{64} << 20;
  while (run("inject " + small, RLIM_INFINITY, libraries) != 0) {
    libraries += rlim_t{16} << 20;
    ASSERT_LT(libraries, rlim_t{4} << 30) << err;
  }
  EXPECT_EQ(run("inject " + path, RLIM_INFINITY, libraries + (rlim_t{96} << 20)), 0) << err;
}

// --- other programs --------------------------------------------------------------------------------------------------

TEST_F(ProbeCommand, ExiftoolReadsWhatWeWrite) {
  if (!ods::is_installed("exiftool")) GTEST_SKIP() << "skipped: exiftool is not installed";
  const std::string path = make("video.mp4");
  ASSERT_EQ(run("inject --layout top-bottom --projection lat-long --yaw 20 " + path), 0) << err;
  const std::string text = ods::output_of("exiftool -s -n " + path);
  for (const char* line : {"Stereoscopic3D                  : 1", "MetadataSource                  : Omnistereo",
                           "PoseYawDegrees                  : 20", "ProjectionType                  : equirectangular",
                           "StereoMode                      : top-bottom"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
}

TEST_F(ProbeCommand, FfprobeReadsWhatWeWrite) {
  if (!ods::is_installed("ffprobe")) GTEST_SKIP() << "skipped: ffprobe is not installed";
  const std::string path = make("video.mp4");
  ASSERT_EQ(run("inject --layout top-bottom --projection lat-long " + path), 0) << err;
  const std::string text = ods::output_of("ffprobe -v quiet -show_streams " + path);
  EXPECT_NE(text.find("type=top and bottom"), std::string::npos) << text;
  EXPECT_NE(text.find("projection=equirectangular"), std::string::npos) << text;
}

}  // namespace ods::video_command_test
