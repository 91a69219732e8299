// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods convert with depth beside the input, as its user meets it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "ods/picture/stored_picture.h"
#include "tests/support/cli_runner.h"

namespace ods::convert_depth_command_test {

class ConvertDepth : public Cli {
 protected:
  void run_well(const std::string& words) { ASSERT_EQ(run(in_folder(words)), 0) << words << "\n" << err; }

  std::string in_folder(std::string words) const {
    for (size_t at = 0; (at = words.find('@', at)) != std::string::npos;) words.replace(at, 1, folder.path(""));
    return words;
  }

  ods::StoredPicture open(const std::string& name) { return ods::open_picture(folder.path(name)); }

  // In minutes of arc, as ods comfort measures it.
  double worst_vertical(const std::string& name) {
    const int code = run(in_folder("comfort @" + name + " --json"));
    EXPECT_TRUE(code == 0 || code == 5) << err;
    const size_t at = out.find("\"vertical\": ");
    return at == std::string::npos ? -1.0 : std::atof(out.c_str() + at + 12);
  }

  // Metres, 64x32: a level ceiling this far above, a floor this far below, and all else far away.
  static std::string room_depth(float ceiling, float floor = 50.0f) {
    std::string file = "Pf\n64 32\n-1\n";
    for (int y = 31; y >= 0; y--) {
      for (int x = 0; x < 64; x++) {
        const float up = std::sin((0.5f - (static_cast<float>(y) + 0.5f) / 32.0f) * 3.14159265f);
        const float metres =
            up > 0.0f ? std::min(ceiling / up, 40.0f + static_cast<float>(x)) : std::min(floor / -up, 50.0f);
        file.append(reinterpret_cast<const char*>(&metres), sizeof metres);
      }
    }
    return file;
  }

  // A mono panorama without depth, and its depth.
  void make_panorama(const std::string& scene = "mirrors") {
    run_well("render " + scene + " -q --eyes mono --width 64 --samples 1 --threads 2 -o @depth.exr");
    run_well("convert @depth.exr -q -o @panorama.png");
  }
};

TEST_F(ConvertDepth, MakesTwoEyesOfOne) {
  make_panorama();
  run_well("convert @panorama.png --depth @depth.exr -q -o @stereo_360_TB.exr");
  const ods::StoredPicture made = open("stereo_360_TB.exr");
  EXPECT_EQ(made.eyes.size(), 2u);
  EXPECT_EQ(made.size.width, 64);
  EXPECT_EQ(made.layout, ods::Layout::kTopBottom);
  EXPECT_EQ(made.eyes[0].layers[0].channels.size(), 3u);  // no alpha: there are no holes
  EXPECT_EQ(made.camera.top, ods::kUsualMerge);
  EXPECT_FLOAT_EQ(made.camera.ipd, 0.065f);
  run_well("convert @panorama.png --depth @depth.exr --ipd 0.6 -o @wide.exr");
  EXPECT_NE(err.find("filled from their neighbours"), std::string::npos) << err;
  run_well("convert @panorama.png --depth @depth.exr --holes empty --ipd 0.2 --merge none -q -o @holes.exr");
  EXPECT_EQ(open("holes.exr").eyes[0].layers[0].channels.size(), 4u);
  EXPECT_FLOAT_EQ(open("holes.exr").camera.ipd, 0.2f);
  // The same depth gives the same result as the layer of the file itself.
  run_well("convert @depth.exr --eyes both --merge none -q -o @by_layer.png");
  run_well("convert @panorama.png --depth @depth.exr --merge none -q -o @by_file.png");
  EXPECT_EQ(run(in_folder("compare @by_layer.png @by_file.png --min-psnr 24")), 0) << out << err;
}

TEST_F(ConvertDepth, MergesByDepth) {
  make_panorama("room");
  for (const char* words : {"@panorama.png --depth @depth.exr", "@depth.exr --eyes both"}) {
    run_well(std::string("convert ") + words + " --merge auto,20 --sidecar -o @auto.exr");
    EXPECT_NE(err.find("merge by depth: full stereo up to "), std::string::npos) << err;
    const ods::StoredPicture made = open("auto.exr");
    EXPECT_EQ(made.camera.top.mode, ods::kMergeMap);
    ASSERT_TRUE(made.camera.merge_map);
    EXPECT_LT(made.camera.merge_map->pixels.front(), 0.5f);  // the ceiling is low
    EXPECT_EQ(made.camera.merge_map->pixels[made.camera.merge_map->pixels.size() / 2], 1.0f);
  }
  // A stereo picture that exists.
  run_well("render room -q --width 64 --samples 1 --merge none --ipd 0.2 -o @stereo.exr");
  run_well("convert @stereo.exr --merge auto -o @calm.exr");
  EXPECT_NE(err.find("filled from their neighbours"), std::string::npos) << err;
  EXPECT_EQ(err.find("empty: "), std::string::npos) << err;
  // The limit holds in what came out, and is used.
  run_well("render room -q --width 256 --samples 1 --merge none -o @large.exr");
  run_well("convert @large.exr --merge auto,30 --sidecar -q -o @fixed.exr");
  EXPECT_GE(worst_vertical("large.exr"), 60.0);
  EXPECT_LE(worst_vertical("fixed.exr"), 31.0);
  EXPECT_GE(worst_vertical("fixed.exr"), 20.0);
  EXPECT_EQ(run(in_folder("convert @panorama.png --merge auto -o @no.png")), 0) << err;
  EXPECT_NE(err.find("have no effect on one eye"), std::string::npos) << err;
  EXPECT_EQ(run(in_folder("convert @panorama.png --eyes both --merge auto -o @no.png")), 2);
}

// A ceiling comes down over the viewer, and goes again.
TEST_F(ConvertDepth, TheMergeOfAVideoFollowsItsDepthSteadily) {
  make_panorama();
  constexpr int kFrames = 41;
  for (int i = 0; i < kFrames; i++) {
    folder.write("depth." + std::to_string(i) + ".pfm", room_depth(i < 4 ? 0.6f : 30.0f));
    std::filesystem::copy(folder.path("panorama.png"), folder.path("panorama." + std::to_string(i) + ".png"));
  }
  run_well("encode -q --fps 4 --projection lat-long --layout separate @panorama.#.png -o @mono_360.mp4");
  run_well("convert @mono_360.mp4 --depth @depth.#.pfm --merge auto --sidecar -o @made_360_TB.####.exr");
  EXPECT_NE(err.find("where the depth allows least; more elsewhere"), std::string::npos) << err;
  float before = -1.0f;
  for (int i = 0; i < kFrames; i++) {
    char name[32];
    std::snprintf(name, sizeof name, "made_360_TB.%04d.exr", i);
    const auto map = open(name).camera.merge_map;
    ASSERT_TRUE(map) << name;
    const float up = map->pixels.front();
    if (i < 4) {
      EXPECT_LT(up, 0.2f) << name;
    }
    if (i > 38) {
      EXPECT_EQ(up, 1.0f) << name;
    }
    if (i > 0) {
      EXPECT_LE(std::abs(up - before), 0.06f) << name << ": it pumps";
    }
    EXPECT_EQ(map->pixels[map->pixels.size() / 2], 1.0f);
    before = up;
  }
  run_well("convert @mono_360.mp4 --depth @depth.#.pfm --merge auto -q -o @made_360_TB.mp4");
  // Frames give the same result, whichever process makes them.
  run_well(
      "convert @panorama.#.png --fps 4 --depth @depth.#.pfm --merge auto --only 2/2 -q --sidecar -o "
      "@part_360_TB.#.exr");
  EXPECT_EQ(open("part_360_TB.21.exr").camera.merge_map->pixels, open("made_360_TB.0021.exr").camera.merge_map->pixels);
  EXPECT_EQ(run(in_folder("convert @mono_360.mp4 --eyes both --merge auto -o @no.mp4")), 2);
  EXPECT_NE(err.find("--depth FILE"), std::string::npos) << err;
  folder.write("turns.txt", "0 1\n");
  EXPECT_EQ(run(in_folder("convert @mono_360.mp4 --depth @depth.#.pfm --merge auto --stabilize @turns.txt -o @no.mp4")),
            2);
  EXPECT_NE(err.find("exclude each other"), std::string::npos) << err;
}

// The camera sinks: each frame's floor would give another scale.
TEST_F(ConvertDepth, TheScaleOfAnEyeHeightIsOneForAllShares) {
  make_panorama();
  for (int i = 0; i < 4; i++) {
    folder.write("depth." + std::to_string(i) + ".pfm", room_depth(2.5f, 0.4f + 0.2f * static_cast<float>(i)));
    std::filesystem::copy(folder.path("panorama.png"), folder.path("panorama." + std::to_string(i) + ".png"));
  }
  const std::string words = "convert @panorama.#.png --depth @depth.#.pfm --eye-height 1.6 -q -o ";
  run_well(words + "@whole.#.png");
  run_well(words + "@share.#.png --only 2/2");
  run_well(words + "@share.#.png --skip-existing");
  for (const char* number : {"0", "1", "2", "3"}) {
    EXPECT_EQ(folder.read(std::string("share.") + number + ".png"),
              folder.read(std::string("whole.") + number + ".png"))
        << number;
  }
  // A video's frames have no numbers.
  run_well("encode -q --fps 4 --projection lat-long --layout separate @panorama.#.png -o @depth_360.mp4");
  EXPECT_EQ(run(in_folder("convert @panorama.#.png --depth @depth_360.mp4 --depth-kind inverse --near 1 --only 2/2 "
                          "-o @no.#.png")),
            2);
  EXPECT_NE(err.find("need the depth as frames"), std::string::npos) << err;
}

TEST_F(ConvertDepth, MistakesHaveTheirExitCodes) {
  make_panorama();
  folder.write("zero.pfm", "Pf\n4 2\n-1\n" + std::string(32, '\0'));
  folder.write("square.pfm", "Pf\n2 2\n-1\n" + std::string(16, 'A'));
  folder.write("broken.npy", "\x93NUMPY");
  folder.write("broken.pfm", "Pf\n16" + std::string(250, 'x'));
  const std::tuple<const char*, int, const char*> kFaults[] = {
      {"@panorama.png --eyes both", 2, "--depth FILE"},
      {"@panorama.png --ipd 0.06 --eyes both", 2, "--depth FILE"},
      {"@panorama.png --near 1", 2, "--near goes with --depth"},
      {"@panorama.png --depth @absent.png", 3, "absent.png"},
      {"@panorama.png --depth @zero.pfm", 3, "0 everywhere"},
      {"@panorama.png --depth @square.pfm", 3, "another shape"},
      {"@panorama.png --depth @broken.npy", 3, "broken.npy"},
      {"@panorama.png --depth @broken.pfm", 3, "broken.pfm"},
      {"@panorama.png --depth @panorama.png", 3, "colours"},
      {"@panorama.png --depth @depth.exr --depth-kind relative", 2, "both ends"},
      {"@panorama.png --depth @depth.exr --depth-along axis", 2, "no axis"},
      {"@panorama.png --depth @depth.exr --depth-kind feet", 2, "--depth-kind"}};
  for (const auto& [words, code, says] : kFaults) {
    EXPECT_EQ(run(in_folder(std::string("convert ") + words + " -o @no.png")), code) << words << "\n" << err;
    const size_t start = err.rfind("ods: error: ");
    ASSERT_NE(start, std::string::npos) << words << "\n" << err;
    EXPECT_EQ(err.find('\n', start), err.size() - 1) << err;
    EXPECT_NE(err.find(says, start), std::string::npos) << words << "\n" << err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("no.png"))) << words;
  }
}

TEST_F(ConvertDepth, FramesAndVideos) {
  make_panorama();
  for (const char* number : {"1", "2", "3"}) {
    for (const char* name : {"panorama", "depth"}) {
      const std::string kind = name == std::string("depth") ? ".exr" : ".png";
      std::filesystem::copy(folder.path(name + kind), folder.path(std::string(name) + "." + number + kind));
    }
  }
  run_well("convert @panorama.#.png --depth @depth.#.exr -q -o @stereo_360_TB.#.exr");
  EXPECT_EQ(open("stereo_360_TB.2.exr").eyes.size(), 2u);
  run_well("convert @panorama.#.png --depth @depth.exr --merge auto --sidecar -o @merged_360_TB.#.exr");
  EXPECT_EQ(open("merged_360_TB.3.exr").camera.top.mode, ods::kMergeMap);
  run_well("convert @panorama.#.png --depth @depth.#.exr -q -o @stereo_360_TB.mp4");
  // A video with frames of depth, and with a video of depth: near is white.
  run_well("encode -q --projection lat-long --layout separate @panorama.#.png -o @mono_360.mp4");
  run_well("convert @mono_360.mp4 --depth @depth.#.exr -q -o @a_360_TB.mp4");
  run_well(
      "convert @mono_360.mp4 --depth @mono_360.mp4 --depth-kind inverse --near 1 --far 9 -q -o @b_360_TB.####.png");
  EXPECT_EQ(open("b_360_TB.0002.png").eyes.size(), 2u);
  std::filesystem::remove(folder.path("depth.3.exr"));
  EXPECT_EQ(run(in_folder("convert @mono_360.mp4 --depth @depth.#.exr -q -o @c_360_TB.mp4")), 3) << err;
  EXPECT_NE(err.find("ends before"), std::string::npos) << err;
}

}  // namespace ods::convert_depth_command_test
