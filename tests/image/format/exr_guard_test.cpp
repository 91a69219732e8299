// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Headers written by hand, as hostile files have them: a few bytes that ask OpenEXR for gigabytes.
#include "ods/image/format/exr_guard.h"

#include <gtest/gtest.h>

#include <cstring>
#include <tuple>

namespace ods {
namespace {

std::string number(uint32_t value) {
  std::string bytes(4, '\0');
  for (unsigned i = 0; i < 4; i++) bytes[i] = static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

// `stated`: the size in the file, if it differs from the value's.
std::string attribute(const std::string& type, const std::string& value, uint32_t stated = 0) {
  return "name" + std::string(1, '\0') + type + std::string(1, '\0') +
         number(stated > 0 ? stated : static_cast<uint32_t>(value.size())) + value;
}

std::string channel(const std::string& name) {
  return name + std::string(17, '\0');
}

std::string fault_of(const std::string& attributes) {
  const std::string file = "v/1\1" + number(2) + attributes + std::string(100, '\0');
  return exr_header_fault(file.size(), [&](size_t offset, void* to, size_t count) {
    if (offset > file.size() || count > file.size() - offset) return false;
    std::memcpy(to, file.data() + offset, count);
    return true;
  });
}

bool is_taken(const std::string& attributes) {
  return fault_of(attributes).empty();
}

const std::string kChannels = channel("B") + channel("G") + std::string(1, '\0');
// OpenEXR would read this one where the guard has read another.
const std::string kHuge = attribute("string", "", 0x6f703a03);

TEST(ExrGuard, TakesAttributesOfTheirSize) {
  const std::tuple<const char*, size_t> kSizes[] = {
      {"int", 4},         {"float", 4},     {"double", 8},         {"box2i", 16},   {"v2f", 8},
      {"v3f", 12},        {"m33f", 36},     {"m44f", 64},          {"keycode", 28}, {"timecode", 8},
      {"compression", 1}, {"lineOrder", 1}, {"rational", 8},       {"tiledesc", 9}, {"string", 5},
      {"floatvector", 8}, {"unknown", 7},   {"chromaticities", 32}};
  for (const auto& [type, size] : kSizes) {
    EXPECT_TRUE(is_taken(attribute(type, std::string(size, 'a')))) << type;
  }
  EXPECT_TRUE(is_taken(attribute("chlist", kChannels)));
  EXPECT_TRUE(is_taken(attribute("stringvector", number(2) + "ab" + number(1) + "c")));
  EXPECT_TRUE(is_taken(attribute("preview", number(2) + number(1) + std::string(8, 'x'))));
}

TEST(ExrGuard, RefusesAListOfChannelsThatEndsElsewhere) {
  const auto size = static_cast<uint32_t>(kChannels.size());
  for (const uint32_t stated : {size - 1, size - 4, size + 1, uint32_t{1}, uint32_t{19}}) {
    EXPECT_FALSE(is_taken(attribute("chlist", kChannels, stated) + kHuge)) << stated;
  }
}

TEST(ExrGuard, RefusesSizesThatAreNotOfTheType) {
  for (const char* type : {"int", "float", "box2i", "v2f", "compression", "envmap", "lineOrder", "tiledesc"}) {
    EXPECT_FALSE(is_taken(attribute(type, std::string(60, '\0')))) << type;
  }
  EXPECT_FALSE(is_taken(attribute("floatvector", "abcdef")));
}

TEST(ExrGuard, RefusesListsAndPreviewsThatAreNotThere) {
  EXPECT_FALSE(is_taken(kHuge));
  EXPECT_FALSE(is_taken(attribute("stringvector", number(0x7fffffff))));
  EXPECT_FALSE(is_taken(attribute("stringvector", number(6) + "ab")));
  for (const uint32_t side : {uint32_t{30000}, uint32_t{0x80000000}, uint32_t{0xffffffff}}) {
    EXPECT_FALSE(is_taken(attribute("preview", number(side) + number(side)))) << side;
  }
}

// OpenEXR would make room for rows of that width first.
TEST(ExrGuard, RefusesPicturesBeyondTheLimits) {
  const auto window = [](uint32_t right, uint32_t bottom) {
    return "dataWindow" + std::string(1, '\0') + "box2i" + std::string(1, '\0') + number(16) + number(0) + number(0) +
           number(right) + number(bottom);
  };
  EXPECT_EQ(fault_of(window(15, 7)), "");
  EXPECT_EQ(fault_of(window(6094863, 7)), "6094864x8 pixels exceed the limits of 32768 per side and 268435456 in all");
  EXPECT_NE(fault_of(window(0x7fffffff, 0x7fffffff)), "");
}

}  // namespace
}  // namespace ods
