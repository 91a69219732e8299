// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods convert as its user meets it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "ods/files/atomic_file.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/cli_runner.h"
#include "tests/support/decoded_video.h"

namespace ods::cli_convert_test {

class ConvertCommand : public Cli {
 protected:
  // A stereo picture, 64x32 an eye.
  std::string make(const std::string& name, const std::string& words = "") {
    const std::string path = folder.path(name);
    EXPECT_EQ(run("render mirrors -q --width 64 --samples 1 --threads 2 -o " + path + " " + words), 0) << err;
    return path;
  }
  int convert(const std::string& from, const std::string& to, const std::string& words = "") {
    return run("convert " + from + " -o " + folder.path(to) + " " + words);
  }
  ods::StoredPicture open(const std::string& name) { return ods::open_picture(folder.path(name)); }
};

TEST_F(ConvertCommand, ToOtherProjectionsAndBack) {
  const std::string room = make("room.exr");
  for (const std::string name : {"cube-3x2", "vr180", "fisheye"}) {
    ASSERT_EQ(convert(room, name + ".exr", "--to " + name), 0) << err;
    const ods::StoredPicture made = open(name + ".exr");
    EXPECT_EQ(ods::projection_name(made.camera.projection), name);
    EXPECT_EQ(made.eyes.size(), 2u);
    EXPECT_EQ(made.eyes[0].layers.size(), 4u) << name;  // light, Z, N, albedo
    EXPECT_EQ(convert(folder.path(name + ".exr"), "back.png", "-q --to lat-long --width 32"), 0) << err;
    EXPECT_EQ(err, "");
  }
}

// The names of ods probe: it calls one eye mono.
TEST_F(ConvertCommand, MonoIsALayoutOfWhatIsRead) {
  const std::string room = make("room.png");
  ASSERT_EQ(convert(room, "one.png", "-q --layout mono --projection perspective --width 32"), 0) << err;
  EXPECT_EQ(ods::read_info(folder.path("one.png")).width, 32);
  EXPECT_EQ(run("compare --layout mono " + room + " " + room), 0) << err;
  EXPECT_EQ(convert(room, "two.png", "--to-layout mono"), 2);
  EXPECT_NE(err.find("--mono makes one eye"), std::string::npos) << err;
}

TEST_F(ConvertCommand, WhatIsNotGivenStays) {
  const std::string room = make("room.exr", "--layout bottom-top --yaw 30 --merge cosine,50,80 --ipd 0.07");
  ASSERT_EQ(convert(room, "cubes.exr", "--to cube-6x1 --yaw 15 --sidecar"), 0) << err;
  EXPECT_NE(out.find("cubes.camera.json"), std::string::npos) << out;
  const ods::StoredPicture made = open("cubes.exr");
  EXPECT_EQ(made.layout, ods::Layout::kBottomTop);
  EXPECT_FLOAT_EQ(made.camera.yaw, 45.0f);
  EXPECT_FLOAT_EQ(made.camera.ipd, 0.07f);
  EXPECT_EQ(made.camera.top.mode, ods::kMergeCosine);
  EXPECT_EQ(made.size.width, 6 * 20);
  EXPECT_NE(err.find("cube-6x1 120x20"), std::string::npos) << err;
}

TEST_F(ConvertCommand, Vr180LiesSideBySideUnlessTold) {
  const std::string room = make("room.exr", "--layout bottom-top");
  ASSERT_EQ(convert(room, "half.exr", "--to vr180"), 0) << err;
  EXPECT_EQ(open("half.exr").layout, ods::Layout::kSideBySide);
  ASSERT_EQ(convert(folder.path("half.exr"), "whole.exr", "--to lat-long --width 32"), 0) << err;
  EXPECT_EQ(open("whole.exr").layout, ods::Layout::kTopBottom);
  ASSERT_EQ(convert(room, "told.exr", "--to vr180 --to-layout bottom-top"), 0) << err;
  EXPECT_EQ(open("told.exr").layout, ods::Layout::kBottomTop);
  ASSERT_EQ(run("camera --projection vr180 --width 64"), 0) << err;
  const std::string sidecar = folder.path("a.camera.json");
  ASSERT_EQ(run("camera --for json --projection vr180 --width 64 -o " + sidecar), 0) << err;
  std::vector<std::string> warnings;
  EXPECT_EQ(ods::load_sidecar(sidecar, warnings).layout, ods::Layout::kSideBySide);
  ASSERT_EQ(run("camera --for json --camera-file " + sidecar + " --yaw 20 -o " + sidecar), 0) << err;
  EXPECT_EQ(ods::load_sidecar(sidecar, warnings).layout, ods::Layout::kSideBySide);
  ASSERT_EQ(run("camera --for json --projection vr180 --layout top-bottom --width 64 -o " + sidecar), 0) << err;
  EXPECT_EQ(ods::load_sidecar(sidecar, warnings).layout, ods::Layout::kTopBottom);
  folder.write("a.camera.json", R"({"omnistereo_camera": 1, "projection": {"name": "vr180"}})");
  EXPECT_EQ(ods::load_sidecar(sidecar, warnings).layout, ods::Layout::kSideBySide);
}

TEST_F(ConvertCommand, OptionsAreJudgedByThePicture) {
  const std::string window = make("window.exr", "--projection perspective --fov 90");
  EXPECT_EQ(convert(window, "narrow.exr", "--fov 60"), 0) << err;
  EXPECT_EQ(open("narrow.exr").camera.projection.fov, 60.0f);
  EXPECT_EQ(convert(window, "a.exr", "--range -10,10"), 2);
  EXPECT_EQ(convert(window, "a.xyz"), 2);
  EXPECT_EQ(convert(window, "new/folder/a.exr"), 0) << err;

  const std::string half = make("half.png", "--projection vr180 --sidecar");
  std::filesystem::rename(folder.path("half.camera.json"), folder.path("other.json"));
  EXPECT_EQ(convert(half, "whole.exr", "--camera-file " + folder.path("other.json")), 0) << err;
  EXPECT_EQ(open("whole.exr").layout, ods::Layout::kSideBySide);
}

TEST_F(ConvertCommand, ToItselfIsTheSamePicture) {
  const std::string room = make("room.png");
  ASSERT_EQ(convert(room, "same.png", "-q"), 0) << err;
  EXPECT_EQ(run("compare " + room + " " + folder.path("same.png") + " --max-error 0"), 0) << err << out;
  ASSERT_EQ(convert(room, "wide.png", "-q --to-layout side-by-side"), 0) << err;
  EXPECT_EQ(run("compare " + room + " " + folder.path("wide.png") + " --max-error 0"), 0) << err << out;
}

// The picture in linear light, as renderers without sRGB write it, and with an unusable profile.
TEST_F(ConvertCommand, ColourSpacesAreHonoured) {
  const std::string room = make("room_TB.png");
  const ods::Image image = ods::read_image(room);
  const auto save = [&](const std::string& name, const std::string& chunk) {
    ods::AtomicFile file(folder.path("plain.png"));
    ods::FileHeader header;
    header.width = image.width, header.height = image.height;
    for (const char* channel : {"R", "G", "B"}) header.channels.push_back({channel, ods::SampleType::kUint16});
    write_image(file, header,
                [&](int y, std::span<float> row) { std::copy_n(image.at(0, y), row.size(), row.data()); });
    file.commit();
    std::string bytes = folder.read("plain.png");
    std::ofstream(folder.path(name), std::ios::binary) << bytes.insert(ods::kPngAfterHeader, chunk);
    return folder.path(name);
  };
  const std::string linear = save("linear_TB.png", ods::png_chunk("gAMA", {"\x00\x01\x86\xa0", 4}));
  const std::string unknown = save("unknown_TB.png", ods::png_chunk("iCCP", {"a\0\0no profile", 13}));
  EXPECT_EQ(run("compare " + room + " " + linear + " --max-error 0.002"), 0) << err << out;
  ASSERT_EQ(convert(linear, "copy_TB.png"), 0) << err;
  EXPECT_EQ(err.find("sRGB"), std::string::npos) << err;
  EXPECT_EQ(run("compare " + room + " " + folder.path("copy_TB.png") + " --max-error 0"), 0) << err << out;

  const std::string warning = "'" + unknown + "': its ICC profile is damaged: taken as sRGB";
  EXPECT_EQ(run("compare " + room + " " + unknown), 0);
  EXPECT_NE(err.find(warning), std::string::npos) << err;
  EXPECT_EQ(convert(unknown, "copy_TB.png"), 0);
  EXPECT_NE(err.find("its ICC profile is damaged: taken as sRGB"), std::string::npos) << err;
  EXPECT_EQ(run("probe " + unknown), 0);
  EXPECT_NE(out.find("its ICC profile is damaged: taken as sRGB"), std::string::npos) << out;
  EXPECT_EQ(run("render axis -q --width 8 --samples 1 --env " + unknown + " -o " + folder.path("a.png")), 0);
  EXPECT_EQ(run("render axis --progress none --width 8 --samples 1 --env " + unknown + " -o " + folder.path("a.png")),
            0);
  EXPECT_NE(err.find(warning), std::string::npos) << err;
}

TEST_F(ConvertCommand, GuessesAreReported) {
  const std::string room = make("room_TB.png");
  ASSERT_EQ(convert(room, "a.png"), 0);
  EXPECT_NE(err.find("_TB"), std::string::npos) << err;
  ASSERT_EQ(convert(room, "a.png", "--projection lat-long --layout top-bottom"), 0);
  EXPECT_EQ(err.find("_TB"), std::string::npos) << err;
}

TEST_F(ConvertCommand, EyesOfTheirOwn) {
  const std::string room = make("room.exr");
  ASSERT_EQ(convert(room, "mono.png", "--mono --eyes right --pitch 20 --to perspective --fov 60 --width 20"), 0) << err;
  ASSERT_EQ(convert(room, "eye_%V.png"), 0) << err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("eye_right.png")));
  ASSERT_EQ(convert(folder.path("eye_%V.png"), "both.png", "-q"), 0) << err;
  EXPECT_EQ(convert(folder.path("mono.png"), "two.png", "--eyes both --projection perspective"), 2);
  EXPECT_NE(err.find("depth"), std::string::npos) << err;
}

TEST_F(ConvertCommand, MovesTheEyes) {
  const std::string room = make("room.exr", "--ipd 0.5");
  ASSERT_EQ(convert(room, "moved.exr", "--ipd 1.5 --merge linear,40,80"), 0) << err;
  EXPECT_NE(err.find("% of the pixels were hidden"), std::string::npos) << err;
  ASSERT_EQ(convert(room, "moved.exr", "--ipd 1.5 --merge linear,40,80 --holes empty"), 0) << err;
  EXPECT_NE(err.find("% of the pixels are empty"), std::string::npos) << err;
  EXPECT_FLOAT_EQ(open("moved.exr").camera.ipd, 1.5f);
}

TEST_F(ConvertCommand, NamesTellTheLayoutAndAreNotMisleading) {
  const std::string room = make("room.png");
  ASSERT_EQ(convert(room, "y_LR.png"), 0) << err;
  EXPECT_EQ(err.find("warning: "), std::string::npos) << err;
  EXPECT_EQ(open("y_LR.png").layout, ods::Layout::kSideBySide);
  EXPECT_EQ(open("y_LR.png").eyes.size(), 2u);
  ASSERT_EQ(convert(room, "y.png"), 0) << err;
  EXPECT_EQ(open("y.png").layout, ods::Layout::kTopBottom);
  ASSERT_EQ(convert(room, "y_LR.png", "--to-layout top-bottom"), 0) << err;
  EXPECT_NE(err.find("warning: "), std::string::npos) << err;
  EXPECT_NE(err.find("_LR"), std::string::npos) << err;
  make("z_180_LR.png", "--projection vr180");  // side-by-side by itself
  EXPECT_EQ(err.find("warning: "), std::string::npos) << err;
}

// Fisheyes and cubes in a file that calls itself 180 or 360 would mislead players; a window stays a window.
TEST_F(ConvertCommand, NamesTellTheProjection) {
  const std::string room = make("room.png");
  ASSERT_EQ(convert(room, "lenses.png", "--to-projection fisheye --to-layout side-by-side"), 0) << err;
  const std::string known = "--layout side-by-side --projection fisheye";
  ASSERT_EQ(convert(folder.path("lenses.png"), "x_180_LR.png", known), 0) << err;
  EXPECT_EQ(err.find("warning: "), std::string::npos) << err;
  EXPECT_EQ(ods::read_info(folder.path("x_180_LR.png")).width, 2 * ods::read_info(folder.path("x_180_LR.png")).height);
  ASSERT_EQ(convert(folder.path("lenses.png"), "x_180_RL.png", known + " --to fisheye"), 0) << err;
  EXPECT_NE(err.find("warning: "), std::string::npos) << err;
  ASSERT_EQ(convert(room, "window.png", "--mono --to perspective"), 0) << err;
  ASSERT_EQ(convert(folder.path("window.png"), "window_360.png", "--layout mono --projection perspective"), 0) << err;
  EXPECT_NE(err.find("warning: "), std::string::npos) << err;
}

// The circle of a wider lens shows the same directions closer to its middle.
TEST_F(ConvertCommand, TheAngleOfALensComesFromOptionsOrName) {
  const std::string room = make("room.png");
  ASSERT_EQ(convert(room, "a_FISHEYE190_LR.png", "--to fisheye --fov 190 --to-layout side-by-side"), 0) << err;
  std::filesystem::copy_file(folder.path("a_FISHEYE190_LR.png"), folder.path("b_LR.png"));
  const auto front = [&](const std::string& name, const std::string& words) {
    EXPECT_EQ(convert(folder.path(name), "front.png", "-q --mono --to vr180 --width 64 " + words), 0) << err;
    return ods::read_image(folder.path("front.png")).pixels;
  };
  const std::vector<float> named = front("a_FISHEYE190_LR.png", "");
  EXPECT_EQ(front("b_LR.png", "--projection fisheye --input-fov 190"), named);
  EXPECT_NE(front("b_LR.png", "--projection fisheye"), named);
  EXPECT_EQ(convert(folder.path("b_LR.png"), "no.png", "--projection lat-long --input-fov 190"), 2);
  EXPECT_NE(err.find("--input-fov is for"), std::string::npos) << err;
}

TEST_F(ConvertCommand, OverwritesNothingItReads) {
  const std::string room = make("room.png"), before = folder.read("room.png");
  EXPECT_EQ(convert(room, "room.png", "--mono"), 2);
  EXPECT_EQ(convert(room, "../" + std::filesystem::path(room).parent_path().filename().string() + "/room.png"), 2);
  EXPECT_NE(err.find("overwritten"), std::string::npos) << err;
  EXPECT_EQ(run("compare " + room + " " + room + " --diff " + room), 2);
  EXPECT_EQ(run("camera --for json -o " + room), 2);
  EXPECT_EQ(folder.read("room.png"), before);
}

TEST_F(ConvertCommand, TitlesGoOverFrames) {
  for (const char* number : {"1", "2", "3"}) make("shot_TB." + std::string(number) + ".png");
  const std::string titles = folder.path("title.#.exr");
  ASSERT_EQ(run("title End --at 0,0,2 --text-height 1 --width 64 --frames 1-2 --fps 2 --fade-in 1 -o " + titles), 0)
      << err;
  const std::string shots = folder.path("shot_TB.#.png"), made = folder.path("made_TB.#.png");
  ASSERT_EQ(run("over " + titles + " " + shots + " -q -o " + made), 0) << err;
  const auto differs = [&](const std::string& number) {
    return run("compare " + folder.path("shot_TB." + number + ".png") + " " +
               folder.path("made_TB." + number + ".png") + " --max-error 0.1") == 5;
  };
  EXPECT_TRUE(differs("2"));
  EXPECT_FALSE(differs("3")) << out;  // no title there
  EXPECT_EQ(run("over " + titles + " " + shots + " --frames 3 -o " + made), 0) << err;
  EXPECT_NE(err.find("(1-2) has the same number as one of"), std::string::npos) << err;
  EXPECT_EQ(run("over " + titles + " " + shots + " -o " + shots), 2);
  EXPECT_EQ(run("title End -o " + folder.path("title.exr") + " --fade-in 1"), 2);
  EXPECT_EQ(run("title \\n -o " + folder.path("title.exr")), 2);
  EXPECT_EQ(run("title End --at 1,2 -o " + folder.path("title.exr")), 2);
  EXPECT_EQ(run("title End -o " + folder.path("title.jpg")), 2);
}

TEST_F(ConvertCommand, RefusalsSayWhy) {
  const std::string room = make("room.png");
  const std::vector<std::vector<std::string>> cases = {
      {"--pitch 5", "yaw"},
      {"--ipd 0.1", ".exr"},
      {"--to latlong", "did you mean 'lat-long'?"},
      {"--to cube-3x2 --width 100", "multiple of 3"},
      {"--to lat-long --fov 40", "--fov is for"},
      {"--to fisheye --face up", "--face is for"},
      {"--range 0,1e-20", "0.01 degrees"},
      {"--merge-map-inverted", "--merge-map FILE"},
      {"--height 40", "--width"},
      {"--layout tob", "--layout"},
  };
  for (const auto& one : cases) {
    EXPECT_EQ(convert(room, "no.png", one[0]), 2) << one[0];
    EXPECT_NE(err.find(one[1]), std::string::npos) << one[0] << ": " << err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("no.png")));
  }
  EXPECT_EQ(run("convert " + room), 2);
  EXPECT_EQ(convert(folder.path("absent.png"), "no.png"), 3);
  EXPECT_EQ(convert(room, "no.bmp"), 2);
}

// docs/cameras.md lists these FFmpeg options.
TEST_F(ConvertCommand, OurCubesAreThoseOfV360InItsWords) {
  if (!ods::is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  const int width = 512, height = 256;
  ods::Picture sphere;  // smooth, so that filters do not matter, and different everywhere
  sphere.eyes.push_back({ods::kMono, ods::Image(width, height, 3), {}, {}, {}});
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      const float right = (static_cast<float>(x) + 0.5f) / width * 6.2831853f - 3.14159265f;
      const float up = 1.57079633f - (static_cast<float>(y) + 0.5f) / height * 3.14159265f;
      const float d[] = {std::sin(right) * std::cos(up), std::sin(up), -std::cos(right) * std::cos(up)};
      for (int c = 0; c < 3; c++) {
        sphere.eyes[0].radiance.at(x, y)[c] = 0.3f + 0.2f * std::sin(2.0f * d[c] + 0.8f * static_cast<float>(c));
      }
    }
  }
  save_picture(sphere, ods::StereoCamera(), ods::SaveOptions(), folder.path("sphere_360.png"));
  const auto worst = [&](const std::string& one, const std::string& other) {
    const std::string raw = " -f rawvideo -pix_fmt rgb24 -";
    const std::string a = ods::output_of("ffmpeg -v error -i " + folder.path(one) + raw);
    const std::string b = ods::output_of("ffmpeg -v error -i " + folder.path(other) + raw);
    int maximum = a.size() == b.size() && !a.empty() ? 0 : 255;
    for (size_t i = 0; maximum < 255 && i < a.size(); i++) {
      maximum = std::max(maximum, std::abs(static_cast<unsigned char>(a[i]) - static_cast<unsigned char>(b[i])));
    }
    return maximum;
  };
  const auto filter = [&](const std::string& from, const std::string& words, const std::string& to) {
    ods::output_of("ffmpeg -v error -y -i " + folder.path(from) + " -vf v360=" + words + ":interp=cubic " +
                   folder.path(to));
  };
  const std::tuple<const char*, int, const char*, const char*, int> kCubes[] = {
      {"cube-3x2", 384, "c3x2", ":{0}forder=fudrbl:{0}frot=022000", 3},
      {"cube-6x1", 768, "c6x1", ":{0}forder=rlbfud:{0}frot=312002", 3},
      {"cube-1x6", 128, "c1x6", ":{0}forder=rlbfud:{0}frot=312002", 3},
      {"eac", 384, "eac", "", 9}};  // which it pads
  for (const auto& [name, across, v360, words, maximum] : kCubes) {
    ASSERT_EQ(convert(folder.path("sphere_360.png"), "ours.png", fmt::format("-q --to {} --width {}", name, across)),
              0);
    const ods::Extent size = open("ours.png").size;
    const auto with = [words = words](const char* side) { return fmt::format(fmt::runtime(words), side); };
    filter("sphere_360.png", fmt::format("e:{}{}:w={}:h={}", v360, with("out_"), size.width, size.height),
           "theirs.png");
    EXPECT_LE(worst("ours.png", "theirs.png"), maximum) << name;
    filter("ours.png", fmt::format("{}:e{}:w={}:h={}", v360, with("in_"), width, height), "back.png");
    EXPECT_LE(worst("back.png", "sphere_360.png"), maximum) << name;
  }
}

}  // namespace ods::cli_convert_test
