// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/codec_level.h"

#include <cstdint>
#include <span>

namespace ods {

namespace {

struct Level {
  std::string_view name;
  int64_t pixels;      // per picture, rounded up to whole blocks
  int64_t pixel_rate;  // per second
  Extent longest;      // maximum sides; if empty, both at most sqrt(8 pixels)
};

}  // namespace

// The standard counts macroblocks of 16 x 16 pixels.
static constexpr Level h264(std::string_view name, int64_t blocks, int64_t block_rate) {
  return {name, 256 * blocks, 256 * block_rate, {}};
}

static constexpr Level kH264Levels[] = {
    h264("1", 99, 1485),          h264("1.1", 396, 3000),        h264("1.2", 396, 6000),
    h264("1.3", 396, 11880),      h264("2.1", 792, 19800),       h264("2.2", 1620, 20250),
    h264("3", 1620, 40500),       h264("3.1", 3600, 108000),     h264("3.2", 5120, 216000),
    h264("4", 8192, 245760),      h264("4.2", 8704, 522240),     h264("5", 22080, 589824),
    h264("5.1", 36864, 983040),   h264("5.2", 36864, 2073600),   h264("6", 139264, 4177920),
    h264("6.1", 139264, 8355840), h264("6.2", 139264, 16711680),
};

static constexpr Level kHevcLevels[] = {
    {"1", 36864, 552960, {}},          {"2", 122880, 3686400, {}},      {"2.1", 245760, 7372800, {}},
    {"3", 552960, 16588800, {}},       {"3.1", 983040, 33177600, {}},   {"4", 2228224, 66846720, {}},
    {"4.1", 2228224, 133693440, {}},   {"5", 8912896, 267386880, {}},   {"5.1", 8912896, 534773760, {}},
    {"5.2", 8912896, 1069547520, {}},  {"6", 35651584, 1069547520, {}}, {"6.1", 35651584, 2139095040, {}},
    {"6.2", 35651584, 4278190080, {}},
};

static constexpr Level kAv1Levels[] = {
    {"2.0", 147456, 4423680, {2048, 1152}},       {"2.1", 278784, 8363520, {2816, 1584}},
    {"3.0", 665856, 19975680, {4352, 2448}},      {"3.1", 1065024, 31950720, {5504, 3096}},
    {"4.0", 2359296, 70778880, {6144, 3456}},     {"4.1", 2359296, 141557760, {6144, 3456}},
    {"5.0", 8912896, 267386880, {8192, 4352}},    {"5.1", 8912896, 534773760, {8192, 4352}},
    {"5.2", 8912896, 1069547520, {8192, 4352}},   {"6.0", 35651584, 1069547520, {16384, 8704}},
    {"6.1", 35651584, 2139095040, {16384, 8704}}, {"6.2", 35651584, 4278190080, {16384, 8704}},
};

static constexpr Level kVp9Levels[] = {
    {"1", 36864, 829440, {512, 512}},
    {"1.1", 73728, 2764800, {768, 768}},
    {"2", 122880, 4608000, {960, 960}},
    {"2.1", 245760, 9216000, {1344, 1344}},
    {"3", 552960, 20736000, {2048, 2048}},
    {"3.1", 983040, 36864000, {2752, 2752}},
    {"4", 2228224, 83558400, {4160, 4160}},
    {"4.1", 2228224, 160432128, {4160, 4160}},
    {"5", 8912896, 311951360, {8384, 8384}},
    {"5.1", 8912896, 588251136, {8384, 8384}},
    {"5.2", 8912896, 1176502272, {8384, 8384}},
    {"6", 35651584, 1176502272, {16832, 16832}},
    {"6.1", 35651584, 2353004544, {16832, 16832}},
    {"6.2", 35651584, 4706009088, {16832, 16832}},
};

namespace {

struct CodecFacts {
  int block;  // each side is coded as a multiple of this
  std::span<const Level> levels;
};

}  // namespace

static CodecFacts facts_of(Codec codec) {
  switch (codec) {
    case Codec::kH264:
      return {16, kH264Levels};
    case Codec::kHevc:
      return {8, kHevcLevels};
    case Codec::kAv1:
      return {1, kAv1Levels};
    case Codec::kVp9:
      break;
  }
  return {1, kVp9Levels};
}

static bool holds(const Level& level, int64_t width, int64_t height, double fps) {
  const int64_t pixels = width * height;
  if (pixels > level.pixels || static_cast<double>(pixels) * fps > static_cast<double>(level.pixel_rate)) return false;
  if (level.longest.width > 0) return width <= level.longest.width && height <= level.longest.height;
  return width * width <= 8 * level.pixels && height * height <= 8 * level.pixels;
}

std::string_view smallest_level(Codec codec, Extent size, double fps) {
  const CodecFacts facts = facts_of(codec);
  const auto whole_blocks = [&](int64_t side) { return (side + facts.block - 1) / facts.block * facts.block; };
  for (const Level& level : facts.levels) {
    if (holds(level, whole_blocks(size.width), whole_blocks(size.height), fps)) return level.name;
  }
  return {};
}

}  // namespace ods
