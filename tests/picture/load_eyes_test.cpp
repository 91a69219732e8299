// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/load_eyes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/picture/anaglyph.h"
#include "ods/picture/save.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/saved_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods::load_eyes_test {

const int kWidth = 16, kHeight = 8;

// Smooth, so that JPEG and WebP can follow, and small enough for the tone curve to leave it alone.
EyeImage make_eye(int eye) {
  EyeImage result;
  result.eye = eye;
  result.radiance = Image(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth; x++) {
      const float side = eye == kLeft ? 0.2f : 0.4f;
      for (int c = 0; c < 3; c++) {
        result.radiance.at(x, y)[c] = side + 0.008f * static_cast<float>(x) + 0.012f * static_cast<float>(y);
      }
    }
  }
  return result;
}

// Away from the edges, over which lossy codecs mix the eyes. Interleaved ones they always mix.
void expect_eye(const Image& image, const Image& saved, FileFormat format) {
  const int columns = saved.width / image.width, rows = saved.height / image.height;
  const int border = tolerance(format) > 0.01f ? 1 : 0;
  for (int y = border; y < image.height - border; y++) {
    for (int x = border; x < image.width - border; x++) {
      float mean = 0.0f;
      for (int i = 0; i < columns * rows; i++) {
        mean += saved.at(x * columns + i % columns, y * rows + i / columns)[1] / static_cast<float>(columns * rows);
      }
      ASSERT_NEAR(image.at(x, y)[1], mean, tolerance(format)) << "x " << x << " y " << y;
    }
  }
}

TEST(LoadEyes, UndoesEveryLayoutInEveryFormat) {
  const Picture picture{{make_eye(kLeft), make_eye(kRight)}};
  for (const SavedForm& form : every_saved_form()) {
    SCOPED_TRACE(form.text());
    const TemporaryFolder folder;
    const std::string path = folder.path(form.name);
    save_picture(picture, options_for(form.layout), path);
    const LoadedEyes loaded = load_eyes(path, form.layout);
    ASSERT_EQ(loaded.eyes.size(), 2u);
    EXPECT_EQ(loaded.guess.layout, form.layout);
    EXPECT_EQ(loaded.is_float, is_scene_referred(form.format));
    for (size_t i = 0; i < 2; i++) expect_eye(loaded.eyes[i], picture.eyes[i].radiance, form.format);
    const bool says_so = form.format == FileFormat::kExr || form.layout == Layout::kSeparate;
    EXPECT_TRUE(!says_so || load_eyes(path).guess.layout == form.layout) << "without being told";
  }
}

TEST(LoadEyes, SqueezedEyesAreMeansOfTheLight) {
  const Picture picture{{make_eye(kLeft), make_eye(kRight)}};
  for (Layout layout : {Layout::kTopBottomHalf, Layout::kSideBySideHalf}) {
    const TemporaryFolder folder;
    save_picture(picture, options_for(layout), folder.path("a.exr"));
    const FileInfo info = read_info(folder.path("a.exr"));
    EXPECT_EQ(info.width, kWidth);
    EXPECT_EQ(info.height, kHeight);
    const std::vector<Image> eyes = load_eyes(folder.path("a.exr")).eyes;
    EXPECT_EQ(eyes[0].width * eyes[0].height * 2, kWidth * kHeight);
  }
}

TEST(LoadEyes, AnaglyphsHoldWhatTheirFormulaSays) {
  const Picture picture{{make_eye(kLeft), make_eye(kRight)}};
  for (Layout layout : kLayouts) {
    if (!is_anaglyph(layout)) continue;
    const TemporaryFolder folder;
    save_picture(picture, options_for(layout), folder.path("a.png"));
    const Image image = read_image(folder.path("a.png"));
    ASSERT_EQ(image.width, kWidth);
    ASSERT_EQ(image.height, kHeight);
    const float *left = picture.eyes[0].radiance.at(5, 3), *right = picture.eyes[1].radiance.at(5, 3);
    const vec3 expected = anaglyph_color(layout, vec3(left[0], left[1], left[2]), vec3(right[0], right[1], right[2]));
    for (int c = 0; c < 3; c++) EXPECT_NEAR(image.at(5, 3)[c], expected[c], 0.004f) << layout_name(layout);
    EXPECT_THROW(load_eyes(folder.path("a.png"), layout), Error);
  }
}

// The guess for a file of this name, without metadata, that has this size.
LayoutGuess guess(int width, int height, const std::string& name) {
  const TemporaryFolder folder;
  const std::string path = folder.path(name);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  const Binary png = small_png();
  folder.write(name, std::string(png.begin(), png.end()));
  FileInfo info;
  info.width = width;
  info.height = height;
  info.channels = {"R", "G", "B"};
  return find_format(info, path, {}).layout;
}

TEST(GuessLayout, TheNameGoesBeforeTheShape) {
  EXPECT_EQ(guess(64, 64, "a_TB.png").layout, Layout::kTopBottom);
  EXPECT_EQ(guess(64, 64, "a_bt.png").layout, Layout::kBottomTop);
  EXPECT_EQ(guess(64, 64, "a_LR.png").layout, Layout::kSideBySide);
  EXPECT_EQ(guess(64, 64, "a_RL.png").layout, Layout::kCrossEyed);
  EXPECT_EQ(guess(64, 64, "a_sbs.png").layout, Layout::kSideBySide);
  EXPECT_EQ(guess(64, 32, "dir_LR/a_OU.png").layout, Layout::kTopBottom);
  EXPECT_EQ(guess(64, 32, "a_top-bottom-half.png").layout, Layout::kTopBottomHalf);
  EXPECT_EQ(guess(64, 32, "a_LR_360.0001.png").layout, Layout::kSideBySide);
  EXPECT_EQ(guess(64, 32, "a_LR_180x180.png").layout, Layout::kSideBySide);
  EXPECT_EQ(guess(64, 32, "a_column-interleaved.png").layout, Layout::kColumnInterleaved);
  EXPECT_EQ(guess(64, 32, "a_LR.png").reason, "its name ends in _LR");
  for (const char* name :
       {"a.png", "tb.png", "a_tbx.png", "tb_scene.png", "a_anaglyph.png", "a_checkerboard.png", "_.png", ".png"}) {
    EXPECT_EQ(guess(64, 32, name).layout, std::nullopt) << name;
  }
}

TEST(GuessLayout, TheShapeIsTheLastResort) {
  EXPECT_EQ(guess(64, 64, "a.png").layout, Layout::kTopBottom);
  EXPECT_EQ(guess(128, 32, "a.png").layout, Layout::kSideBySide);
  EXPECT_EQ(guess(64, 32, "a.png").layout, std::nullopt);
  EXPECT_EQ(guess(64, 48, "a.png").layout, std::nullopt);
  EXPECT_EQ(guess(64, 48, "a.png").reason, "nothing tells of two eyes");
}

TEST(LoadEyes, WhatTheFileSaysGoesBeforeItsName) {
  const TemporaryFolder folder;
  const Picture picture{{make_eye(kLeft), make_eye(kRight)}};
  save_picture(picture, options_for(Layout::kBottomTop), folder.path("a_TB.exr"));
  EXPECT_EQ(load_eyes(folder.path("a_TB.exr")).guess.layout, Layout::kBottomTop);
  save_picture({{make_eye(kMono)}}, options_for(Layout::kTopBottom), folder.path("b_TB.exr"));
  EXPECT_EQ(load_eyes(folder.path("b_TB.exr")).eyes.size(), 1u);
}

void write_exr(const std::string& path, const std::vector<std::string>& channels) {
  AtomicFile file(path);
  FileHeader header;
  header.format = FileFormat::kExr;
  header.width = 4;
  header.height = 2;
  for (const std::string& channel : channels) header.channels.push_back({channel, SampleType::kFloat});
  write_image(file, header, [&](int y, std::span<float> row) {
    for (size_t i = 0; i < row.size(); i++) row[i] = static_cast<float>(10 * y + static_cast<int>(i % channels.size()));
  });
  file.commit();
}

TEST(LoadEyes, ViewsOfOthersHaveTheirNames) {
  const TemporaryFolder folder;
  write_exr(folder.path("left.exr"), {"R", "G", "B", "right.R", "right.G", "right.B"});
  EXPECT_EQ(load_eyes(folder.path("left.exr")).eyes[0].at(0, 1)[1], 11.0f);
  EXPECT_EQ(load_eyes(folder.path("left.exr")).eyes[1].at(0, 1)[1], 14.0f);
  write_exr(folder.path("right.exr"), {"R", "G", "B", "left.R", "left.G", "left.B"});
  EXPECT_EQ(load_eyes(folder.path("right.exr")).eyes[0].at(0, 1)[1], 14.0f) << "the right view is the default one";
  EXPECT_EQ(load_eyes(folder.path("right.exr")).eyes[1].at(0, 1)[1], 11.0f);
}

TEST(LoadEyes, VarianceComesAlong) {
  const TemporaryFolder folder;
  write_exr(folder.path("a_TB.exr"), {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
  const LoadedEyes loaded = load_eyes(folder.path("a_TB.exr"));
  ASSERT_EQ(loaded.variance.size(), 2u);
  EXPECT_EQ(loaded.variance[0].at(3, 0)[2], 5.0f);
  EXPECT_EQ(loaded.variance[1].at(3, 0)[2], 15.0f);
  EXPECT_EQ(loaded.eyes[1].at(3, 0)[2], 12.0f);
}

TEST(LoadEyes, RefusesWhatIsNotThere) {
  const TemporaryFolder folder;
  save_picture({{make_eye(kMono)}}, options_for(Layout::kTopBottom), folder.path("left.png"));
  write_exr(folder.path("right.png"), {"R", "G", "B"});
  write_exr(folder.path("odd.exr"), {"R", "variance.R", "right.R"});
  folder.write("broken_TB.exr", folder.read("odd.exr").substr(0, 200));
  const std::pair<std::string, std::optional<Layout>> bad[] = {
      {"absent.png", {}}, {"%V.png", {}}, {"left.png", Layout::kMultiview}, {"odd.exr", {}}, {"broken_TB.exr", {}}};
  for (const auto& [name, layout] : bad) {
    try {
      load_eyes(folder.path(name), layout);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << name;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_channels(folder.path("left.png"), {"Z"}), Error);
}

}  // namespace ods::load_eyes_test
