// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/ycbcr.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "ods/video/video_frame.h"

namespace ods {
namespace {

// BT.709-6, 3.2 to 3.4, as the standard has it.
std::array<double, 3> exact(double red, double green, double blue, int bits) {
  const double luma = 0.2126 * red + 0.7152 * green + 0.0722 * blue, unit = std::exp2(bits - 8);
  return {(219.0 * luma + 16.0) * unit, (224.0 * (blue - luma) / 1.8556 + 128.0) * unit,
          (224.0 * (red - luma) / 1.5748 + 128.0) * unit};
}

int value_at(const VideoFrame& frame, size_t plane, int x, int y) {
  const Planes& planes = frame.planes();
  const std::byte* row = planes.first[plane] + static_cast<size_t>(y) * planes.stride[plane];
  if (planes.bits == 8) return static_cast<int>(row[x]);
  return reinterpret_cast<const uint16_t*>(row)[x];
}

VideoFrame frame_of(Extent size, int bits, Chroma chroma, const std::function<vec3(int x, int y)>& code) {
  VideoFrame frame(size, {VideoCodec::kH264, bits, chroma, {}});
  put_ycbcr(
      [&](int y, std::span<float> row) {
        for (int x = 0; x < size.width; x++) {
          for (int c = 0; c < 3; c++) row[static_cast<size_t>(x + c * size.width)] = code(x, y)[c];
        }
      },
      size, frame.planes());
  return frame;
}

TEST(Ycbcr, NamesAndBlocks) {
  EXPECT_EQ(chroma_name(Chroma::k420), "420");
  EXPECT_EQ(chroma_name(Chroma::k422), "422");
  EXPECT_EQ(chroma_name(Chroma::k444), "444");
  EXPECT_EQ(chroma_block(Chroma::k420).height, 2);
  EXPECT_EQ(chroma_block(Chroma::k422).height, 1);
  EXPECT_EQ(chroma_block(Chroma::k444).width, 1);
}

TEST(Ycbcr, BlackAndWhiteAreTheLimits) {
  for (int bits : {8, 10}) {
    for (Chroma chroma : kChromas) {
      const VideoFrame frame = frame_of({4, 2}, bits, chroma, [](int x, int) { return vec3(x < 2 ? 0.0f : 1.0f); });
      EXPECT_EQ(value_at(frame, 0, 0, 0), 16 << (bits - 8));
      EXPECT_EQ(value_at(frame, 0, 3, 1), 235 << (bits - 8));
      EXPECT_EQ(value_at(frame, 1, 0, 0), 128 << (bits - 8));
      EXPECT_EQ(value_at(frame, 2, 1, 0), 128 << (bits - 8));
    }
  }
}

TEST(Ycbcr, EveryGreyIsRoundedToTheNearestAndHasNoColour) {
  for (int bits : {8, 10}) {
    const VideoFrame frame =
        frame_of({256, 1}, bits, Chroma::k444, [](int x, int) { return vec3(static_cast<float>(x) / 255.0f); });
    for (int x = 0; x < 256; x++) {
      EXPECT_EQ(value_at(frame, 0, x, 0), std::lround(exact(x / 255.0, x / 255.0, x / 255.0, bits)[0])) << x;
      EXPECT_EQ(value_at(frame, 1, x, 0), 128 << (bits - 8)) << x;
      EXPECT_EQ(value_at(frame, 2, x, 0), 128 << (bits - 8)) << x;
    }
  }
}

TEST(Ycbcr, ColoursFollowTheStandard) {
  std::mt19937 random(709);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<vec3> colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
  while (colors.size() < 500) colors.push_back({unit(random), unit(random), unit(random)});
  const Extent size{static_cast<int>(colors.size()), 1};
  for (int bits : {8, 10}) {
    const VideoFrame frame =
        frame_of(size, bits, Chroma::k444, [&](int x, int) { return colors[static_cast<size_t>(x)]; });
    for (int x = 0; x < size.width; x++) {
      const vec3 color = colors[static_cast<size_t>(x)];
      const auto wanted = exact(double{color.x}, double{color.y}, double{color.z}, bits);
      for (size_t plane = 0; plane < 3; plane++) EXPECT_NEAR(value_at(frame, plane, x, 0), wanted[plane], 0.501);
    }
  }
}

// The reference is computed pixel by pixel from the header's description.
TEST(Ycbcr, SharedColoursLieOnTheLeftPixels) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const Extent size{12, 6};
  std::vector<vec3> colors(72);
  for (vec3& color : colors) color = {unit(random), unit(random), unit(random)};
  const auto color_at = [&](int x, int y) { return colors[static_cast<size_t>(std::max(x, 0) + y * size.width)]; };
  for (Chroma chroma : {Chroma::k420, Chroma::k422}) {
    const VideoFrame frame = frame_of(size, 10, chroma, color_at);
    const int rows = chroma_block(chroma).height;
    for (int y = 0; y < size.height / rows; y++) {
      for (int x = 0; x < size.width / 2; x++) {
        double wanted[3] = {};
        for (int line = 0; line < rows; line++) {
          for (int i : {-1, 0, 0, 1}) {
            const vec3 color = color_at(2 * x + i, rows * y + line);
            const auto each = exact(double{color.x}, double{color.y}, double{color.z}, 10);
            for (size_t plane = 1; plane < 3; plane++) wanted[plane] += each[plane] / (4.0 * rows);
          }
        }
        for (size_t plane = 1; plane < 3; plane++) EXPECT_NEAR(value_at(frame, plane, x, y), wanted[plane], 0.51);
      }
    }
  }
}

// --- pictures --------------------------------------------------------------------------------------------------------

StoredPicture picture_of(std::vector<float>& memory, Extent size, size_t channels, SampleType sample) {
  StoredPicture picture;
  picture.size = size;
  picture.is_float = sample == SampleType::kFloat;
  LayerPixels layer;
  layer.channels.assign(channels, "");
  layer.sample = sample;
  layer.pixel_stride = static_cast<ptrdiff_t>(channels * bytes_of(sample));
  layer.row_stride = layer.pixel_stride * size.width;
  layer.first = reinterpret_cast<const std::byte*>(memory.data());
  picture.eyes = {{kMono, {layer}}};
  return picture;
}

// A frame that is not held is reused, with its pixels; a held one is not.
TEST(FramePool, FramesAreUsedAgain) {
  std::shared_ptr<VideoFrame> kept;
  {
    const FramePool pool({64, 32}, {});
    std::shared_ptr<VideoFrame> first = pool.take();
    kept = pool.take();
    EXPECT_NE(first, kept);
    const VideoFrame* place = first.get();
    first->planes().first[0][0] = std::byte{77};
    first.reset();
    first = pool.take();
    EXPECT_EQ(first.get(), place);
    EXPECT_EQ(first->planes().first[0][0], std::byte{77});
    EXPECT_NE(pool.take(), first);
    tbb::parallel_for(0, 1000, [&](int i) {
      const std::shared_ptr<VideoFrame> own = pool.take();
      const auto value = static_cast<std::byte>(i % 256);
      std::fill_n(own->planes().first[0], 64 * 32, value);
      EXPECT_EQ(std::count(own->planes().first[0], own->planes().first[0] + 64 * 32, value), 64 * 32);
    });
  }
  kept->planes().first[0][0] = std::byte{1};  // it outlives the pool
}

TEST(VideoFrame, LightIsDevelopedAsPicturesAre) {
  std::vector<float> light;
  for (int i = 0; i < 400; i++)
    light.push_back(std::exp2(static_cast<float>(i % 100) / 5.0f - 16.0f) * (1.0f + 0.3f * static_cast<float>(i % 3)));
  light.insert(light.end(), {NAN, INFINITY, -1.0f, 0.0f, 1e-30f});
  const Extent size{135, 1};
  for (const DisplayTransform& display : {DisplayTransform{}, DisplayTransform{2.0f, ToneCurve::kLinear}}) {
    const StoredPicture picture = picture_of(light, size, 3, SampleType::kFloat);
    VideoFrame frame(size, {VideoCodec::kH264, 10, Chroma::k444, {}});
    fill_frame(picture, Layout::kTopBottom, display, frame);
    for (int x = 0; x < size.width; x++) {
      const float* at = &light[static_cast<size_t>(3 * x)];
      const vec3 shown = tone_map({at[0], at[1], at[2]}, display.exposure, display.tone);
      const auto wanted =
          exact(double{srgb_encode(shown.x)}, double{srgb_encode(shown.y)}, double{srgb_encode(shown.z)}, 10);
      for (size_t plane = 0; plane < 3; plane++) EXPECT_NEAR(value_at(frame, plane, x, 0), wanted[plane], 0.51) << x;
    }
  }
}

TEST(VideoFrame, AlphaIsBeforeBlack) {
  std::vector<float> memory(2);
  auto* bytes = reinterpret_cast<uint8_t*>(memory.data());
  for (int code : {200, 200, 200, 255, 200, 200, 200, 128}) *bytes++ = static_cast<uint8_t>(code);
  const StoredPicture picture = picture_of(memory, {2, 1}, 4, SampleType::kUint8);
  VideoFrame frame({2, 1}, {VideoCodec::kH264, 8, Chroma::k444, {}});
  fill_frame(picture, Layout::kTopBottom, {}, frame);
  EXPECT_EQ(value_at(frame, 0, 0, 0), std::lround(16.0 + 219.0 * 200.0 / 255.0));
  const double half = double{srgb_encode(srgb_decode(200.0f / 255.0f) * (128.0f / 255.0f))};
  EXPECT_EQ(value_at(frame, 0, 1, 0), std::lround(16.0 + 219.0 * half));
}

// One eye red, one blue: nothing of one in the other, however they lie.
TEST(VideoFrame, EyesDoNotBleed) {
  std::vector<float> red, blue;
  for (int i = 0; i < 16; i++) red.insert(red.end(), {1.0f, 0.0f, 0.0f}), blue.insert(blue.end(), {0.0f, 0.0f, 1.0f});
  StoredPicture picture = picture_of(red, {4, 4}, 3, SampleType::kFloat);
  picture.eyes.push_back(picture_of(blue, {4, 4}, 3, SampleType::kFloat).eyes[0]);
  for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
    const Extent size = packed_size(layout, picture.size, 2);
    VideoFrame frame(size, {VideoCodec::kH264, 8, Chroma::k420, {}});
    fill_frame(picture, layout, {0.0f, ToneCurve::kLinear}, frame);
    for (int y = 0; y < size.height / 2; y++) {
      for (int x = 0; x < size.width / 2; x++) {
        const bool is_left = layout == Layout::kTopBottom ? y < size.height / 4 : x < size.width / 4;
        EXPECT_EQ(value_at(frame, 2, x, y), std::lround(exact(is_left, 0.0, !is_left, 8)[2])) << x << " " << y;
      }
    }
  }
}

TEST(VideoFrame, LayoutsThatVideosHave) {
  const std::pair<Layout, Layout> kCases[] = {
      {Layout::kTopBottom, Layout::kTopBottom},         {Layout::kBottomTop, Layout::kTopBottom},
      {Layout::kSideBySide, Layout::kSideBySide},       {Layout::kCrossEyed, Layout::kSideBySide},
      {Layout::kTopBottomHalf, Layout::kTopBottomHalf}, {Layout::kSideBySideHalf, Layout::kSideBySideHalf},
      {Layout::kSeparate, Layout::kTopBottom},          {Layout::kMultiview, Layout::kTopBottom},
      {Layout::kRowInterleaved, Layout::kTopBottom}};
  StoredPicture picture;
  for (const auto& [from, to] : kCases) {
    picture.layout = from;
    EXPECT_EQ(video_layout(picture), to) << layout_name(from);
  }
  picture.layout = Layout::kMultiview;
  picture.camera.projection = find_projection("vr180")->setting;
  EXPECT_EQ(video_layout(picture), Layout::kSideBySide);
}

}  // namespace
}  // namespace ods
