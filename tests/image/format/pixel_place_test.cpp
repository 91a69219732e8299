// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/pixel_place.h"

#include <gtest/gtest.h>

#include "ods/files/atomic_file.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/metadata.h"
#include "tests/support/made_tiff.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

class PixelPlace : public testing::Test {
 protected:
  // A picture of 16x8 pixels in any format.
  std::string write(const std::string& name) const {
    FileHeader header;
    header.format = *format_of_path(name);
    header.width = 16, header.height = 8;
    header.channels = {{"R"}, {"G"}, {"B"}};
    return image_bytes(name, header, [](int, std::span<float> row) { std::ranges::fill(row, 0.5f); });
  }
  FileInfo info(const std::string& name, const std::string& bytes) const {
    folder.write(name, bytes);
    return read_info(folder.path(name));
  }
  FileInfo png(uint32_t across, uint32_t down, unsigned unit) const {
    std::string data, bytes = write("a.png");
    for (const uint32_t each : {across, down}) {
      for (const unsigned shift : {24u, 16u, 8u, 0u}) data += static_cast<char>(each >> shift & 0xff);
    }
    data += static_cast<char>(unit);
    return info("a.png", bytes.insert(kPngAfterHeader, png_chunk("pHYs", data)));
  }
  FileInfo jpeg(unsigned unit, unsigned across, unsigned down) const {
    std::string bytes = write("a.jpg");
    const size_t at = bytes.find("JFIF");
    const unsigned fields[] = {unit, across >> 8, across & 0xff, down >> 8, down & 0xff};
    for (size_t i = 0; i < std::size(fields); i++) bytes[at + 7 + i] = static_cast<char>(fields[i]);
    return info("a.jpg", bytes);
  }

  TemporaryFolder folder;
};

TEST_F(PixelPlace, MorePixelsPerLengthAcrossAreNarrowPixels) {
  EXPECT_DOUBLE_EQ(pixel_aspect(png(2000, 1000, 1)), 0.5);
  EXPECT_DOUBLE_EQ(pixel_aspect(png(1000, 2000, 1)), 2.0);
  EXPECT_DOUBLE_EQ(pixel_aspect(jpeg(1, 300, 150)), 0.5);
  EXPECT_DOUBLE_EQ(pixel_aspect(jpeg(2, 100, 200)), 2.0);
  MadeTiff tiff{16, 8};
  tiff.ratios = {{282, 72.0}, {283, 144.0}};
  EXPECT_DOUBLE_EQ(pixel_aspect(info("a.tif", tiff.bytes())), 2.0);
}

TEST_F(PixelPlace, NearlyEqualAndSenselessNumbersAreSquarePixels) {
  EXPECT_EQ(pixel_aspect(png(2835, 2834, 1)), 1.0);
  EXPECT_EQ(pixel_aspect(png(1, 0xffffffff, 1)), 1.0);
  EXPECT_EQ(pixel_aspect(png(0, 1000, 1)), 1.0);
  EXPECT_EQ(pixel_aspect(jpeg(1, 72, 0)), 1.0);
  EXPECT_FALSE(png(2835, 2834, 1).text.contains(std::string(kPixelDoubt)));
}

// FFmpeg writes such ratios upside down.
TEST_F(PixelPlace, ARatioWithoutUnitIsADoubt) {
  for (const FileInfo& found : {png(2, 1, 0), jpeg(0, 2, 1)}) {
    EXPECT_EQ(pixel_aspect(found), 1.0);
    EXPECT_TRUE(found.text.contains(std::string(kPixelDoubt)));
  }
  EXPECT_FALSE(jpeg(0, 1, 1).text.contains(std::string(kPixelDoubt)));
}

TEST_F(PixelPlace, ACroppedTiffHasItsPlaceInTheSphere) {
  MadeTiff tiff{16, 8};
  tiff.ratios = {{282, 150.0}, {283, 150.0}, {286, 32.0 / 150.0}, {287, 4.0 / 150.0}};
  tiff.numbers = {{33300, 64}, {33301, 32}};
  const std::optional<StereoCamera> camera = placed_camera(info("a.tif", tiff.bytes()));
  ASSERT_TRUE(camera);
  EXPECT_FLOAT_EQ(camera->projection.longitude.x, 0.0f);
  EXPECT_FLOAT_EQ(camera->projection.longitude.y, 90.0f);
  EXPECT_FLOAT_EQ(camera->projection.latitude.y, 90.0f - 22.5f);
  EXPECT_FLOAT_EQ(camera->projection.latitude.x, 90.0f - 67.5f);
  tiff.numbers = {{33300, 64}, {33301, 40}};
  EXPECT_FALSE(placed_camera(info("a.tif", tiff.bytes()))) << "not a whole sphere";
  tiff.numbers = {{33300, 40}, {33301, 20}};
  EXPECT_FALSE(info("a.tif", tiff.bytes()).numbers.contains(std::string(kWholeArea))) << "it would reach outside";
  tiff.numbers = {{33300, 16}, {33301, 8}}, tiff.ratios.resize(2);
  EXPECT_FALSE(info("a.tif", tiff.bytes()).numbers.contains(std::string(kWholeArea))) << "it is whole";
}

}  // namespace
}  // namespace ods
