// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the options for lenses and bars (--circle, --front-and-back). Any numbers give lenses of the picture or
// an error. A lens maps a direction to a position in the picture or to none, and the converted picture has no NaN.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_lens_reader
//   build/fuzz/fuzz_lens_reader -max_len=128 build/corpus
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "ods/base/error.h"
#include "ods/convert/convert.h"
#include "ods/picture/stored_lenses.h"

namespace {

class Numbers {
 public:
  Numbers(const uint8_t* data, size_t size) : at_(data), end_(data + size) {}
  bool are_left() const { return at_ != end_; }
  template <typename T>
  T next() {
    T value{};
    const size_t size = std::min(sizeof value, static_cast<size_t>(end_ - at_));
    std::memcpy(&value, at_, size);
    at_ += size;
    return value;
  }

 private:
  const uint8_t *at_, *end_;
};

ods::FisheyeLens next_lens(Numbers& numbers) {
  ods::FisheyeLens lens;
  for (float* each : {&lens.center.x, &lens.center.y, &lens.radius, &lens.fov}) *each = numbers.next<float>();
  lens.kind = numbers.next<uint8_t>() % 2 == 0 ? ods::kFisheye : ods::kFisheyeEquisolid;
  for (float* each : {&lens.yaw, &lens.pitch, &lens.roll}) *each = numbers.next<int16_t>() / 100.0f;
  return lens;
}

void look_around(const ods::StoredPicture& picture) {
  for (const auto& map : picture.maps) {
    for (int i = 0; i < 200; i++) {
      const float theta = 0.7f * static_cast<float>(i), phi = static_cast<float>(i) / 100.0f - 1.0f;
      const ods::ImagePoint point = map->place({std::sin(theta), phi, -std::cos(theta)});
      if (!point.seen) continue;
      if (!(point.uv.x >= 0.0f && point.uv.x <= 1.0f && point.uv.y >= 0.0f && point.uv.y <= 1.0f)) std::abort();
    }
  }
}

void convert_picture(const ods::StoredPicture& picture) {
  ods::ConvertTarget target = same_format(picture);
  target.eye = {24, 16};
  if (!conversion_fault(picture, target).empty()) return;
  const ods::Conversion conversion = convert(picture, target);
  std::vector<float> row(24 * count_channels(conversion.rows.layers));
  for (int y = 0; y < 16; y++) {
    conversion.rows.fill(0, y, row);
    if (std::any_of(row.begin(), row.end(), [](float value) { return std::isnan(value); })) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Numbers numbers(data, size);
  const ods::Extent eye{1 + numbers.next<uint8_t>() % 64, 1 + numbers.next<uint8_t>() % 64};
  const ods::Layout layout = ods::kLayouts[numbers.next<uint8_t>() % std::size(ods::kLayouts)];
  const std::vector<std::byte> pixels(3 * static_cast<size_t>(eye.width) * static_cast<size_t>(eye.height),
                                      std::byte{99});
  ods::StoredPicture picture;
  picture.size = eye, picture.layout = layout;
  const ods::LayerPixels layer{{"R", "G", "B"}, ods::LayerRule::kLight, ods::SampleType::kUint8, pixels.data(), 3,
                               3 * eye.width};
  const bool is_pair = numbers.next<uint8_t>() % 2 == 0;
  picture.eyes.push_back({is_pair ? ods::kLeft : ods::kMono, {layer}});
  if (is_pair) picture.eyes.push_back({ods::kRight, {layer}});
  ods::FormatHint known;
  known.front_and_back = numbers.next<uint8_t>() % 2 == 0;
  while (numbers.are_left() && known.lenses.size() < 3) known.lenses.push_back(next_lens(numbers));
  try {
    take_lenses(picture, known, "picture.jpg");
  } catch (const ods::Error&) {
    return 0;
  }
  look_around(picture);
  convert_picture(picture);
  return 0;
}
