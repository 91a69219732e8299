// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// EXR, PNG and JPEG of every form. OpenEXR, libpng and libjpeg make them, and are the judges.
#include "ods/image/codec/decoder.h"

#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstring>
#include <random>

// After <cstdio>: it needs FILE.
#include <jpeglib.h>

#include "ods/base/error.h"
#include "tests/support/decoded_rows.h"
#include "tests/support/exr_files.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// --- EXR -------------------------------------------------------------------------------------------------------------

constexpr int kWidth = 53, kHeight = 67;

std::vector<float> exr_values(size_t channels, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> values;
  for (size_t n = 0; n < kWidth * kHeight * channels; n++) {
    values.push_back(static_cast<float>(n % 97) / 16.0f + static_cast<float>(random() % 8));
  }
  return values;
}

TEST(ExrDecoder, ReadsEveryPacking) {
  const TemporaryFolder folder;
  for (const std::string& packing : names_of_packings()) {
    for (const int tile : {0, 16}) {
      SCOPED_TRACE(packing + (tile > 0 ? ", tiles" : ""));
      ExrForm form;
      form.channels = {"R", "G", "B", "A", "Z", "N.X"};
      form.types = {Imf::HALF, Imf::HALF, Imf::HALF, Imf::HALF, Imf::FLOAT, Imf::HALF};
      form.packing = packing, form.tile = tile;
      write_exr_of(folder.path("a.exr"), form, exr_values(6, 0));
      const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
      EXPECT_EQ(decoder->info.channels, form.channels);
      EXPECT_TRUE(read_all(*decoder) == read_exr(folder.path("a.exr"), form));
      expect_bands(*decoder);
      const std::string bytes = folder.read("a.exr");
      const auto in_memory = open_exr(picture_in_memory(std::as_bytes(std::span(bytes)), "a file"));
      EXPECT_TRUE(read_all(*in_memory) == read_all(*decoder));
    }
  }
}

// "GB" is not a part of "RGBA".
TEST(ExrDecoder, PutsRedGreenBlueAndAlphaBeforeOtherChannels) {
  const TemporaryFolder folder;
  ExrForm form;
  form.channels = {"A", "B", "G", "GB", "R", "RG"};
  write_exr_of(folder.path("a.exr"), form, exr_values(6, 0));
  EXPECT_EQ(open_exr(picture_on_disk(folder.path("a.exr")))->info.channels,
            (std::vector<std::string>{"R", "G", "B", "A", "GB", "RG"}));
}

TEST(ExrDecoder, ReadsTheFirstPart) {
  const TemporaryFolder folder;
  const std::vector<ExrForm> parts(2);
  std::vector<Bytes> pixels(2, Bytes(bytes_of_pixels(parts[0])));
  for (size_t i = 0; i < pixels[0].size(); i++) pixels[0][i] = static_cast<std::byte>(i % 61);
  write_exr(folder.path("a.exr"), parts, pixels);
  const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
  EXPECT_EQ(decoder->info.unread_parts, 1);
  EXPECT_TRUE(read_all(*decoder) == pixels[0]);
}

// Two eyes as compositors and Blender write them, each with its layers.
TEST(ExrDecoder, ReadsThePartsOfBothViews) {
  const TemporaryFolder folder;
  std::vector<ExrForm> parts(5);
  const char* const views[] = {"right", "left", "right", "left", "left"};
  std::vector<Bytes> pixels;
  for (size_t i = 0; i < parts.size(); i++) {
    if (i >= 2) parts[i].channels = {"Z", "normal.X"};  // the last part repeats the fourth
    parts[i].tile = i == 1 ? 16 : 0;
    parts[i].prepare = [view = views[i]](Imf::Header& header) { header.setView(view); };
    pixels.emplace_back(bytes_of_pixels(parts[i]));
    for (size_t k = 0; k < pixels[i].size(); k++) pixels[i][k] = static_cast<std::byte>((k * (i + 3)) % 61);
  }
  write_exr(folder.path("a.exr"), parts, pixels);
  const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
  EXPECT_EQ(decoder->info.unread_parts, 1);
  EXPECT_FALSE(decoder->info.text.contains("view"));
  EXPECT_EQ(decoder->info.channels,
            (std::vector<std::string>{"left.R", "left.G", "left.B", "left.Z", "normal.left.X", "normal.right.X",
                                      "right.R", "right.G", "right.B", "right.Z"}));
  EXPECT_TRUE(read_rows(*decoder, 0, kHeight, 0, 3) == pixels[1]);
  EXPECT_TRUE(read_rows(*decoder, 0, kHeight, 6, 3) == pixels[0]);
  const Bytes deep = read_rows(*decoder, 0, kHeight, 9, 1);
  for (size_t i = 0; i < kWidth * kHeight; i++) ASSERT_EQ(std::memcmp(&deep[2 * i], &pixels[2][4 * i], 2), 0) << i;
  expect_bands(*decoder);
}

// Compositing programs crop the data window of each eye.
TEST(ExrDecoder, ReadsBothViewsIfTheirDataWindowsDiffer) {
  const TemporaryFolder folder;
  std::vector<ExrForm> parts(2);
  parts[0].left = 3, parts[0].top = 5, parts[0].width = 40, parts[0].height = 50;
  parts[1].left = 10, parts[1].top = 0, parts[1].width = 43, parts[1].height = 60, parts[1].tile = 16;
  const char* const views[] = {"left", "right"};
  std::vector<Bytes> pixels;
  for (size_t i = 0; i < parts.size(); i++) {
    parts[i].channels = {"Y"};
    parts[i].types = {Imf::FLOAT};
    parts[i].prepare = [view = views[i]](Imf::Header& header) {
      header.setView(view);
      header.displayWindow() = Imath::Box2i({0, 0}, {kWidth - 1, kHeight - 1});
    };
    pixels.emplace_back(bytes_of_pixels(parts[i]));
    for (size_t k = 0; k < pixels[i].size() / 4; k++) {
      const float value = 0.5f + static_cast<float>(k + 7 * i);
      std::memcpy(&pixels[i][4 * k], &value, 4);
    }
  }
  write_exr(folder.path("a.exr"), parts, pixels);
  const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
  EXPECT_EQ(decoder->info.unread_parts, 0);
  EXPECT_EQ(decoder->info.channels, (std::vector<std::string>{"left.Y", "right.Y"}));
  ASSERT_EQ(std::pair(decoder->info.width, decoder->info.height), std::pair(int{kWidth}, int{kHeight}));
  const Bytes both = read_all(*decoder);
  for (int y = 0; y < kHeight; y++) {
    for (int x = 0; x < kWidth; x++) {
      for (size_t i = 0; i < 2; i++) {
        const ExrForm& part = parts[i];
        const int column = x - part.left, row = y - part.top;
        const bool is_in = column >= 0 && row >= 0 && column < part.width && row < part.height;
        const float expected =
            is_in ? 0.5f + static_cast<float>(row * part.width + column) + static_cast<float>(7 * i) : 0.0f;
        float value = -1.0f;
        std::memcpy(&value, &both[(static_cast<size_t>(y * kWidth + x) * 2 + i) * 4], 4);
        ASSERT_EQ(value, expected) << x << " " << y << " " << views[i];
      }
    }
  }
  expect_bands(*decoder);
  // A window far away is not a crop of the same picture.
  parts[1].left = 100000;
  write_exr(folder.path("b.exr"), parts, pixels);
  EXPECT_EQ(open_exr(picture_on_disk(folder.path("b.exr")))->info.unread_parts, 1);
}

// A compositor writes only the box that its element fills, or more than the picture.
TEST(ExrDecoder, ReadsThePictureOfWhichTheDataWindowIsAPartOrMore) {
  const TemporaryFolder folder;
  for (const auto& [left, top] : {std::pair{7, 21}, std::pair{-5, -19}, std::pair{-5, 21}, std::pair{7, 200}}) {
    for (const int tile : {0, 16}) {
      SCOPED_TRACE(testing::Message() << left << ", " << top << ", tiles of " << tile);
      ExrForm form;
      form.types.assign(3, Imf::FLOAT);
      form.left = 100 + left, form.top = 100 + top, form.tile = tile;
      form.prepare = [](Imf::Header& header) { header.displayWindow() = {{100, 100}, {159, 149}}; };
      const std::vector<float> values = exr_values(3, 1);
      write_exr_of(folder.path("a.exr"), form, values);
      const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
      ASSERT_EQ(decoder->info.width, 60);
      ASSERT_EQ(decoder->info.height, 50);
      const Bytes bytes = read_all(*decoder);
      std::vector<float> expected;
      for (int y = 0; y < 50; y++) {
        for (int x = 0; x < 3 * 60; x++) {
          const int column = x - 3 * left, row = y - top;
          const bool inside = column >= 0 && column < 3 * kWidth && row >= 0 && row < kHeight;
          expected.push_back(inside ? values[static_cast<size_t>(row * 3 * kWidth + column)] : 0.0f);
        }
      }
      ASSERT_EQ(bytes.size(), expected.size() * sizeof(float));
      EXPECT_EQ(std::memcmp(bytes.data(), expected.data(), bytes.size()), 0);
      expect_bands(*decoder);
    }
  }
}

TEST(ExrDecoder, SaysThatAChannelHasFewerPixels) {
  const TemporaryFolder folder;
  Imf::Header header(kWidth + 1, kHeight + 1);
  header.channels().insert("RY", Imf::Channel(Imf::HALF, 2, 2));
  header.channels().insert("Y", Imf::Channel(Imf::HALF));
  Imf::OutputFile(folder.path("a.exr").c_str(), header);
  try {
    open_exr(picture_on_disk(folder.path("a.exr")));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("channel RY has fewer pixels"), std::string::npos) << error.what();
  }
}

// --- PNG -------------------------------------------------------------------------------------------------------------

struct PngForm {
  const char* what;
  int type, depth, interlace;
  bool has_transparency;
  std::vector<std::string> channels;
};

// Random samples; palettes have the colours (i, 2 i, 255 - i), of which every third is transparent.
void write_png(const std::string& path, const PngForm& form) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, kWidth, kHeight, form.depth, form.type, form.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette;
  std::vector<png_byte> alphas;
  for (int i = 0; i < 1 << std::min(form.depth, 8); i++) {
    palette.push_back({static_cast<png_byte>(i), static_cast<png_byte>(2 * i), static_cast<png_byte>(255 - i)});
    alphas.push_back(i % 3 == 0 ? 0 : 255);
  }
  const bool has_palette = form.type == PNG_COLOR_TYPE_PALETTE;
  if (has_palette) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  png_color_16 transparent{0, 1, 1, 1, 1};
  if (form.has_transparency) {
    png_set_tRNS(png, info, alphas.data(), has_palette ? static_cast<int>(alphas.size()) : 0,
                 has_palette ? nullptr : &transparent);
  }
  png_write_info(png, info);
  const size_t row_size = png_get_rowbytes(png, info);
  std::mt19937 random(3);
  std::vector<png_byte> pixels(row_size * kHeight);
  for (png_byte& byte : pixels) byte = static_cast<png_byte>(random());
  std::vector<png_bytep> rows;
  for (size_t y = 0; y < kHeight; y++) rows.push_back(&pixels[y * row_size]);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

// By libpng, at once.
Bytes read_whole_png(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_read_png(png, info, PNG_TRANSFORM_EXPAND | PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
  Bytes pixels;
  for (size_t y = 0; y < kHeight; y++) {
    const auto* row = reinterpret_cast<const std::byte*>(png_get_rows(png, info)[y]);
    pixels.insert(pixels.end(), row, row + png_get_rowbytes(png, info));
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return pixels;
}

TEST(PngDecoder, ReadsEveryForm) {
  const std::vector<std::string> kGrey = {"Y"}, kColour = {"R", "G", "B"}, kBoth = {"R", "G", "B", "A"};
  const PngForm forms[] = {{"1-bit grey", PNG_COLOR_TYPE_GRAY, 1, 0, false, kGrey},
                           {"4-bit grey", PNG_COLOR_TYPE_GRAY, 4, 0, false, kGrey},
                           {"16-bit grey", PNG_COLOR_TYPE_GRAY, 16, 0, false, kGrey},
                           {"grey and alpha", PNG_COLOR_TYPE_GRAY_ALPHA, 8, 0, false, {"Y", "A"}},
                           {"palette", PNG_COLOR_TYPE_PALETTE, 8, 0, false, kColour},
                           {"palette of 4", PNG_COLOR_TYPE_PALETTE, 2, 0, false, kColour},
                           {"transparent palette", PNG_COLOR_TYPE_PALETTE, 8, 0, true, kBoth},
                           {"transparent colour", PNG_COLOR_TYPE_RGB, 8, 0, true, kBoth},
                           {"colour", PNG_COLOR_TYPE_RGB, 8, 0, false, kColour},
                           {"16-bit colour and alpha", PNG_COLOR_TYPE_RGB_ALPHA, 16, 0, false, kBoth},
                           {"interlaced", PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7, false, kColour},
                           {"interlaced palette", PNG_COLOR_TYPE_PALETTE, 4, PNG_INTERLACE_ADAM7, false, kColour}};
  const TemporaryFolder folder;
  for (const PngForm& form : forms) {
    SCOPED_TRACE(form.what);
    write_png(folder.path("a.png"), form);
    const auto decoder = open_png(picture_on_disk(folder.path("a.png")));
    EXPECT_EQ(decoder->info.channels, form.channels);
    expect_bands(*decoder);
    EXPECT_TRUE(read_all(*decoder) == read_whole_png(folder.path("a.png")));
  }
}

// --- JPEG ------------------------------------------------------------------------------------------------------------

void write_jpeg(const std::string& path, J_COLOR_SPACE space, int components, bool progressive) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  jpeg_stdio_dest(&jpeg, file);
  jpeg.image_width = kWidth, jpeg.image_height = kHeight;
  jpeg.input_components = components;
  jpeg.in_color_space = space;
  jpeg_set_defaults(&jpeg);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<JSAMPLE> row(static_cast<size_t>(kWidth * components));
  for (int y = 0; y < kHeight; y++) {
    for (size_t i = 0; i < row.size(); i++) row[i] = static_cast<JSAMPLE>(i * 2 + static_cast<size_t>(y) * 3 + 20);
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::fclose(file);
}

// By libjpeg, at once; ink as light, as its amounts are stored: 255 minus them.
Bytes read_whole_jpeg(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&jpeg);
  jpeg_stdio_src(&jpeg, file);
  jpeg_read_header(&jpeg, TRUE);
  jpeg_start_decompress(&jpeg);
  const size_t components = static_cast<size_t>(jpeg.output_components);
  std::vector<JSAMPLE> row(components * kWidth);
  Bytes pixels;
  for (int y = 0; y < kHeight; y++) {
    JSAMPROW pointer = row.data();
    jpeg_read_scanlines(&jpeg, &pointer, 1);
    for (size_t i = 0; i < row.size(); i++) {
      if (components < 4) pixels.push_back(static_cast<std::byte>(row[i]));
      if (components == 4 && i % 4 < 3) pixels.push_back(static_cast<std::byte>(row[i] * row[i / 4 * 4 + 3] / 255));
    }
  }
  jpeg_finish_decompress(&jpeg);
  jpeg_destroy_decompress(&jpeg);
  std::fclose(file);
  return pixels;
}

TEST(JpegDecoder, ReadsEveryForm) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.jpg");
  for (const bool progressive : {false, true}) {
    for (const auto& [space, components] :
         {std::pair(JCS_GRAYSCALE, 1), std::pair(JCS_RGB, 3), std::pair(JCS_CMYK, 4)}) {
      SCOPED_TRACE(components);
      write_jpeg(path, space, components, progressive);
      const auto decoder = open_jpeg(picture_on_disk(path));
      expect_bands(*decoder);
      const Bytes own = read_all(*decoder), judge = read_whole_jpeg(path);
      ASSERT_EQ(own.size(), judge.size());
      for (size_t i = 0; i < own.size(); i++) {  // ink is mixed by rounding
        ASSERT_NEAR(static_cast<int>(own[i]), static_cast<int>(judge[i]), components == 4 ? 1 : 0) << i;
      }
    }
  }
}

TEST(JpegDecoder, RefusesUnknownComponents) {
  const TemporaryFolder folder;
  write_jpeg(folder.path("a.jpg"), JCS_UNKNOWN, 2, false);
  EXPECT_THROW(open_jpeg(picture_on_disk(folder.path("a.jpg"))), Error);
}

}  // namespace
}  // namespace ods
