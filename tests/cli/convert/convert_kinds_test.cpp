// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Kinds of files from elsewhere that were once read wrongly: all commands give one answer, and a reason.
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/exr_files.h"
#include "tests/support/programs.h"
#include "tests/support/simulated_camera.h"
#include "tests/support/unknown_files.h"

namespace ods::convert_kinds_test {

class ConvertKinds : public Cli {
 protected:
  // Two cameras that look ahead.
  void write_pair(const std::string& name, std::optional<Layout> layout, const char* projection, Extent size) const {
    const TwoEyes eyes = [](int eye, const ProjectionSetting& setting, Extent extent) {
      StereoCamera camera;
      camera.projection = setting;
      return seen_in(World::kHall, camera, eye, extent, true);
    };
    ProjectionSetting setting = find_projection(projection)->setting;
    if (setting.kind == kPerspective) setting.aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    write_unknown(folder.path(name), {layout, setting}, eyes, size);
  }

  // Two lenses of a camera, in halves of these sizes.
  void write_lenses(const std::string& name, Extent half, float radius, float fov, float second_yaw) const {
    SimulatedCamera camera;
    camera.half = half;
    for (FisheyeLens& lens : camera.lenses) {
      lens.center = 0.5f * vec2(static_cast<float>(half.width), static_cast<float>(half.height));
      lens.radius = radius, lens.fov = fov;
    }
    camera.lenses[1].yaw = second_yaw;
    const LensWorld shown = [&](int which, vec3 direction) {
      // Two eyes: the right one is first.
      const vec3 from(second_yaw == 0.0f ? (which == 0 ? 0.032f : -0.032f) : 0.0f, 0.0f, 0.0f);
      const float light = dot(world_at(World::kHall, from, direction), vec3(0.3f, 0.6f, 0.1f));
      return std::pow(std::clamp(light, 0.0f, 1.0f), 1.0f / 2.2f);
    };
    write_raw_file(folder.path(name), camera, shown, 90);
  }

  nlohmann::json probe(const std::string& name) {
    EXPECT_EQ(run("probe " + folder.path(name) + " --json"), 0) << err;
    return nlohmann::json::parse(out).at("picture");
  }

  static void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
  }
};

// Nobody asked for what the circles decide.
TEST_F(ConvertKinds, LensesOfACameraGiveTheReason) {
  write_lenses("glow.jpg", {480, 480}, 236, 195, 180);
  expect_in(probe("glow.jpg").at("reason"), "two fisheyes that look ahead and back, 19");
  ASSERT_EQ(run("probe " + folder.path("glow.jpg")), 0) << err;
  expect_in(out, "two fisheyes, ahead and back: its pixels show");
  EXPECT_EQ(out.find("as asked"), std::string::npos) << out;
  EXPECT_EQ(run("inject " + folder.path("glow.jpg")), 3);
  expect_in(err, "two fisheyes that look ahead and back");

  write_lenses("canon.jpg", {540, 720}, 244, 190, 0);
  const nlohmann::json canon = probe("canon.jpg");
  EXPECT_EQ(canon.at("layout"), "cross-eyed");
  expect_in(canon.at("reason"), "a pair of fisheyes whose circles do not touch the edges, the right eye first");
  ASSERT_EQ(run("convert " + folder.path("canon.jpg") + " -o " + folder.path("c_180_LR.jpg")), 0) << err;
  run("lint " + folder.path("c_180_LR.jpg"));
  EXPECT_EQ(out.find("eyes-swapped"), std::string::npos) << out;
}

// FFmpeg's v360 leaves no corners black.
TEST_F(ConvertKinds, FisheyesThatFillTheirHalvesBecomeASphere) {
  write_lenses("filled.jpg", {480, 480}, 341, 270, 180);
  expect_in(probe("filled.jpg").at("reason"), "look ahead and back");
  EXPECT_EQ(run("convert " + folder.path("filled.jpg") + " -o " + folder.path("world_360.jpg")), 0) << err;
}

TEST_F(ConvertKinds, AnAnaglyphIsFlat) {
  write_pair("red_cyan.jpg", Layout::kAnaglyph, "perspective", {640, 480});
  const nlohmann::json picture = probe("red_cyan.jpg");
  EXPECT_EQ(picture.at("layout"), nullptr);
  EXPECT_EQ(picture.at("projection"), "perspective");
  ASSERT_EQ(run("probe " + folder.path("red_cyan.jpg")), 0) << err;
  expect_in(out, "mono, perspective: nothing tells what it shows: it looks flat");
  expect_in(out, "it may be an anaglyph");
  for (const char* command : {"inject", "convert -o x_LR.jpg"}) {
    EXPECT_EQ(run(std::string(command) + " " + folder.path("red_cyan.jpg")), 3) << command;
    expect_in(err, "anaglyph");
  }
}

// Without detail and with the shape of neither one sphere nor two, a picture looks flat for every command.
TEST_F(ConvertKinds, AShapeOfNoSphereIsFlat) {
  const TwoEyes grey = [](int, const ProjectionSetting&, Extent size) {
    Image image(size.width, size.height, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), 0.2f);
    return image;
  };
  write_unknown(folder.path("grey.jpg"), {std::nullopt, find_projection("perspective")->setting}, grey, {640, 480});
  EXPECT_EQ(probe("grey.jpg").at("projection"), "perspective");
  run("lint " + folder.path("grey.jpg") + " --json");
  EXPECT_EQ(nlohmann::json::parse(out).at("projection"), "perspective");
  EXPECT_EQ(run("convert " + folder.path("grey.jpg") + " -o " + folder.path("x_360.jpg")), 3);
  expect_in(err, "its pixels show too little");
}

TEST_F(ConvertKinds, TheNameOfALensHasItsAngle) {
  write_lenses("toys_FISHEYE190_LR.jpg", {480, 480}, 240, 190, 0);
  EXPECT_EQ(probe("toys_FISHEYE190_LR.jpg").at("projection"), "fisheye");
  ASSERT_EQ(run("convert " + folder.path("toys_FISHEYE190_LR.jpg") + " -o " + folder.path("t_180_LR.jpg")), 0) << err;
  write_lenses("toys_fisheye_LR.jpg", {480, 480}, 240, 190, 0);
  ASSERT_EQ(run("convert " + folder.path("toys_fisheye_LR.jpg") + " --input-fov 190 -o " + folder.path("u_180_LR.jpg")),
            0)
      << err;
  EXPECT_EQ(folder.read("t_180_LR.jpg"), folder.read("u_180_LR.jpg"));
}

TEST_F(ConvertKinds, InterlacedVideosAreToldAndRefused) {
  if (const std::string why = missing("ffmpeg", "ffmpeg -version"); !why.empty()) GTEST_SKIP() << why;
  const std::string path = folder.path("fields_360_TB.mp4");
  ASSERT_EQ(run_line("ffmpeg -v error -f lavfi -i testsrc=s=128x128 -frames:v 4 -c:v libx264 -flags +ildct+ilme "
                     "-x264opts tff=1 -pix_fmt yuv420p " +
                     path)
                .code,
            0);
  ASSERT_EQ(run("probe " + path), 0) << err;
  expect_in(out, "its pictures are interlaced; ffmpeg -i");
  EXPECT_EQ(run("convert " + path + " -o " + folder.path("i_180_LR.mp4") + " --to vr180"), 3);
  expect_in(err, "its pictures are interlaced; ffmpeg -i");
}

// YouTube's frames of 16:9 divide into faces of equal size only at some widths.
TEST_F(ConvertKinds, FacesMayBeginWithinAPixel) {
  const TwoEyes world = [](int eye, const ProjectionSetting& setting, Extent size) {
    StereoCamera camera;
    camera.projection = setting;
    return seen_in(World::kHall, camera, eye, size);
  };
  write_unknown(folder.path("eac.jpg"), {std::nullopt, find_projection("eac")->setting}, world, {1000, 562});
  for (const char* words : {"", " --projection eac --layout separate --to lat-long"}) {
    ASSERT_EQ(run("convert " + folder.path("eac.jpg") + words + " -o " + folder.path("w_360.jpg")), 0) << err;
    ASSERT_EQ(run("lint " + folder.path("w_360.jpg")), 0) << out;
  }
}

TEST_F(ConvertKinds, AFlatPairIsNotSqueezed) {
  write_pair("pair.jpg", Layout::kSideBySide, "perspective", {640, 480});
  EXPECT_EQ(probe("pair.jpg").at("layout"), "side-by-side");
  run("lint " + folder.path("pair.jpg") + " --json");
  const nlohmann::json report = nlohmann::json::parse(out);
  EXPECT_EQ(report.at("layout"), "side-by-side");
  EXPECT_EQ(report.at("projection"), "perspective");
  EXPECT_EQ(out.find("side-by-side-half"), std::string::npos) << out;
}

// Circles that touch the edges of a cross-eyed pair: its new name promises the front half of the sphere.
TEST_F(ConvertKinds, ACrossEyedPairOfFisheyesBecomesWhatItsNamePromises) {
  write_lenses("IMG_0042.JPG", {512, 512}, 256, 180, 0);
  EXPECT_EQ(probe("IMG_0042.JPG").at("layout"), "cross-eyed");
  ASSERT_EQ(run("convert " + folder.path("IMG_0042.JPG") + " -o " + folder.path("talk_180_LR.jpg")), 0) << err;
  EXPECT_EQ(probe("talk_180_LR.jpg").at("projection"), "vr180");
  run("lint " + folder.path("talk_180_LR.jpg"));
  EXPECT_EQ(out.find("eyes-swapped"), std::string::npos) << out;
}

// Programs for compositing crop each eye by itself.
TEST_F(ConvertKinds, EyesOfAnExrMayBeCropped) {
  ExrForm left, right;
  for (ExrForm* form : {&left, &right}) {
    form->width = 96, form->height = 64, form->left = 16, form->top = 32;
    form->prepare = [form, &left](Imf::Header& header) {
      header.displayWindow() = Imath::Box2i({0, 0}, {255, 127});
      header.setView(form == &left ? "left" : "right");
      header.setName(form == &left ? "rgb.left" : "rgb.right");
    };
  }
  right.left = 64;
  const std::vector<Imath::half> values(size_t{3} * 96 * 64, Imath::half(0.5f));
  const std::vector<std::byte> pixels(bytes_of_pixels(left));
  std::vector<std::vector<std::byte>> parts(2, pixels);
  for (std::vector<std::byte>& part : parts) std::memcpy(part.data(), values.data(), part.size());
  write_exr(folder.path("cropped.exr"), {left, right}, parts);
  const nlohmann::json picture = probe("cropped.exr");
  EXPECT_EQ(picture.at("layout"), "multiview");
  EXPECT_EQ(picture.at("size"), nlohmann::json({256, 128}));
  ASSERT_EQ(run("convert " + folder.path("cropped.exr") + " -o " + folder.path("eyes_360_TB.png")), 0) << err;
  const Image eyes = read_image(folder.path("eyes_360_TB.png"));
  ASSERT_EQ(eyes.width, 256);
  ASSERT_EQ(eyes.height, 256);
  const auto is_lit = [&](int x, int y) { return eyes.at(x, y)[0] > 0.01f; };
  EXPECT_TRUE(is_lit(20, 40) && !is_lit(120, 40)) << "the left eye's window is 16..111";
  EXPECT_TRUE(is_lit(120, 168) && !is_lit(20, 168)) << "the right eye's window is 64..159";
}

void write_deep_exr(const std::string& path) {
  constexpr int kWidth = 16, kHeight = 8;
  Imf::Header header(kWidth, kHeight);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  std::vector<unsigned> counts(kWidth * kHeight, 1);
  std::vector<float> depths(counts.size(), 2.0f);
  std::vector<float*> samples;
  for (float& depth : depths) samples.push_back(&depth);
  Imf::DeepFrameBuffer frame;
  const auto bytes = [](auto& values) { return reinterpret_cast<char*>(values.data()); };
  frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, bytes(counts), sizeof(unsigned), kWidth * sizeof(unsigned)));
  frame.insert("Z", Imf::DeepSlice(Imf::FLOAT, bytes(samples), sizeof(float*), kWidth * sizeof(float*), sizeof(float)));
  Imf::DeepScanLineOutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(kHeight);
}

TEST_F(ConvertKinds, ADeepExrNamesTheWayOut) {
  write_deep_exr(folder.path("deep.exr"));
  for (const char* command : {"probe ", "lint ", "convert -o x.png "}) {
    EXPECT_EQ(run(command + folder.path("deep.exr")), 3);
    expect_in(err, "it is a deep image, with many depths in a pixel: flatten it");
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  }
}

TEST_F(ConvertKinds, RowsOfAVideoAreTakenApart) {
  if (const std::string why = missing("ffmpeg", "ffmpeg -version"); !why.empty()) GTEST_SKIP() << why;
  // Red rows for the left eye, blue ones for the right eye.
  const std::string path = folder.path("rows.mkv"), output = folder.path("rows_360_TB.mp4");
  ASSERT_EQ(run_line("ffmpeg -v error -f lavfi -i \"color=s=128x128,format=gbrp,geq=r='255*(1-mod(Y,2))':g=0:"
                     "b='255*mod(Y,2)'\" -frames:v 4 -c:v libx264 -pix_fmt yuv444p -metadata:s:v "
                     "stereo_mode=row_interleaved_lr " +
                     path)
                .code,
            0);
  ASSERT_EQ(run("inject " + path + " --projection lat-long"), 0) << err;
  ASSERT_EQ(run("probe " + path), 0) << err;
  expect_in(out, "row-interleaved, lat-long");
  EXPECT_EQ(out.find("does not fit"), std::string::npos) << out;
  ASSERT_EQ(run("convert " + path + " -o " + output), 0) << err;
  ASSERT_EQ(run("probe " + output), 0) << err;
  expect_in(out, "top-bottom, lat-long");
  ASSERT_EQ(run_line("ffmpeg -v error -i " + output + " -frames:v 1 " + folder.path("f.png")).code, 0);
  const Image frame = read_image(folder.path("f.png"));
  const float* const left = frame.at(frame.width / 2, frame.height / 4);
  const float* const right = frame.at(frame.width / 2, frame.height * 3 / 4);
  EXPECT_GT(left[0], left[2] + 0.5f);
  EXPECT_GT(right[2], right[0] + 0.5f);
}

TEST_F(ConvertKinds, AGoProsPreviewIsTold) {
  if (const std::string why = missing("ffmpeg", "ffmpeg -version"); !why.empty()) GTEST_SKIP() << why;
  const std::string path = folder.path("GL010001.LRV");
  ASSERT_EQ(
      run_line("ffmpeg -v error -f lavfi -i testsrc=s=256x128 -frames:v 4 -c:v libx264 -pix_fmt yuv420p -f mp4 " + path)
          .code,
      0);
  ASSERT_EQ(
      run("convert " + path + " --layout separate --projection lat-long --to vr180 -o " + folder.path("x_180.mp4")), 0)
      << err;
  expect_in(err, "a camera's preview of low resolution: the recording beside it has the same number");
}

}  // namespace ods::convert_kinds_test
