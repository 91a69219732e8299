// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// TIFFs of every form, made by libtiff; what becomes of their numbers is told by the specification.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ods/base/error.h"
#include "tests/support/decoded_rows.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiff_files.h"

namespace ods {
namespace {

// Bytes of which many repeat; floats are finite.
Bytes make_pixels(const TiffForm& form, unsigned seed = 1) {
  std::mt19937 random(seed);
  Bytes pixels(bytes_of_row(form) * form.height);
  for (size_t i = 0; i < pixels.size(); i++) pixels[i] = static_cast<std::byte>(i % 64 < 20 ? 7 : random() & 0x3f);
  return pixels;
}

std::unique_ptr<Decoder> open(const TemporaryFolder& folder, const TiffForm& form, const Bytes& pixels) {
  write_tiff(folder.path("a.tif"), form, pixels);
  return open_tiff(picture_on_disk(folder.path("a.tif")));
}

template <class T>
Bytes bytes_of_numbers(const std::vector<T>& numbers) {
  const auto bytes = std::as_bytes(std::span(numbers));
  return {bytes.begin(), bytes.end()};
}

template <class T>
std::vector<T> numbers_of(const Bytes& bytes) {
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

// One row of these numbers, as they are decoded.
template <class To, class From>
std::vector<To> decoded(TiffForm form, const std::vector<From>& row) {
  const TemporaryFolder folder;
  form.width = static_cast<uint32_t>(row.size() / form.samples), form.height = 1;
  form.bits = form.bits == 0 ? static_cast<uint16_t>(8 * sizeof(From)) : form.bits;
  const auto decoder = open(folder, form, bytes_of_numbers(row));
  EXPECT_EQ(bytes_of(decoder->info.samples[0]), sizeof(To));
  return numbers_of<To>(read_all(*decoder));
}

std::string refusal(const TemporaryFolder& folder) {
  return refusal_of(open_tiff, folder.read("a.tif"));
}

TiffForm grey(uint16_t bits, uint16_t format = SAMPLEFORMAT_UINT) {
  TiffForm form;
  form.samples = 1, form.bits = bits, form.format = format, form.photometric = PHOTOMETRIC_MINISBLACK;
  return form;
}

// --- places ----------------------------------------------------------------------------------------------------------

TEST(TiffDecoder, ReadsStripsAndTilesOfBothByteOrdersAndSizes) {
  const TemporaryFolder folder;
  for (const char* mode : {"wl", "wb", "w8l", "w8b"}) {
    for (const uint16_t bits : {uint16_t{8}, uint16_t{16}, uint16_t{32}}) {
      for (const bool is_separate : {false, true}) {
        for (const uint32_t tile : {0u, 16u}) {
          TiffForm form;
          form.mode = mode, form.bits = bits, form.is_separate = is_separate, form.tile = tile, form.samples = 5;
          form.extra = {EXTRASAMPLE_UNSPECIFIED, EXTRASAMPLE_UNSPECIFIED};
          if (bits == 32) form.format = SAMPLEFORMAT_IEEEFP;
          SCOPED_TRACE(testing::Message() << mode << bits << is_separate << tile);
          const Bytes pixels = make_pixels(form);
          const auto decoder = open(folder, form, pixels);
          EXPECT_EQ(decoder->info.channels, (std::vector<std::string>{"R", "G", "B", "channel3", "channel4"}));
          EXPECT_EQ(decoder->info.is_float, bits == 32);
          EXPECT_TRUE(read_all(*decoder) == pixels);
          expect_bands(*decoder);
        }
      }
    }
  }
}

TEST(TiffDecoder, ReadsEveryPacking) {
  const TemporaryFolder folder;
  for (const int compression : {COMPRESSION_LZW, COMPRESSION_PACKBITS, COMPRESSION_DEFLATE, COMPRESSION_ADOBE_DEFLATE,
                                COMPRESSION_LZMA, COMPRESSION_ZSTD}) {
    if (!TIFFIsCODECConfigured(static_cast<uint16_t>(compression))) continue;
    for (const int predictor : {PREDICTOR_NONE, PREDICTOR_HORIZONTAL, PREDICTOR_FLOATINGPOINT}) {
      for (const uint32_t tile : {0u, 16u}) {
        TiffForm form;
        form.compression = static_cast<uint16_t>(compression), form.predictor = static_cast<uint16_t>(predictor),
        form.tile = tile;
        if (compression == COMPRESSION_PACKBITS && predictor != PREDICTOR_NONE) continue;
        if (predictor == PREDICTOR_FLOATINGPOINT) form.bits = 32, form.format = SAMPLEFORMAT_IEEEFP;
        SCOPED_TRACE(testing::Message() << compression << " " << predictor << " " << tile);
        const Bytes pixels = make_pixels(form);
        const auto decoder = open(folder, form, pixels);
        EXPECT_TRUE(read_all(*decoder) == pixels);
        expect_bands(*decoder);
      }
    }
  }
}

// Just too large to be decoded at once: more than 8 MB.
TEST(TiffDecoder, ReadsLargeStripsRowByRow) {
  const TemporaryFolder folder;
  Bytes pixels;
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE}) {
    for (const bool is_separate : {false, true}) {
      TiffForm form;
      form.width = 1000, form.height = 580, form.samples = 4, form.bits = 32, form.format = SAMPLEFORMAT_IEEEFP;
      form.extra = {EXTRASAMPLE_UNSPECIFIED};
      form.mode = "wb", form.rows_per_strip = 550, form.compression = static_cast<uint16_t>(compression),
      form.is_separate = is_separate;
      if (pixels.empty()) pixels = make_pixels(form);
      const auto decoder = open(folder, form, pixels);
      EXPECT_EQ(decoder->rows_together, 1);
      EXPECT_TRUE(read_all(*decoder) == pixels);
      expect_bands(*decoder);
    }
  }
}

TEST(TiffDecoder, ReadsJpegInside) {
  const TemporaryFolder folder;
  for (const int photometric : {PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_RGB, PHOTOMETRIC_YCBCR}) {
    for (const uint32_t tile : {0u, 32u}) {
      TiffForm form = grey(8);
      form.photometric = static_cast<uint16_t>(photometric), form.compression = COMPRESSION_JPEG, form.tile = tile;
      form.samples = photometric == PHOTOMETRIC_MINISBLACK ? 1 : 3;
      Bytes pixels;
      for (uint32_t i = 0; i < form.width * form.height * form.samples; i++) {
        pixels.push_back(static_cast<std::byte>(i / form.samples % form.width + i / form.samples / form.width));
      }
      const auto decoder = open(folder, form, pixels);
      const Bytes read = read_all(*decoder);
      ASSERT_EQ(read.size(), pixels.size());
      int errors = 0;
      for (size_t i = 0; i < read.size(); i++) {
        errors += std::abs(static_cast<int>(read[i]) - static_cast<int>(pixels[i]));
      }
      EXPECT_LT(errors, std::ssize(read)) << photometric << " " << tile;
      expect_bands(*decoder);
    }
  }
}

// A picture that libtiff converts to RGBA; grey in this one.
TEST(TiffDecoder, ReadsOtherColourSpaces) {
  const TemporaryFolder folder;
  TiffForm form;
  form.photometric = PHOTOMETRIC_YCBCR;
  form.prepare = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_YCBCRSUBSAMPLING, 1, 1); };
  Bytes pixels;
  for (uint32_t i = 0; i < form.width * form.height; i++) {
    for (const uint32_t each : {i % 200, 128u, 128u}) pixels.push_back(static_cast<std::byte>(each));
  }
  const auto decoder = open(folder, form, pixels);
  EXPECT_EQ(decoder->info.channels, (std::vector<std::string>{"R", "G", "B"}));
  const Bytes read = read_all(*decoder);
  for (size_t i = 0; i < read.size(); i++)
    ASSERT_NEAR(static_cast<int>(read[i]), static_cast<int>(i / 3 % 200), 1) << i;
  expect_bands(*decoder);
}

TEST(TiffDecoder, OrientationIsNotApplied) {
  const TemporaryFolder folder;
  TiffForm form;
  form.prepare = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_LEFTBOT); };
  const Bytes pixels = make_pixels(form);
  EXPECT_TRUE(read_all(*open(folder, form, pixels)) == pixels);
}

// --- numbers ---------------------------------------------------------------------------------------------------------

TEST(TiffDecoder, IntegersOfOtherSizesBecome8Or16Bits) {
  using Codes = std::vector<uint8_t>;
  using Deep = std::vector<uint16_t>;
  TiffForm bits1 = grey(1), bits4 = grey(4), bits12 = grey(12);
  bits1.width = 8, bits4.width = 2, bits12.width = 2;
  bits1.height = bits4.height = bits12.height = 1;
  const TemporaryFolder folder;
  EXPECT_EQ(numbers_of<uint8_t>(read_all(*open(folder, bits1, {std::byte{0xa1}}))),
            (Codes{255, 0, 255, 0, 0, 0, 0, 255}));
  EXPECT_EQ(numbers_of<uint8_t>(read_all(*open(folder, bits4, {std::byte{0x2f}}))), (Codes{34, 255}));
  EXPECT_EQ(numbers_of<uint16_t>(read_all(*open(folder, bits12, {std::byte{0x80}, std::byte{0x0f}, std::byte{0xff}}))),
            (Deep{32775, 65535}));
  const uint32_t kMax = 0xffffffff;
  EXPECT_EQ((decoded<uint16_t, uint32_t>(grey(32), {0, 1u << 31, kMax, 65537 * 7})), (Deep{0, 32768, 65535, 7}));
  EXPECT_EQ((decoded<uint16_t, int8_t>(grey(8, SAMPLEFORMAT_INT), {-128, -1, 0, 127})), (Deep{0, 0, 0, 65535}));
  EXPECT_EQ((decoded<uint16_t, int16_t>(grey(16, SAMPLEFORMAT_INT), {-5, 16384, 32767})), (Deep{0, 32769, 65535}));
  EXPECT_EQ((decoded<uint16_t, int32_t>(grey(32, SAMPLEFORMAT_INT), {-5, 0x7fffffff})), (Deep{0, 65535}));
}

TEST(TiffDecoder, DoublesBecomeFloats) {
  EXPECT_EQ((decoded<float, double>(grey(64, SAMPLEFORMAT_IEEEFP), {0.1, -3.0, 1e10})),
            (std::vector<float>{0.1f, -3.0f, 1e10f}));
  const std::vector<uint16_t> halves = {0x3c00, 0xc000, 0x7bff};
  EXPECT_EQ((decoded<uint16_t, uint16_t>(grey(16, SAMPLEFORMAT_IEEEFP), halves)), halves);
}

TEST(TiffDecoder, ZeroMayBeWhite) {
  TiffForm form = grey(8);
  form.photometric = PHOTOMETRIC_MINISWHITE;
  EXPECT_EQ((decoded<uint8_t, uint8_t>(form, {0, 255, 7})), (std::vector<uint8_t>{255, 0, 248}));
  form.bits = 16;
  EXPECT_EQ((decoded<uint16_t, uint16_t>(form, {0, 65535, 7})), (std::vector<uint16_t>{65535, 0, 65528}));
}

TEST(TiffDecoder, PalettesBecomeColours) {
  for (const bool is_narrow : {false, true}) {  // some programs write palettes of 8 bits
    std::vector<uint16_t> colors[3];
    for (uint16_t i = 0; i < 256; i++) {
      for (uint16_t c = 0; c < 3; c++) {
        const uint16_t code = static_cast<uint16_t>((i * (c + 1)) & 0xff);
        colors[c].push_back(static_cast<uint16_t>(is_narrow ? code : code * 257));
      }
    }
    TiffForm form = grey(8);
    form.photometric = PHOTOMETRIC_PALETTE;
    form.prepare = [&](TIFF* tiff) {
      TIFFSetField(tiff, TIFFTAG_COLORMAP, colors[0].data(), colors[1].data(), colors[2].data());
    };
    EXPECT_EQ((decoded<uint8_t, uint8_t>(form, {0, 1, 200})), (std::vector<uint8_t>{0, 0, 0, 1, 2, 3, 200, 144, 88}));
  }
}

TEST(TiffDecoder, InksBecomeLight) {
  TiffForm form;
  form.photometric = PHOTOMETRIC_SEPARATED, form.samples = 5, form.extra = {EXTRASAMPLE_UNASSALPHA};
  EXPECT_EQ((decoded<uint8_t, uint8_t>(form, {0, 255, 55, 0, 9, 0, 0, 0, 255, 8})),
            (std::vector<uint8_t>{255, 0, 200, 9, 0, 0, 0, 8}));
  form.bits = 16;
  EXPECT_EQ((decoded<uint16_t, uint16_t>(form, {0, 65535, 0, 32768, 9})), (std::vector<uint16_t>{32767, 0, 32767, 9}));
}

// Integers come unassociated, floats associated.
TEST(TiffDecoder, AlphaMultipliesAsTheSamplesSay) {
  TiffForm form;
  form.samples = 4;
  const std::vector<uint8_t> pixel = {10, 20, 30, 100}, divided = {26, 51, 77, 100};
  form.extra = {EXTRASAMPLE_ASSOCALPHA};
  EXPECT_EQ((decoded<uint8_t, uint8_t>(form, pixel)), divided);
  form.extra = {EXTRASAMPLE_UNASSALPHA};
  EXPECT_EQ((decoded<uint8_t, uint8_t>(form, pixel)), pixel);
  form.extra = {EXTRASAMPLE_UNSPECIFIED};
  EXPECT_EQ((decoded<uint8_t, uint8_t>(form, pixel)), pixel);
  form.extra.clear();
  EXPECT_EQ((decoded<uint8_t, uint8_t>(form, pixel)), divided) << "a fourth channel that nothing is said of";
  form.bits = 32, form.format = SAMPLEFORMAT_IEEEFP;
  const std::vector<float> light = {1.0f, 2.0f, 4.0f, 0.25f}, multiplied = {0.25f, 0.5f, 1.0f, 0.25f};
  for (const bool is_separate : {false, true}) {
    form.is_separate = is_separate;
    form.extra = {EXTRASAMPLE_ASSOCALPHA};
    EXPECT_EQ((decoded<float, float>(form, light)), light);
    form.extra = {EXTRASAMPLE_UNASSALPHA};
    EXPECT_EQ((decoded<float, float>(form, light)), multiplied);
  }
  form.bits = 16;
  EXPECT_EQ((decoded<uint16_t, uint16_t>(form, {0x3c00, 0x4000, 0x4400, 0x3400})),
            (std::vector<uint16_t>{0x3400, 0x3800, 0x3c00, 0x3400}));
}

// --- what is refused -------------------------------------------------------------------------------------------------

TEST(TiffDecoder, SaysWhatItDoesNotRead) {
  const TemporaryFolder folder;
  const auto expect = [&](const TiffForm& form, const std::string& why) {
    write_tiff(folder.path("a.tif"), form, Bytes(bytes_of_row(form) * form.height));
    EXPECT_NE(refusal(folder).find(why), std::string::npos) << refusal(folder);
  };
  expect(grey(64), "64 bits");
  TiffForm inks;
  inks.photometric = PHOTOMETRIC_SEPARATED, inks.samples = 4, inks.bits = 32, inks.format = SAMPLEFORMAT_IEEEFP;
  expect(inks, "inks are floats");
  TiffForm many;
  many.samples = 1025;
  expect(many, "1025 channels");
  TiffForm deep;
  deep.prepare = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_IMAGEDEPTH, 2); };
  expect(deep, "not a flat image");
  EXPECT_NE(refusal_of(open_tiff, "II*"), "");
}

// The place of a tag's value in a little-endian file.
size_t place_of(const std::string& file, uint16_t tag) {
  uint32_t directory = 0;
  std::memcpy(&directory, &file[4], 4);
  for (size_t at = directory + 2; at + 12 <= file.size(); at += 12) {
    if (std::memcmp(&file[at], &tag, 2) == 0) return at + 8;
  }
  ADD_FAILURE() << "no tag " << tag;
  return 0;
}

// Before there is room for them.
TEST(TiffDecoder, RefusesSizesThatTheFileCannotHold) {
  const TemporaryFolder folder;
  TiffForm strips = grey(8), tiles = grey(8);
  tiles.tile = 16;
  for (const TiffForm& form : {strips, tiles}) {
    write_tiff(folder.path("a.tif"), form, make_pixels(form));
    const std::string whole = folder.read("a.tif");
    std::vector<uint16_t> tags = {TIFFTAG_IMAGEWIDTH, TIFFTAG_IMAGELENGTH};
    if (form.tile > 0) tags.insert(tags.end(), {TIFFTAG_TILEWIDTH, TIFFTAG_TILELENGTH});
    for (const uint16_t tag : tags) {
      for (const uint16_t size : {uint16_t{0}, uint16_t{40000}, uint16_t{65520}}) {
        std::string file = whole;
        std::memcpy(&file[place_of(file, tag)], &size, 2);
        EXPECT_NE(refusal_of(open_tiff, file), "") << tag << " " << size;
      }
    }
  }
  TiffForm wide = grey(8);
  wide.width = 32768, wide.height = 512, wide.compression = COMPRESSION_ADOBE_DEFLATE;
  write_tiff(folder.path("a.tif"), wide, Bytes(bytes_of_row(wide) * wide.height));
  std::string file = folder.read("a.tif");
  const uint16_t kSamples = 1000;
  std::memcpy(&file[place_of(file, TIFFTAG_SAMPLESPERPIXEL)], &kSamples, 2);
  EXPECT_NE(refusal_of(open_tiff, file).find("broken or hostile"), std::string::npos) << refusal_of(open_tiff, file);
}

TEST(TiffDecoder, SurvivesDamage) {
  const TemporaryFolder folder;
  TiffForm forms[6];
  forms[1].compression = COMPRESSION_LZW;
  forms[2].compression = COMPRESSION_ADOBE_DEFLATE, forms[2].tile = 16, forms[2].mode = "w8";
  forms[3].compression = COMPRESSION_JPEG, forms[3].photometric = PHOTOMETRIC_YCBCR;
  forms[4].compression = COMPRESSION_PACKBITS, forms[4].is_separate = true;
  forms[5].photometric = PHOTOMETRIC_CIELAB;
  std::mt19937 random(3);
  for (const TiffForm& form : forms) {
    write_tiff(folder.path("a.tif"), form, make_pixels(form));
    const std::string whole = folder.read("a.tif");
    EXPECT_EQ(refusal_of(open_tiff, whole), "");
    // libtiff writes the directory last.
    for (size_t size = 4; size < whole.size(); size += 1 + whole.size() / 61) {
      EXPECT_NE(refusal_of(open_tiff, whole.substr(0, size)), "") << size;
    }
    for (int i = 0; i < 400; i++) {
      std::string file = whole;
      const size_t start = i % 2 == 0 ? 4 : file.size() - 250;
      for (int k = 0; k <= i % 6; k++) file[start + random() % (file.size() - start)] = static_cast<char>(random());
      refusal_of(open_tiff, file);
    }
  }
}

// A directory that is its own successor.
TEST(TiffDecoder, ReadsOnlyTheFirstDirectory) {
  const TemporaryFolder folder;
  const TiffForm form;
  write_tiff(folder.path("a.tif"), form, make_pixels(form));
  std::string file = folder.read("a.tif");
  uint32_t directory = 0, next = 0;
  uint16_t entries = 0;
  std::memcpy(&directory, &file[4], 4);
  std::memcpy(&entries, &file[directory], 2);
  std::memcpy(&next, &file[directory + 2 + 12u * entries], 4);
  ASSERT_EQ(next, 0u);
  std::memcpy(&file[directory + 2 + 12u * entries], &directory, 4);
  EXPECT_EQ(refusal_of(open_tiff, file), "");
}

}  // namespace
}  // namespace ods
