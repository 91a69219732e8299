// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The files beside this one are made of pictures of docs/images by Basis Universal's encoder (npm's
// @loaders.gl/textures); the digests are of what its transcoder (npm's three 0.187, examples/jsm/libs/basis) makes of
// them. uastc.ktx2 has blocks of all modes, with each of their partitions.
#include "ods/image/codec/ktx2.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <random>

#include "ods/base/error.h"
#include "ods/files/md5.h"
#include "ods/files/read_file.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"

namespace ods::ktx2_test {

struct Reference {
  const char* name;
  int width, height;
  const char* digest;  // MD5 of R, G, B, A
};

constexpr Reference kReferences[] = {
    {"etc1s", 61, 61, "25C4DF968C00E103CF7DC673CE30DD8C"},
    {"etc1s_alpha", 50, 50, "0024EFC74DEC301E1A54CCEFFE581FA4"},
    {"uastc", 55, 51, "D419C130703877A845FE8D7715900544"},
    {"uastc_zstd", 50, 50, "F445552F9936E64859ED39FE81222522"},
};

Binary bytes_of(const std::string& name) {
  return read_file(source_folder() + "/tests/image/codec/" + name + ".ktx2", 1 << 20);
}

CodeImage decode(const Binary& bytes) {
  return decode_ktx2(std::as_bytes(std::span(bytes)), "wood.ktx2");
}

// The error of decode_ktx2(); empty if it accepts the bytes.
std::string fault_of(const Binary& bytes) {
  try {
    decode(bytes);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

void put(Binary& bytes, size_t at, uint64_t value, size_t size) {
  for (size_t i = 0; i < size; i++) bytes.at(at + i) = static_cast<unsigned char>(value >> (8 * i));
}

// A file of one level, whose descriptor is empty.
Binary make_ktx2(uint32_t vulkan_format, int width, int height, const Binary& level, uint32_t packing = 0) {
  const unsigned char mark[] = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
  constexpr size_t kDescriptor = 104, kDescriptorSize = 44;
  Binary bytes(kDescriptor + kDescriptorSize);
  std::copy(std::begin(mark), std::end(mark), bytes.begin());
  const uint64_t fields[] = {vulkan_format, 1, uint64_t(width), uint64_t(height), 0, 0, 1, 1, packing};
  for (size_t i = 0; i < std::size(fields); i++) put(bytes, 12 + 4 * i, fields[i], 4);
  put(bytes, 48, kDescriptor, 4), put(bytes, 52, kDescriptorSize, 4);
  put(bytes, 80, bytes.size(), 8), put(bytes, 88, level.size(), 8);
  bytes.insert(bytes.end(), level.begin(), level.end());
  return bytes;
}

TEST(Ktx2, EqualsTheReference) {
  for (const Reference& reference : kReferences) {
    const CodeImage image = decode(bytes_of(reference.name));
    EXPECT_EQ(image.width, reference.width) << reference.name;
    EXPECT_EQ(image.height, reference.height) << reference.name;
    const auto* texels = reinterpret_cast<const char*>(image.pixels.data());
    EXPECT_EQ(md5({texels, 4 * image.pixels.size()}), reference.digest) << reference.name;
  }
}

TEST(Ktx2, TexelsAsTheyAre) {
  const Binary level = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(decode(make_ktx2(37, 1, 2, level)).pixels, (std::vector<uint32_t>{0x04030201, 0x08070605}));
  EXPECT_EQ(decode(make_ktx2(22, 2, 2, level)).pixels,
            (std::vector<uint32_t>{0xff000201, 0xff000403, 0xff000605, 0xff000807}));
  EXPECT_EQ(decode(make_ktx2(9, 8, 1, level)).pixels[7], 0xff000008u);
  Binary packed(ZSTD_compressBound(level.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), level.data(), level.size(), 3));
  EXPECT_EQ(decode(make_ktx2(43, 2, 1, packed, 2)).pixels, (std::vector<uint32_t>{0x04030201, 0x08070605}));
  EXPECT_NE(fault_of(make_ktx2(43, 3, 1, packed, 2)).find("Zstandard"), std::string::npos);
  EXPECT_NE(fault_of(make_ktx2(43, 3, 1, level)).find("size"), std::string::npos);
}

// KHR_texture_basisu has two channels as red in grey and green in alpha.
TEST(Ktx2, TwoChannels) {
  for (const auto& [name, at, code] : {std::tuple("etc1s_alpha", 47, 4), std::tuple("uastc", 31, 5)}) {
    Binary bytes = bytes_of(name);
    const CodeImage plain = decode(bytes);
    uint32_t descriptor = 0;
    for (size_t i = 4; i-- > 0;) descriptor = descriptor << 8 | bytes[48 + i];
    bytes[descriptor + size_t(at)] = static_cast<unsigned char>(code);
    const CodeImage two = decode(bytes);
    for (size_t i = 0; i < plain.pixels.size(); i++) {
      ASSERT_EQ(two.pixels[i], (plain.pixels[i] & 255) | (plain.pixels[i] >> 24) << 8 | 0xff000000) << name;
    }
  }
}

TEST(Ktx2, OnePictureAndNothingElse) {
  const auto with = [](size_t at, uint32_t value) {
    Binary bytes = bytes_of("etc1s");
    put(bytes, at, value, 4);
    return fault_of(bytes);
  };
  EXPECT_NE(with(28, 4).find("volume"), std::string::npos) << with(28, 4);
  EXPECT_NE(with(32, 4).find("array"), std::string::npos) << with(32, 4);
  EXPECT_NE(with(36, 6).find("cube"), std::string::npos) << with(36, 6);
  EXPECT_NE(with(12, 145).find("Vulkan's number 145"), std::string::npos) << with(12, 145);
  EXPECT_NE(with(44, 7).find("packing 7"), std::string::npos) << with(44, 7);
  EXPECT_NE(with(20, 0).find("no pixels"), std::string::npos) << with(20, 0);
  EXPECT_NE(with(20, 1u << 31).find("exceed"), std::string::npos) << with(20, 1u << 31);
  EXPECT_NE(fault_of(make_ktx2(37, 32000, 8000, {})).find("broken"), std::string::npos);
  Binary video = bytes_of("etc1s");
  uint32_t global = 0;
  for (size_t i = 4; i-- > 0;) global = global << 8 | video[64 + i];
  video[global + 20] = 2;
  EXPECT_NE(fault_of(video).find("video"), std::string::npos) << fault_of(video);
}

TEST(Ktx2, CutShortItIsAnError) {
  for (const Reference& reference : kReferences) {
    const Binary whole = bytes_of(reference.name);
    for (size_t size = 0; size < whole.size(); size += 1 + size / 64) {
      const std::string fault = fault_of(Binary(whole.begin(), whole.begin() + ptrdiff_t(size)));
      ASSERT_TRUE(fault.starts_with("cannot read 'wood.ktx2'")) << reference.name << " " << size << ": " << fault;
    }
  }
}

TEST(Ktx2, DamagedItIsAPictureOrAnError) {
  std::mt19937 random(1);
  size_t errors = 0;
  for (const Reference& reference : kReferences) {
    const Binary whole = bytes_of(reference.name);
    for (int i = 0; i < 300; i++) {
      const std::string fault = fault_of(flip_bits(whole, 1 + i % 5, random));
      if (!fault.empty()) errors++;
      EXPECT_EQ(fault.find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(errors, 100u);
}

}  // namespace ods::ktx2_test
