// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libtiff itself reads what we write.
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstring>
#include <memory>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/codec/encoder.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

float value_at(int x, int y, size_t c) {
  return static_cast<float>((x * 7 + y * 13 + static_cast<int>(c) * 50) % 256) / 255.0f;
}

Tiff write(const TemporaryFolder& folder, int width, int height, const std::string& channels, SampleType sample,
           const std::vector<Attribute>& attributes = {}) {
  FileHeader header;
  header.format = FileFormat::kTiff, header.width = width, header.height = height, header.attributes = attributes;
  for (const char name : channels) header.channels.push_back({std::string(1, name), sample});
  AtomicFile file(folder.path("a.tif"));
  write_image(file, header, [&](int y, std::span<float> row) {
    for (size_t i = 0; i < row.size(); i++) {
      row[i] = value_at(static_cast<int>(i / channels.size()), y, i % channels.size());
    }
  });
  file.commit();
  return {TIFFOpen(folder.path("a.tif").c_str(), "r"), TIFFClose};
}

uint16_t field(const Tiff& tiff, uint32_t tag) {
  uint16_t value = 0;
  TIFFGetFieldDefaulted(tiff.get(), tag, &value);
  return value;
}

TEST(TiffEncoder, OthersReadItsSamples) {
  const TemporaryFolder folder;
  for (const SampleType sample : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat}) {
    for (const std::string channels : {"Y", "YA", "RGB", "RGBA"}) {
      for (const int height : {1, 16, 131}) {
        SCOPED_TRACE(testing::Message() << channels << height << " " << static_cast<int>(sample));
        const Tiff tiff = write(folder, 37, height, channels, sample);
        ASSERT_TRUE(tiff);
        const bool is_float = sample == SampleType::kHalf || sample == SampleType::kFloat;
        EXPECT_EQ(field(tiff, TIFFTAG_SAMPLESPERPIXEL), channels.size());
        EXPECT_EQ(field(tiff, TIFFTAG_BITSPERSAMPLE), 8 * bytes_of(sample));
        EXPECT_EQ(field(tiff, TIFFTAG_SAMPLEFORMAT), is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
        EXPECT_EQ(field(tiff, TIFFTAG_PHOTOMETRIC), channels.size() < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
        uint16_t count = 0, *kinds = nullptr;
        TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
        ASSERT_EQ(count, channels.ends_with("A") ? 1 : 0);
        if (count > 0) {
          EXPECT_EQ(kinds[0], is_float ? EXTRASAMPLE_ASSOCALPHA : EXTRASAMPLE_UNASSALPHA);
        }
        const size_t size = bytes_of(sample);
        std::vector<std::byte> row(static_cast<size_t>(TIFFScanlineSize(tiff.get())));
        ASSERT_EQ(row.size(), 37 * channels.size() * size);
        for (int y = 0; y < height; y++) {
          ASSERT_EQ(TIFFReadScanline(tiff.get(), row.data(), static_cast<uint32_t>(y)), 1);
          for (size_t i = 0; i < 37 * channels.size(); i++) {
            const float expected = value_at(static_cast<int>(i / channels.size()), y, i % channels.size());
            ASSERT_NEAR(sample_value(sample, &row[i * size]), expected, 0.0005f) << y << " " << i;
          }
        }
      }
    }
  }
}

TEST(TiffEncoder, SaysWhoMadeItAndWhatAViewerShows) {
  const TemporaryFolder folder;
  const Tiff tiff = write(folder, 4, 4, "RGB", SampleType::kUint8,
                          {{"Software", std::string("who")}, {"GPano:FullPanoWidthPixels", 4096}});
  const char* software = nullptr;
  ASSERT_EQ(TIFFGetField(tiff.get(), TIFFTAG_SOFTWARE, &software), 1);
  EXPECT_STREQ(software, "who");
  uint32_t size = 0;
  const char* xmp = nullptr;
  ASSERT_EQ(TIFFGetField(tiff.get(), TIFFTAG_XMLPACKET, &size, &xmp), 1);
  EXPECT_NE(std::string(xmp, size).find("GPano:FullPanoWidthPixels=\"4096\""), std::string::npos);
  const char* time = nullptr;
  EXPECT_EQ(TIFFGetField(tiff.get(), TIFFTAG_DATETIME, &time), 0) << "equal pictures would not be equal files";
  const std::string once = folder.read("a.tif");
  write(folder, 4, 4, "RGB", SampleType::kUint8,
        {{"Software", std::string("who")}, {"GPano:FullPanoWidthPixels", 4096}});
  EXPECT_EQ(folder.read("a.tif"), once);
}

}  // namespace
}  // namespace ods
