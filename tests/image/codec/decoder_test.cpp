// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files of every form that a format knows. OpenImageIO is the judge; libpng, libjpeg and OpenEXR make what it cannot.
#include "ods/image/codec/decoder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstring>
#include <random>

// After <cstdio>: it needs FILE.
#include <jpeglib.h>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

using Bytes = std::vector<std::byte>;

Bytes read_rows(Decoder& decoder, int begin, int end, size_t first, size_t count) {
  size_t pixel = 0;
  for (size_t c = first; c < first + count; c++) pixel += bytes_of(decoder.info.samples[c]);
  Bytes rows(pixel * static_cast<size_t>(decoder.info.width) * static_cast<size_t>(end - begin));
  decoder.read(begin, end, first, count, rows.data());
  return rows;
}

Bytes read_all(Decoder& decoder) {
  return read_rows(decoder, 0, decoder.info.height, 0, decoder.info.channels.size());
}

Bytes read_by_judge(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  EXPECT_TRUE(input) << path;
  Bytes pixels(input->spec().image_bytes(true));
  EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc(), pixels.data())) << input->geterror();
  return pixels;
}

// The same rows again, from the middle, and again from the top.
void expect_bands(Decoder& decoder) {
  const Bytes all = read_all(decoder);
  const int height = decoder.info.height;
  const size_t row = all.size() / static_cast<size_t>(height), channels = decoder.info.channels.size();
  for (const auto& [begin, end] : {std::pair(height / 2, height), std::pair(0, 1), std::pair(height / 3, height / 2)}) {
    const Bytes rows = read_rows(decoder, begin, end, 0, channels);
    EXPECT_EQ(std::memcmp(rows.data(), &all[row * static_cast<size_t>(begin)], rows.size()), 0) << begin;
  }
  const size_t last = channels - 1, size = bytes_of(decoder.info.samples[last]),
               pixel = row / static_cast<size_t>(decoder.info.width);
  const Bytes one = read_rows(decoder, 0, height, last, 1);
  for (size_t i = 0; i < one.size() / size; i++) {
    ASSERT_EQ(std::memcmp(&one[i * size], &all[i * pixel + pixel - size], size), 0) << i;
  }
}

// --- EXR -------------------------------------------------------------------------------------------------------------

constexpr int kWidth = 53, kHeight = 67;

OIIO::ImageSpec exr_spec(const std::vector<std::string>& channels, const std::string& packing) {
  OIIO::ImageSpec spec(kWidth, kHeight, static_cast<int>(channels.size()), OIIO::TypeDesc::HALF);
  spec.channelnames = channels;
  for (const std::string& name : channels) {
    spec.channelformats.push_back(name == "Z" ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF);
  }
  spec.attribute("compression", packing);
  return spec;
}

void write_exr(const std::string& path, const std::vector<OIIO::ImageSpec>& parts) {
  const auto output = OIIO::ImageOutput::create("openexr");
  ASSERT_TRUE(output->open(path, static_cast<int>(parts.size()), parts.data())) << output->geterror();
  for (size_t i = 0; i < parts.size(); i++) {
    if (i > 0) {
      ASSERT_TRUE(output->open(path, parts[i], OIIO::ImageOutput::AppendSubimage)) << output->geterror();
    }
    std::mt19937 random(static_cast<unsigned>(i));
    std::vector<float> pixels;
    for (int n = 0; n < kWidth * kHeight * parts[i].nchannels; n++) {
      pixels.push_back(static_cast<float>(n % 97) / 16.0f + static_cast<float>(random() % 8));
    }
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << output->geterror();
  }
  ASSERT_TRUE(output->close());
}

TEST(ExrDecoder, ReadsEveryPacking) {
  const TemporaryFolder folder;
  for (const char* packing : {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
    for (const int tile : {0, 16}) {
      SCOPED_TRACE(std::string(packing) + (tile > 0 ? ", tiles" : ""));
      OIIO::ImageSpec spec = exr_spec({"R", "G", "B", "A", "Z", "N.X"}, packing);
      spec.tile_width = spec.tile_height = tile;
      write_exr(folder.path("a.exr"), {spec});
      const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
      EXPECT_EQ(decoder->info.channels, spec.channelnames);
      EXPECT_TRUE(read_all(*decoder) == read_by_judge(folder.path("a.exr")));
      expect_bands(*decoder);
      const std::string bytes = folder.read("a.exr");
      const auto in_memory = open_exr(picture_in_memory(std::as_bytes(std::span(bytes)), "a file"));
      EXPECT_TRUE(read_all(*in_memory) == read_all(*decoder));
    }
  }
}

TEST(ExrDecoder, ReadsTheFirstPart) {
  const TemporaryFolder folder;
  std::vector<OIIO::ImageSpec> parts(2, exr_spec({"R", "G", "B"}, "zip"));
  parts[0].attribute("name", "first"), parts[1].attribute("name", "second");
  write_exr(folder.path("a.exr"), parts);
  const auto decoder = open_exr(picture_on_disk(folder.path("a.exr")));
  EXPECT_EQ(decoder->info.parts, 2);
  EXPECT_TRUE(read_all(*decoder) == read_by_judge(folder.path("a.exr")));
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
    // The judge multiplies by alpha unless it is asked not to.
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto judge = OIIO::ImageInput::open(folder.path("a.png"), &config);
    ASSERT_TRUE(judge);
    Bytes pixels(judge->spec().image_bytes());
    ASSERT_TRUE(judge->read_image(0, 0, 0, -1, OIIO::TypeDesc(), pixels.data()));
    ASSERT_EQ(static_cast<size_t>(judge->spec().nchannels), form.channels.size());
    EXPECT_TRUE(read_all(*decoder) == pixels);
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
      const Bytes own = read_all(*decoder), judge = read_by_judge(path);
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
