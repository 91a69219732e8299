// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Radiance pictures, packed here by their description.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/codec/encoder.h"
#include "tests/support/decoded_rows.h"
#include "tests/support/temporary_folder.h"

namespace ods::hdr_test {

constexpr int kWidth = 53, kHeight = 31;
using Scanline = std::vector<std::string>;  // of pixels, four bytes each

// Half of it runs.
std::string pixel_at(int x, int y) {
  const int place = x < kWidth / 2 ? x / 5 : x;
  if ((place + y) % 11 == 0) return std::string(4, '\0');
  std::mt19937 random(static_cast<unsigned>(place * 1000 + y));
  std::string pixel;
  for (int c = 0; c < 3; c++) pixel += static_cast<char>(128 + random() % 128);
  return pixel + static_cast<char>(120 + random() % 20);
}

float value_of(const std::string& pixel, size_t c) {
  const int exponent = static_cast<unsigned char>(pixel[3]);
  if (exponent == 0) return 0.0f;
  return static_cast<float>(static_cast<unsigned char>(pixel[c]) / 256.0 * std::pow(2.0, exponent - 128));
}

std::string flat(const Scanline& line) {
  std::string bytes;
  for (const std::string& pixel : line) bytes += pixel;
  return bytes;
}

std::string with_repeated_pixels(const Scanline& line) {
  std::string bytes;
  for (size_t x = 0, end = 0; x < line.size(); x = end) {
    for (end = x + 1; end < line.size() && line[end] == line[x];) end++;
    bytes += line[x];
    for (size_t count = end - x - 1; count > 0; count >>= 8)
      bytes += "\1\1\1" + std::string(1, static_cast<char>(count));
  }
  return bytes;
}

std::string by_component(const Scanline& line) {
  std::string bytes = "\2\2" + std::string{static_cast<char>(line.size() >> 8), static_cast<char>(line.size())};
  for (size_t c = 0; c < 4; c++) {
    for (size_t x = 0, end = 0; x < line.size(); x = end) {
      for (end = x + 1; end < line.size() && end - x < 127 && line[end][c] == line[x][c];) end++;
      bytes += end - x > 1 ? static_cast<char>(128 + end - x) : '\1';
      bytes += line[x][c];
    }
  }
  return bytes;
}

using Packing = std::string (*)(const Scanline&);
const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

std::string make_hdr(Packing packing, const std::string& header = kHeader) {
  std::string file = header + "-Y 31 +X 53\n";
  for (int y = 0; y < kHeight; y++) {
    Scanline line;
    for (int x = 0; x < kWidth; x++) line.push_back(pixel_at(x, y));
    file += packing(line);
  }
  return file;
}

void expect_picture(const std::string& file, const std::string& what) {
  SCOPED_TRACE(what);
  const auto decoder = open_hdr(picture_in_memory(std::as_bytes(std::span(file)), "a file"));
  ASSERT_EQ(decoder->info.width, kWidth);
  ASSERT_EQ(decoder->info.height, kHeight);
  EXPECT_EQ(decoder->info.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_TRUE(decoder->info.is_float);
  const Bytes pixels = read_all(*decoder);
  for (int i = 0; i < kWidth * kHeight * 3; i++) {
    const float expected = value_of(pixel_at(i / 3 % kWidth, i / 3 / kWidth), static_cast<size_t>(i % 3));
    ASSERT_EQ(sample_value(SampleType::kFloat, &pixels[static_cast<size_t>(4 * i)]), expected) << i;
  }
  expect_bands(*decoder);
}

TEST(HdrDecoder, ReadsEveryPacking) {
  expect_picture(make_hdr(flat), "flat");
  expect_picture(make_hdr(with_repeated_pixels), "repeated pixels");
  expect_picture(make_hdr(by_component), "by component");
}

TEST(HdrDecoder, ReadsLongRepetitions) {
  const std::string pixel = pixel_at(1, 1), file = kHeader + "-Y 1 +X 20001\n" + pixel + "\1\1\1" +
                                                   static_cast<char>(20000 & 0xff) + "\1\1\1" +
                                                   static_cast<char>(20000 >> 8);
  const auto decoder = open_hdr(picture_in_memory(std::as_bytes(std::span(file)), "a file"));
  const Bytes pixels = read_all(*decoder);
  EXPECT_EQ(sample_value(SampleType::kFloat, &pixels[pixels.size() - 4]), value_of(pixel, 2));
}

// Exposure and colour correction record changes of the numbers; they are not undone.
TEST(HdrDecoder, HeadersSayMore) {
  expect_picture(make_hdr(by_component,
                          "#?RGBE\n# a comment\nEXPOSURE=2\nCOLORCORR=1 2 3\nGAMMA=2.2\n"
                          "FORMAT=32-bit_rle_rgbe \n\n"),
                 "more lines");
  expect_picture(make_hdr(by_component, "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n"), "carriage returns");
  expect_picture(make_hdr(flat, "#?RADIANCE\n\n"), "no format");
  const std::string xyz = refusal_of(open_hdr, make_hdr(flat, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n"));
  EXPECT_NE(xyz.find("ra_xyze"), std::string::npos) << xyz;
  EXPECT_NE(refusal_of(open_hdr, make_hdr(flat, "#?RADIANCE\nFORMAT=\xff\n\n")).find("\xef\xbf\xbd"),
            std::string::npos);
  EXPECT_NE(refusal_of(open_hdr, "#?RADIANCE\n" + std::string(1 << 20, 'x') + "\n\n"), "");
  EXPECT_NE(refusal_of(open_hdr, "#?RADIANCE\n"), "");
}

TEST(HdrDecoder, ReadsEveryOrder) {
  for (const bool has_rows : {true, false}) {
    for (const bool first_from_end : {false, true}) {
      for (const bool second_from_end : {false, true}) {
        const int lines = has_rows ? kHeight : kWidth, length = has_rows ? kWidth : kHeight;
        const auto sign = [](char axis, bool from_end) { return (axis == 'Y') == from_end ? "+" : "-"; };
        const char first = has_rows ? 'Y' : 'X', second = has_rows ? 'X' : 'Y';
        std::string file = kHeader + sign(first, first_from_end) + first + " " + std::to_string(lines) + " " +
                           sign(second, second_from_end) + second + " " + std::to_string(length) + "\n";
        for (int i = 0; i < lines; i++) {
          Scanline line;
          for (int j = 0; j < length; j++) {
            const int a = first_from_end ? lines - 1 - i : i, b = second_from_end ? length - 1 - j : j;
            line.push_back(has_rows ? pixel_at(b, a) : pixel_at(a, b));
          }
          file += by_component(line);
        }
        expect_picture(file, file.substr(kHeader.size(), 12));
      }
    }
  }
}

TEST(HdrDecoder, RefusesDamage) {
  for (const Packing packing : {flat, with_repeated_pixels, by_component}) {
    const std::string whole = make_hdr(packing);
    for (size_t size = 12; size < whole.size(); size += 1 + whole.size() / 97) {
      EXPECT_NE(refusal_of(open_hdr, whole.substr(0, size)), "") << size;
    }
    std::mt19937 random(9);
    for (int i = 0; i < 500; i++) {
      std::string file = whole;
      for (int k = 0; k <= i % 5; k++) file[11 + random() % (file.size() - 11)] = static_cast<char>(random());
      refusal_of(open_hdr, file);
    }
  }
  for (const char* size : {"-Y 0 +X 5", "-Y 5 +X -5", "-Y 5 -Y 5", "-Y 5", "", "-Y x +X 5", "=Y 5 +X 5", "-Z 5 +X 5",
                           "-Y 1000000000 +X 1000000000", "-Y 99999999999999999999 +X 5", "-X 32000 +Y 32000"}) {
    EXPECT_NE(refusal_of(open_hdr, kHeader + size + "\n" + std::string(400, '\x80')), "") << size;
  }
  const std::string start = kHeader + "-Y 1 +X 8\n";
  using namespace std::string_literals;
  EXPECT_NE(refusal_of(open_hdr, start + "\1\1\1\7" + std::string(40, '\x80')), "") << "nothing to repeat";
  EXPECT_NE(refusal_of(open_hdr, start + "\x80\x80\x80\x80\1\1\1\x08"s + std::string(40, '\x80')), "") << "too long";
  EXPECT_NE(refusal_of(open_hdr, start + "\2\2\0\x09"s + std::string(60, '\x88')), "") << "another length";
  EXPECT_NE(refusal_of(open_hdr, start + "\2\2\0\x08\0"s + std::string(60, '\x88')), "") << "no bytes";
  EXPECT_NE(refusal_of(open_hdr, start + "\2\2\0\x08\x89"s + std::string(60, '\x88')), "") << "too long";
}

// Rows of these values: each pixel's largest has 8 bits.
TEST(HdrEncoder, KeepsTheLargestOfEachPixelToOnePartIn128) {
  const TemporaryFolder folder;
  const float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  for (const int width : {1, 7, 8, 200, 40000}) {
    const auto value = [&](int x, int c) {
      const float special[] = {0.0f, 1e-33f, 1e38f, -1.0f, 1.0f, kInfinity, kNan};
      if (x < 7) return c == 0 ? special[x] : 0.0f;
      const int place = x % 50 < 20 ? x / 50 : x;
      return std::exp2(static_cast<float>(place % 60 - 30)) * (1.0f + 0.3f * static_cast<float>(c));
    };
    FileHeader header;
    header.format = FileFormat::kHdr, header.width = width, header.height = 3;
    for (const char* name : {"R", "G", "B"}) header.channels.push_back({name, SampleType::kFloat});
    AtomicFile file(folder.path("a.hdr"));
    write_image(file, header, [&](int, std::span<float> row) {
      for (int i = 0; i < 3 * width; i++) row[static_cast<size_t>(i)] = value(i / 3, i % 3);
    });
    file.commit();
    if (width == 40000) continue;  // longer than what is read
    const auto decoder = open_hdr(picture_on_disk(folder.path("a.hdr")));
    const Bytes pixels = read_all(*decoder);
    for (int i = 0; i < 9 * width; i++) {
      const int x = i / 3 % width;
      const float raw = value(x, i % 3), expected = std::isnan(raw) || raw < 1e-32f ? 0.0f : std::min(raw, 1e38f);
      const float maximum = x < 7 ? expected : value(x, 2);
      ASSERT_NEAR(sample_value(SampleType::kFloat, &pixels[static_cast<size_t>(4 * i)]), expected, maximum / 128.0f)
          << i;
    }
  }
}

}  // namespace ods::hdr_test
