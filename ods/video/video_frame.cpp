// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/video_frame.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <mutex>
#include <new>
#include <vector>

#include "ods/base/wide.h"

namespace ods {

// --- memory ----------------------------------------------------------------------------------------------------------

static constexpr std::align_val_t kAlign{64};  // for the widest SIMD loads

void VideoFrame::Free::operator()(std::byte* bytes) const {
  operator delete[](bytes, kAlign);
}

VideoFrame::VideoFrame(Extent size, const Packing& packing) : size_(size) {
  const size_t align = static_cast<size_t>(kAlign);
  planes_.bits = packing.bits;
  planes_.chroma = packing.chroma;
  std::array<size_t, 3> starts{};
  for (size_t i = 0; i < 3; i++) {
    const Extent share = i == 0 ? Extent{1, 1} : chroma_block(packing.chroma);
    const size_t row = static_cast<size_t>(size.width / share.width) * (packing.bits > 8 ? 2 : 1);
    planes_.stride[i] = (row + align - 1) / align * align;
    starts[i] = bytes_;
    bytes_ += planes_.stride[i] * static_cast<size_t>(size.height / share.height);
  }
  bytes_ += align;  // encoders may read past the last pixel
  memory_.reset(new (kAlign) std::byte[bytes_]());
  for (size_t i = 0; i < 3; i++) planes_.first[i] = memory_.get() + starts[i];
}

struct FramePool::Shelf {
  Extent size;
  Packing packing;
  std::mutex mutex;
  std::vector<std::unique_ptr<VideoFrame>> free;

  std::unique_ptr<VideoFrame> take() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (free.empty()) return nullptr;
    std::unique_ptr<VideoFrame> frame = std::move(free.back());
    free.pop_back();
    return frame;
  }
  void put(std::unique_ptr<VideoFrame> frame) {
    const std::lock_guard<std::mutex> lock(mutex);
    free.push_back(std::move(frame));
  }
};

FramePool::FramePool(Extent size, const Packing& packing) : shelf_(std::make_shared<Shelf>()) {
  shelf_->size = size, shelf_->packing = packing;
}

std::shared_ptr<VideoFrame> FramePool::take() const {
  std::unique_ptr<VideoFrame> frame = shelf_->take();
  if (!frame) frame = std::make_unique<VideoFrame>(shelf_->size, shelf_->packing);
  return {frame.release(), [shelf = shelf_](VideoFrame* old) { shelf->put(std::unique_ptr<VideoFrame>(old)); }};
}

// --- colours ---------------------------------------------------------------------------------------------------------

namespace {

// srgb_encode() from 2^-12 to 4, accurate to a millionth: a table with 512 steps per octave.
class SrgbTable {
 public:
  SrgbTable() {
    for (size_t i = 0; i < codes_.size(); i++) {
      codes_[i] = srgb_encode(std::bit_cast<float>(kFirst + (static_cast<uint32_t>(i) << kShift)));
    }
  }
  float operator()(float linear) const {
    if (!(linear >= kDarkest)) return linear <= -kDarkest ? -above(-linear) : 12.92f * linear;
    return above(linear);
  }

 private:
  float above(float linear) const {
    const uint32_t bits = std::bit_cast<uint32_t>(linear);
    const size_t i = std::min<size_t>((bits - kFirst) >> kShift, codes_.size() - 2);
    const float share = static_cast<float>(bits - kFirst - (static_cast<uint32_t>(i) << kShift)) / (1 << kShift);
    return codes_[i] + share * (codes_[i + 1] - codes_[i]);
  }

  static constexpr float kDarkest = 0x1p-12f;
  static constexpr uint32_t kFirst = std::bit_cast<uint32_t>(kDarkest);
  static constexpr int kShift = 14;
  std::array<float, 14 * 512 + 1> codes_{};
};

}  // namespace

static const SrgbTable& srgb_table() {
  static const SrgbTable table;
  return table;
}

float video_code(float linear) {
  return srgb_table()(linear);
}

ODS_WIDE void video_codes(std::span<const float> light, float* codes) {
  const SrgbTable& table = srgb_table();
  for (size_t i = 0; i < light.size(); i++) codes[i] = table(light[i]);
}

namespace {

// The light of codes -0.5 to 1.5, in steps of 16 bits.
class LightTable {
 public:
  LightTable() {
    for (size_t i = 0; i < light_.size(); i++) {
      const float code = static_cast<float>(static_cast<int>(i) - kZero) / 65535.0f;
      light_[i] = code < 0.0f ? -srgb_decode(-code) : srgb_decode(code);
    }
  }
  float operator()(float code) const {
    const float nearest = std::clamp(code, -0.5f, 1.49f) * 65535.0f + 0.5f;
    return light_[static_cast<size_t>(static_cast<int>(nearest) + kZero)];
  }

 private:
  static constexpr int kZero = 32768;
  std::vector<float> light_ = std::vector<float>(131072);
};

}  // namespace

static const LightTable& light_table() {
  static const LightTable table;
  return table;
}

float video_light(float code) {
  return light_table()(code);
}

ODS_WIDE void video_lights(std::span<const float> row, float* pixels) {
  const LightTable& table = light_table();
  const size_t width = row.size() / 3;
  const float *red = row.data(), *green = red + width, *blue = green + width;
  for (size_t x = 0; x < width; x++, pixels += 4) {
    pixels[0] = table(red[x]), pixels[1] = table(green[x]), pixels[2] = table(blue[x]), pixels[3] = 0.0f;
  }
}

namespace {

// A row of one layer, to be converted to planar red, green, blue, 0..1.
struct RowOfCodes {
  const LayerPixels& layer;
  const std::byte* in;
  std::span<float> out;

  size_t width() const { return out.size() / 3; }
  void put(size_t x, vec3 codes) const {
    for (size_t c = 0; c < 3; c++) out[x + c * width()] = codes[static_cast<int>(c)];
  }
};

}  // namespace

static void develop(const RowOfCodes& row, const DisplayTransform& display) {
  const std::byte* in = row.in;
  const size_t step = bytes_of(row.layer.sample);
  for (size_t x = 0; x < row.width(); x++, in += row.layer.pixel_stride) {
    vec3 light;
    for (size_t c = 0; c < 3; c++) light[static_cast<int>(c)] = sample_value(row.layer.sample, in + c * step);
    const vec3 shown = tone_map(light, display.exposure, display.tone);
    row.put(x, {video_code(shown.x), video_code(shown.y), video_code(shown.z)});
  }
}

template <typename T>
static void copy_codes(const RowOfCodes& row, float largest) {
  const std::byte* in = row.in;
  const size_t width = row.width();
  for (size_t x = 0; x < width; x++, in += row.layer.pixel_stride) {
    std::array<T, 3> codes;
    std::copy_n(in, sizeof(codes), reinterpret_cast<std::byte*>(codes.data()));
    for (size_t c = 0; c < 3; c++) row.out[x + c * width] = static_cast<float>(codes[c]) * (1.0f / largest);
  }
}

// Composites over black: these colours are not premultiplied.
static void put_before_black(const RowOfCodes& row) {
  const std::byte* in = row.in + 3 * bytes_of(row.layer.sample);
  for (size_t x = 0; x < row.width(); x++, in += row.layer.pixel_stride) {
    const float alpha = sample_value(row.layer.sample, in);
    if (alpha >= 1.0f) continue;
    for (size_t c = 0; c < 3; c++) {
      float& code = row.out[x + c * row.width()];
      code = video_code(srgb_decode(code) * alpha);
    }
  }
}

static void read_codes(const RowOfCodes& row, const DisplayTransform& display) {
  switch (row.layer.sample) {
    case SampleType::kHalf:
    case SampleType::kFloat:
      return develop(row, display);
    case SampleType::kUint8:
      copy_codes<uint8_t>(row, 255.0f);
      break;
    case SampleType::kUint16:
      copy_codes<uint16_t>(row, 65535.0f);
      break;
  }
  if (row.layer.channels.size() == 4) put_before_black(row);
}

// --- the frame -------------------------------------------------------------------------------------------------------

Layout video_layout(const StoredPicture& picture) {
  EyeArrangement eyes = arrangement_of(picture.layout);
  if (eyes.how != EyePacking::kBeside && !eyes.squeezed) return default_layout(picture.camera.projection);
  eyes.right_first = false;
  return *layout_with(eyes);
}

void fill_frame(const StoredPicture& picture, Layout layout, const DisplayTransform& display, VideoFrame& frame) {
  const Extent eye = picture.size;
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    const LayerPixels& layer = picture.eyes[i].layers[0];
    const EyeCorner corner = eye_corner(layout, eye, static_cast<int>(i));
    const Planes planes = frame.planes().at(corner.x, corner.y);
    const auto rows = [&](int y, std::span<float> row) {
      read_codes({layer, layer.first + y * layer.row_stride, row}, display);
    };
    put_ycbcr(rows, eye, planes);
  }
}

}  // namespace ods
