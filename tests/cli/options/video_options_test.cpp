// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods video: which change a frame, and which the video alone.
#include "tests/support/video_fixture.h"

namespace ods::cli_video_test {

// Every option of ods video either changes frames or the video alone: the latter may change while frames are being
// made, the former are refused by name.
class VideoOptions : public Video {
 protected:
  void SetUp() override {
    Video::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(run(job), 0) << err;
    const std::string frame = folder.path("a.mp4.frames/frame.000001.exr");
    made = std::filesystem::last_write_time(frame);
  }
  bool frames_are_those() const {
    return std::filesystem::last_write_time(folder.path("a.mp4.frames/frame.000001.exr")) == made;
  }

  const std::string job = "video furnace --width 16 --samples 1 --frames 1-2 --keep-frames -o " + folder.path("a.mp4");
  std::filesystem::file_time_type made;
};

const std::map<std::string, std::string> kVideoAlone = {
    {"--target", "youtube"},  {"--codec", "h264"},     {"--encoder", "libx264"}, {"--preset", "ultrafast"},
    {"--crf", "30"},          {"--bitrate", "1"},      {"--bits", "10"},         {"--chroma", "444"},
    {"--apple", ""},          {"--tone", "linear"},    {"--frames", "1-3"},      {"--threads", "1"},
    {"--progress", "openjd"}, {"--quiet", ""},         {"--no-color", ""},       {"--confine", "."},
    {"--keep-frames", ""},    {"--skip-existing", ""}, {"--duration", "3"},      {"--force", ""},
    {"--renderer", "ods"},                            // frames of Cycles have an identity of their own
    {"--device", "cpu"},      {"--denoise", "none"},  // frames of one sample are never denoised
};
std::map<std::string, std::string> with_circle(std::map<std::string, std::string> options) {
  for (const ods::CameraFieldRow& row : ods::camera_fields()) {
    if (!row.help.empty()) options.emplace(fmt::format("--{}", row.setting), "0.06");
  }
  return options;
}
const std::map<std::string, std::string> kOfFrames = with_circle({
    {"--scene", "0"},
    {"--variant", "red"},
    {"--solid-glass", ""},
    {"--portable", ""},
    {"--unit", "cm"},
    {"--as", "object"},
    {"--up", "z"},
    {"--light-unit", "watt"},
    {"--env", "0.5"},
    {"--env-turn", "20"},
    {"--env-strength", "0.5"},
    {"--lamp", "0,0.5,0"},
    {"--background", "0.5"},
    {"--unlit", ""},
    {"--width", "32"},
    {"--height", "10"},
    {"--eyes", "mono"},
    {"--layout", "sbs"},
    {"--camera", "other"},
    {"--position", "0,1,0"},
    {"--yaw", "10"},
    {"--pitch", "10"},
    {"--roll", "10"},
    {"--camera-preset", "google:IPD=0.1"},
    {"--merge", "none"},
    {"--merge-top", "power"},
    {"--merge-bottom", "linear"},
    {"--convergence", "shift,3"},
    {"--axis", "1,1,0"},
    {"--lens", "0.01,2"},
    {"--left-handed", ""},
    {"--projection", "vr180"},
    {"--face", "up"},
    {"--range", "-90,90"},
    {"--animation", "walk"},
    {"--fps", "25"},
    {"--turntable", "1"},
    {"--fly-to", "0,1,0"},
    {"--shutter", "180"},
    {"--grain", "changing"},
    {"--quality", "draft"},
    {"--samples", "2"},
    {"--noise", "0.05"},
    {"--exposure", "1"},
    {"--brighter", "1"},
    {"--time-limit", "1h"},
    {"--bounces", "2"},
    {"--clamp", "3"},
    {"--caustics", "path"},
    {"--indirect", "path"},
    {"--filter", "box"},
    {"--seed", "7"},
});
// These ask for other files (tested elsewhere), say where, or need another one; --time and --sidecar are refused.
const std::set<std::string> kOthers = {"--output",
                                       "--audio",
                                       "--rig",
                                       "--restart",
                                       "--size",
                                       "--merge-map",
                                       "--fov",
                                       "--lens-direction",
                                       "--time",
                                       "--only",
                                       "--wait",
                                       "--raw",
                                       "--sidecar",
                                       "--merge-map-inverted",
                                       "--head-tilt-map",
                                       "--sensor",
                                       "--lens-polynomial",
                                       "--bake",
                                       "--blender",
                                       "--blender-limit",
                                       "--with",
                                       "--at",
                                       "--turn",
                                       "--camera-file"};

TEST_F(VideoOptions, EveryOptionIsOneOrTheOther) {
  ASSERT_EQ(run("video --help"), 0);
  std::istringstream help(out);
  std::set<std::string> options;
  for (std::string line; std::getline(help, line);) {
    const size_t dashes = line.find("--");
    if (!line.starts_with("  -") || dashes > 5) continue;
    options.insert(line.substr(dashes, line.find_first_of(" ,", dashes) - dashes));
  }
  EXPECT_GT(options.size(), 60u);
  for (const std::string& option : options) {
    const size_t known = kVideoAlone.count(option) + kOfFrames.count(option) + kOthers.count(option);
    EXPECT_EQ(known, 1u)
        << option << ": does it change frames? Then ods/sequence/identity.cpp or cli/render/plan.cpp has to know it";
  }
}

TEST_F(VideoOptions, WhatChangesTheVideoAloneMayChange) {
  for (const auto& [option, value] : kVideoAlone) {
    EXPECT_EQ(run(job + " " + option + " " + value), 0) << option << err;
    EXPECT_TRUE(frames_are_those()) << option;
  }
}

TEST_F(VideoOptions, WhatChangesAFrameIsRefusedByName) {
  for (const auto& [option, value] : kOfFrames) {
    EXPECT_EQ(run(job + " " + option + " " + value), 2) << option << err;
    const std::map<std::string, std::string> kSaidAs = {
        {"--merge", "--merge-top"}, {"--camera-preset", "--ipd"}, {"--face", "--projection"}, {"--quality", "--noise"}};
    const auto other = kSaidAs.find(option);
    const std::string said = other == kSaidAs.end() ? option : other->second;
    EXPECT_NE(err.find(said + " was "), std::string::npos) << option << ": " << err;
    EXPECT_TRUE(frames_are_those()) << option;
  }
  ASSERT_EQ(run("render furnace --width 16 --samples 1 --eyes mono -q -o " + folder.path("map.png")), 0) << err;
  EXPECT_EQ(run(job + " --merge-map " + folder.path("map.png")), 2);
  EXPECT_NE(err.find("--merge-top was cosine,60,90,1, now map"), std::string::npos) << err;
  EXPECT_EQ(run(job + " --head-tilt-map " + folder.path("map.png")), 2);
  EXPECT_NE(err.find("--head-tilt-map is new"), std::string::npos) << err;
  EXPECT_EQ(run(job + " --with spheres --at 0,0,-1"), 2);
  EXPECT_NE(err.find("--with is new"), std::string::npos) << err;
  EXPECT_EQ(run(job + " --projection fisheye --fov 100 --lens-direction 20,10"), 2);
  EXPECT_NE(err.find("; and 1 more; --restart"), std::string::npos) << err;
}

// --- two at once, and what is not ours ------------------------------------------------------------------------------

}  // namespace ods::cli_video_test
