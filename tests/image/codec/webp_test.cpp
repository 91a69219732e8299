// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libwebp makes the files, and judges ours.
#include <gtest/gtest.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include <memory>
#include <random>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/image/codec/encoder.h"
#include "tests/support/decoded_rows.h"
#include "tests/support/temporary_folder.h"

namespace ods::webp_test {

constexpr int kWidth = 53, kHeight = 31;

std::vector<uint8_t> make_pixels(size_t channels) {
  std::vector<uint8_t> pixels;
  for (int i = 0; i < kWidth * kHeight; i++) {
    for (size_t c = 0; c < channels; c++) {
      pixels.push_back(
          static_cast<uint8_t>(c == 3 ? 255 - i % 200 : (i % kWidth) * 3 + i / kWidth + 20 * static_cast<int>(c)));
    }
  }
  return pixels;
}

std::string lossless(const std::vector<uint8_t>& pixels, size_t channels) {
  uint8_t* bytes = nullptr;
  const int row = static_cast<int>(channels) * kWidth;
  const auto encode = channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
  const size_t size = encode(pixels.data(), kWidth, kHeight, row, &bytes);
  const std::string file(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return file;
}

std::string lossy(const std::vector<uint8_t>& pixels) {
  uint8_t* bytes = nullptr;
  const size_t size = WebPEncodeRGB(pixels.data(), kWidth, kHeight, 3 * kWidth, 90.0f, &bytes);
  const std::string file(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return file;
}

std::string little(size_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; i++) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

std::string chunk(const std::string& name, const std::string& data) {
  return name + little(data.size(), 4) + data + std::string(data.size() % 2, '\0');
}

// Frames that cover the canvas.
std::string animation(const std::vector<std::string>& frames) {
  const std::string size = little(kWidth - 1, 3) + little(kHeight - 1, 3);
  std::string chunks =
      "WEBP" + chunk("VP8X", std::string("\x12\0\0\0", 4) + size) + chunk("ANIM", std::string(6, '\0'));
  for (const std::string& frame : frames) {
    chunks += chunk("ANMF", little(0, 6) + size + little(100, 3) + '\2' + frame.substr(12));
  }
  return chunk("RIFF", chunks);
}

std::unique_ptr<Decoder> open(const std::string& file) {
  return open_webp(picture_in_memory(std::as_bytes(std::span(file)), "a file"));
}

TEST(WebpDecoder, ReadsWhatOthersWrite) {
  for (const size_t channels : {size_t{3}, size_t{4}}) {
    const std::vector<uint8_t> pixels = make_pixels(channels);
    const std::string file = lossless(pixels, channels);
    const auto decoder = open(file);
    ASSERT_EQ(decoder->info.channels.size(), channels);
    const Bytes read = read_all(*decoder);
    ASSERT_EQ(read.size(), pixels.size());
    EXPECT_EQ(std::memcmp(read.data(), pixels.data(), read.size()), 0) << "alpha is unassociated";
    expect_bands(*decoder);
  }
  const std::vector<uint8_t> pixels = make_pixels(3);
  const std::string file = lossy(pixels);
  const Bytes read = read_all(*open(file));
  for (size_t i = 0; i < read.size(); i++) ASSERT_NEAR(static_cast<int>(read[i]), pixels[i], 12) << i;
}

TEST(WebpDecoder, ReadsTheFirstFrame) {
  const std::vector<uint8_t> pixels = make_pixels(4);
  std::vector<uint8_t> others = pixels;
  for (uint8_t& each : others) each = static_cast<uint8_t>(255 - each);
  const std::string file = animation({lossless(pixels, 4), lossless(others, 4)});
  const auto decoder = open(file);
  const Bytes read = read_all(*decoder);
  ASSERT_EQ(read.size(), pixels.size());
  EXPECT_EQ(std::memcmp(read.data(), pixels.data(), read.size()), 0);
  expect_bands(*decoder);
}

TEST(WebpDecoder, RefusesDamage) {
  const std::string files[] = {lossless(make_pixels(4), 4), lossy(make_pixels(3)),
                               animation({lossless(make_pixels(4), 4), lossless(make_pixels(3), 3)})};
  std::mt19937 random(4);
  for (const std::string& whole : files) {
    const size_t end = whole == files[2] ? whole.size() / 2 : whole.size();  // an animation's last frame is not read
    for (size_t size = 0; size < end; size += 1 + whole.size() / 97) {
      EXPECT_NE(refusal_of(open_webp, whole.substr(0, size)), "") << size;
    }
    for (int i = 0; i < 500; i++) {
      std::string file = whole;
      for (int k = 0; k <= i % 5; k++) file[12 + random() % (file.size() - 12)] = static_cast<char>(random());
      refusal_of(open_webp, file);
    }
  }
  const std::string size = little(16382, 3) + little(16382, 3);
  const std::string huge = chunk("RIFF", "WEBP" + chunk("VP8X", little(0, 4) + size) + files[1].substr(12));
  EXPECT_NE(refusal_of(open_webp, huge), "");
}

std::string write(const TemporaryFolder& folder, const std::vector<uint8_t>& pixels, size_t channels, int quality) {
  FileHeader header;
  header.format = FileFormat::kWebp, header.width = kWidth, header.height = kHeight, header.quality = quality;
  for (size_t c = 0; c < channels; c++) header.channels.push_back({std::string(1, "RGBA"[c]), SampleType::kUint8});
  AtomicFile file(folder.path("a.webp"));
  write_image(file, header, [&](int y, std::span<float> row) {
    const size_t from = static_cast<size_t>(y) * row.size();
    for (size_t i = 0; i < row.size(); i++) row[i] = static_cast<float>(pixels[from + i]) / 255.0f;
  });
  file.commit();
  return folder.read("a.webp");
}

TEST(WebpEncoder, OthersReadItsColoursAndAlpha) {
  const TemporaryFolder folder;
  for (const size_t channels : {size_t{3}, size_t{4}}) {
    const std::vector<uint8_t> pixels = make_pixels(channels);
    const std::string file = write(folder, pixels, channels, 95);
    int width = 0, height = 0;
    const std::unique_ptr<uint8_t, void (*)(void*)> read(
        WebPDecodeRGBA(reinterpret_cast<const uint8_t*>(file.data()), file.size(), &width, &height), WebPFree);
    ASSERT_TRUE(read);
    ASSERT_EQ(width, kWidth);
    ASSERT_EQ(height, kHeight);
    for (size_t i = 0; i < static_cast<size_t>(kWidth * kHeight); i++) {
      for (size_t c = 0; c < 3; c++) ASSERT_NEAR(read.get()[4 * i + c], pixels[channels * i + c], 12) << i;
      ASSERT_EQ(read.get()[4 * i + 3], channels == 4 ? pixels[4 * i + 3] : 255) << i;
    }
    EXPECT_LT(write(folder, pixels, channels, 20).size(), file.size());
  }
}

TEST(WebpEncoder, RefusesWhatItCannotHold) {
  const TemporaryFolder folder;
  EXPECT_THROW(write(folder, make_pixels(2), 2, 95), Error);
}

}  // namespace ods::webp_test
