// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files whose metadata, names and options contradict each other, by the table "Which metadata win" of docs/foreign.md.
// Each test gives all of them, then leaves out the strongest, then the next one. (Right eyes and extended XMP:
// vr_photo_test; meshes: mesh_box_test.)
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/image/format/png_chunks.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/video/video_input.h"
#include "tests/support/cli_runner.h"
#include "tests/support/tagged_videos.h"

namespace ods::which_word_wins_test {

ProjectionSetting named(const char* name) {
  return find_projection(name)->setting;
}

Picture one_eye() {
  Picture picture;
  picture.eyes.resize(1);
  picture.eyes[0].eye = kMono, picture.eyes[0].radiance = Image(192, 96, 3);
  return picture;
}

class ConvertMetadata : public testing::Test {
 protected:
  std::string projection(const std::string& name, const FormatHint& known) const {
    OpenOptions options;
    options.format = known;
    return std::string(projection_name(open_picture(folder.path(name), options).camera.projection));
  }
  void write_sidecar_of(const std::string& name, const char* said) const {
    StereoCamera camera;
    camera.projection = named(said);
    save_sidecar({camera, {192, 96}, Layout::kSeparate, {kMono}}, folder.path(name));
  }
  static FormatHint seen() {
    FormatHint known;
    known.seen = SeenFormat{std::nullopt, named("cylinder"), "its pixels"};
    return known;
  }

  TemporaryFolder folder;
};

TEST_F(ConvertMetadata, OfAPictureThatSaysItself) {
  StereoCamera camera;
  camera.projection = named("fisheye");
  save_picture(one_eye(), camera, {}, folder.path("a_cube-3x2.exr"));
  save_picture(one_eye(), {}, folder.path("b_cube-3x2.exr"));
  for (const char* name : {"a_cube-3x2.camera.json", "b_cube-3x2.camera.json"})
    write_sidecar_of(name, "fisheye-equisolid");
  FormatHint asked = seen();
  asked.projection = named("eac");
  EXPECT_EQ(projection("a_cube-3x2.exr", asked), "eac") << "options";
  EXPECT_EQ(projection("a_cube-3x2.exr", seen()), "fisheye") << "the file's own ods:projection";
  EXPECT_EQ(projection("b_cube-3x2.exr", seen()), "fisheye-equisolid") << "the sidecar";
  std::filesystem::remove(folder.path("b_cube-3x2.camera.json"));
  EXPECT_EQ(projection("b_cube-3x2.exr", seen()), "cube-3x2") << "the name";
  std::filesystem::rename(folder.path("b_cube-3x2.exr"), folder.path("b.exr"));
  EXPECT_EQ(projection("b.exr", seen()), "cylinder") << "the pixels";
  EXPECT_EQ(projection("b.exr", {}), "lat-long") << "the shape";
}

TEST_F(ConvertMetadata, OfAPhotoWithGpano) {
  StereoCamera camera;
  camera.yaw = 40.0f;
  save_picture(one_eye(), camera, {}, folder.path("a_fisheye.jpg"));
  write_sidecar_of("a_fisheye.camera.json", "fisheye-equisolid");
  EXPECT_EQ(projection("a_fisheye.jpg", seen()), "fisheye-equisolid") << "the sidecar, which knows more";
  std::filesystem::remove(folder.path("a_fisheye.camera.json"));
  EXPECT_EQ(projection("a_fisheye.jpg", seen()), "lat-long") << "GPano";
  EXPECT_EQ(open_picture(folder.path("a_fisheye.jpg")).camera.yaw, 40.0f);
}

TEST_F(ConvertMetadata, OfAVideo) {
  const auto stereo = [&](const std::string& entry, const std::string& track, const FormatHint& known = {}) {
    made::Mp4Options options;
    options.widths = {512}, options.height = 256, options.entry_boxes = entry, options.track_boxes = track;
    folder.write("a_BT.mp4", made::mp4(options));
    return open_video(folder.path("a_BT.mp4"), known).metadata.stereo;
  };
  const std::string v2 = made::st3d(1) + made::sv3d("camera", made::kWhole);  // top-bottom
  const std::string v1 = made::v1_box("left-right"), apple = made::vexu(3 | 8, "equi", "side");
  FormatHint asked;
  asked.layout = Layout::kSeparate;
  EXPECT_EQ(stereo(v2 + apple, v1, asked), VideoStereo::kOneView) << "options";
  EXPECT_EQ(stereo(v2 + apple, v1), VideoStereo::kTopBottom) << "V2";
  EXPECT_EQ(stereo(apple, v1), VideoStereo::kSideBySide) << "V1";
  EXPECT_EQ(stereo(apple, ""), VideoStereo::kRightLeft) << "vexu";
}

// A window that is asked for has the shape that players show: of one eye, not squeezed, with square pixels.
TEST_F(ConvertMetadata, AWindowHasTheShapeThatIsShown) {
  FormatHint asked;
  asked.projection = named("perspective");
  const auto aspect_of_video = [&](int across, Layout layout) {
    made::Mp4Options options;
    options.widths = {512}, options.height = 256;
    std::string video = made::mp4(options);
    const size_t shape = video.find("pasp");
    video.replace(shape + 4, 8, made::number(static_cast<uint64_t>(across), 4) + made::number(2, 4));
    folder.write("window.mp4", video);
    asked.layout = layout;
    return open_video(folder.path("window.mp4"), asked).prototype.camera.projection.aspect;
  };
  EXPECT_FLOAT_EQ(aspect_of_video(2, Layout::kSeparate), 2.0f);
  EXPECT_FLOAT_EQ(aspect_of_video(1, Layout::kSeparate), 1.0f);
  EXPECT_FLOAT_EQ(aspect_of_video(3, Layout::kSeparate), 3.0f);
  EXPECT_FLOAT_EQ(aspect_of_video(2, Layout::kSideBySide), 1.0f);
  EXPECT_FLOAT_EQ(aspect_of_video(2, Layout::kSideBySideHalf), 2.0f);
  EXPECT_FLOAT_EQ(aspect_of_video(2, Layout::kTopBottom), 4.0f);

  save_picture(one_eye(), {}, folder.path("window.png"));
  const std::string wide = made::number(1000, 4) + made::number(2000, 4) + '\1';  // pixels for each metre
  folder.write("wide.png", folder.read("window.png").insert(kPngAfterHeader, png_chunk("pHYs", wide)));
  const auto aspect_of_picture = [&](const char* name, Layout layout) {
    OpenOptions options;
    options.format = asked, options.format.layout = layout;
    return open_picture(folder.path(name), options).camera.projection.aspect;
  };
  EXPECT_FLOAT_EQ(aspect_of_picture("window.png", Layout::kSeparate), 2.0f);
  EXPECT_FLOAT_EQ(aspect_of_picture("window.png", Layout::kSideBySideHalf), 2.0f);
  EXPECT_FLOAT_EQ(aspect_of_picture("wide.png", Layout::kSeparate), 4.0f);
  EXPECT_FLOAT_EQ(aspect_of_picture("wide.png", Layout::kSideBySide), 2.0f);
}

// --- circles ---------------------------------------------------------------------------------------------------------

class ConvertCircles : public Cli {};

// A circle that is not in the picture is an error of one line, in every command.
TEST_F(ConvertCircles, OutsideThePictureAreRefused) {
  Picture picture;
  for (const int eye : {kLeft, kRight}) {
    picture.eyes.emplace_back();
    picture.eyes.back().eye = eye, picture.eyes.back().radiance = Image(96, 96, 3);
  }
  SaveOptions options;
  options.layout = Layout::kSideBySide;
  save_picture(picture, options, folder.path("a.png"));
  const std::string input = folder.path("a.png"), output = folder.path("b.png");
  for (const char* circle : {"200,40,30", "48,-1,30", "48,48,1", "48,48,1000", "nan,48,30", "48,48,30,48,97,30"}) {
    for (const std::string& command :
         {"convert " + input + " -o " + output, "lint " + input, "view --no-browser " + input}) {
      const int code = run(command + " --layout side-by-side --circle " + circle);
      EXPECT_TRUE(code == 2 || code == 3) << command << " " << circle << ": " << code;
      EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    }
    EXPECT_FALSE(std::filesystem::exists(output)) << circle;
  }
}

}  // namespace ods::which_word_wins_test
