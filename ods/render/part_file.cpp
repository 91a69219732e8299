// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/part_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "ods/base/error.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {
namespace {

constexpr const char* kPart = "ods:part";
constexpr const char* kSamples = "ods:samples";
constexpr const char* kExposure = "ods:exposure";
constexpr const char* kSettings = "ods:settings";
constexpr const char* kSidecar = "ods:sidecar";

// A number's bits as whole numbers that floats hold exactly.
template <typename Number>
struct Words {
  using Bits = std::conditional_t<sizeof(Number) == 8, uint64_t, uint32_t>;
  static constexpr size_t kCount = sizeof(Number) == 8 ? 3 : 2;
  static constexpr unsigned kBits = 22;

  static void split(Number number, float* words) {
    const Bits bits = std::bit_cast<Bits>(number);
    for (size_t i = 0; i < kCount; i++) words[i] = static_cast<float>(bits >> (i * kBits) & ((1u << kBits) - 1));
  }
  static Number join(const float* words) {
    Bits bits = 0;
    for (size_t i = 0; i < kCount; i++) {
      if (words[i] >= 0.0f && words[i] < 1u << kBits) bits |= static_cast<Bits>(words[i]) << (i * kBits);
    }
    return std::bit_cast<Number>(bits);
  }
};

size_t pixels_of(const PictureSamples& samples) {
  return static_cast<size_t>(samples.width) * static_cast<size_t>(samples.height);
}

// The names of a plane's channels: sum.light.R0 ...
std::vector<std::string> channels_of(const char* plane, size_t numbers, size_t words) {
  std::vector<std::string> names;
  for (size_t n = 0; n < numbers; n++) {
    for (size_t w = 0; w < words; w++)
      names.push_back(fmt::format("sum.{}.{}{}", plane, numbers == 1 ? 'Y' : "RGB"[n], w));
  }
  return names;
}

RowLayer picture_layer() {
  return {{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf};
}

std::vector<RowLayer> layers_of(const PictureSamples& samples) {
  std::vector<RowLayer> layers{picture_layer()};
  each_plane(samples.eyes[0], [&]<typename Number>(const char* name, const std::vector<Number>& plane) {
    const size_t numbers = plane.size() / pixels_of(samples);
    if (plane.empty()) return;
    layers.push_back({channels_of(name, numbers, Words<Number>::kCount), LayerRule::kNearest, SampleType::kFloat});
  });
  return layers;
}

void fill_row(const PictureSamples& samples, const EyeSamples& eye, int y, std::span<float> row) {
  const size_t width = static_cast<size_t>(samples.width);
  float* to = row.data();
  for (size_t pixel = static_cast<size_t>(y) * width; pixel < (static_cast<size_t>(y) + 1) * width; pixel++) {
    const double count = std::max(eye.count[pixel], 1u);
    for (size_t c = 0; c < 3; c++)
      *to++ = static_cast<float>(static_cast<double>(eye.light[3 * pixel + c]) / (kLightUnit * count));
    each_plane(eye, [&]<typename Number>(const char*, const std::vector<Number>& plane) {
      const size_t numbers = plane.size() / pixels_of(samples);
      for (size_t n = 0; n < numbers; n++, to += Words<Number>::kCount)
        Words<Number>::split(plane[numbers * pixel + n], to);
    });
  }
}

// The layer of an eye that holds a plane; nullptr if there is none.
const LayerPixels* find_plane(const StoredEye& eye, const char* plane) {
  const std::string prefix = fmt::format("sum.{}.", plane);
  for (const LayerPixels& layer : eye.layers) {
    if (layer.channels[0].starts_with(prefix)) return &layer;
  }
  return nullptr;
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::kInput, fmt::format("'{}' {}", path, what));
}

// Depth is the same in every part; everything else adds up.
template <typename Number>
void add_number(const char* plane, Number number, Number& sum) {
  if (std::strcmp(plane, "depth") == 0) {
    sum = number;
  } else if constexpr (std::is_integral_v<Number>) {
    if (__builtin_add_overflow(sum, number, &sum)) sum = 0;  // no file of ours
  } else {
    sum += number;
  }
}

// Where a pixel of the layer has its channels, in the order in which channels_of() names them.
template <typename Number>
std::vector<size_t> offsets_of(const std::string& path, const LayerPixels* layer, const char* plane, size_t numbers) {
  std::vector<size_t> offsets;
  for (const std::string& channel : channels_of(plane, numbers, Words<Number>::kCount)) {
    const size_t n =
        layer ? static_cast<size_t>(std::ranges::find(layer->channels, channel) - layer->channels.begin()) : 0;
    if (!layer || n == layer->channels.size() || layer->sample != SampleType::kFloat) {
      fail(path, fmt::format("lacks {}: render the part again", channel));
    }
    offsets.push_back(n * sizeof(float));
  }
  return offsets;
}

void add_eye(const std::string& path, const StoredEye& stored, const PictureSamples& samples, EyeSamples& eye) {
  each_plane(eye, [&]<typename Number>(const char* name, std::vector<Number>& plane) {
    if (plane.empty()) return;
    const size_t numbers = plane.size() / pixels_of(samples), words = Words<Number>::kCount;
    const LayerPixels* layer = find_plane(stored, name);
    const std::vector<size_t> offsets = offsets_of<Number>(path, layer, name, numbers);
    tbb::parallel_for(0, samples.height, [&](int y) {
      const std::byte* from = layer->first + y * layer->row_stride;
      const size_t row = static_cast<size_t>(y) * static_cast<size_t>(samples.width);
      for (size_t x = 0; x < static_cast<size_t>(samples.width); x++, from += layer->pixel_stride) {
        std::array<float, 9> parts{};
        for (size_t i = 0; i < offsets.size(); i++) std::memcpy(&parts[i], from + offsets[i], sizeof(float));
        for (size_t n = 0; n < numbers; n++) {
          add_number(name, Words<Number>::join(&parts[n * words]), plane[numbers * (row + x) + n]);
        }
      }
    });
  });
}

}  // namespace

std::string save_part(const std::string& path, const SampledPicture& picture, const PictureSamples& samples) {
  std::vector<std::string> ignored;
  const StereoCamera camera = read_sidecar(picture.camera, path, ignored).camera;
  PictureRows rows;
  rows.eye = {samples.width, samples.height};
  for (const EyeSamples& eye : samples.eyes) rows.eyes.push_back(eye.eye);
  rows.layers = layers_of(samples);
  rows.fill = [&](int eye, int y, std::span<float> row) {
    fill_row(samples, samples.eyes[static_cast<size_t>(eye)], y, row);
  };
  SaveOptions options;
  if (samples.eyes.size() == 2) options.layout = Layout::kMultiview;
  options.attributes = {{kPart, part_text(picture.options.part)},
                        {kSamples, picture.options.samples},
                        {kExposure, fmt::format("{}", picture.exposure)},
                        {kSettings, picture.settings},
                        {kSidecar, picture.camera}};
  return save_picture(rows, &camera, options, path).front();
}

SampledPicture read_part_header(const std::string& path) {
  const FileInfo info = read_info(path);
  const auto text = [&](const char* name) {
    const auto found = info.text.find(name);
    return found == info.text.end() ? "" : found->second;
  };
  const auto samples = info.numbers.find(kSamples);
  SampledPicture picture;
  picture.settings = text(kSettings), picture.camera = text(kSidecar);
  const float exposure = std::strtof(text(kExposure).c_str(), nullptr);
  if (std::isfinite(exposure)) picture.exposure = exposure;
  RenderOptions& options = picture.options;
  const std::optional<Part> part = parse_part(text(kPart));
  options.samples = samples == info.numbers.end() ? 0 : static_cast<int>(samples->second.front());
  if (!part || options.samples < 1 || options.samples > kMaxSamples || picture.camera.empty()) {
    fail(path, "is no part of a picture: ods render --part makes those");
  }
  options.part = *part;
  const StoredPicture header = PictureReader(path).header();
  options.width = header.size.width, options.height = header.size.height;
  const int eye = header.eyes[0].eye;
  options.eyes = header.eyes.size() == 2 ? Eyes::kBothEyes
                 : eye == kLeft          ? Eyes::kLeftEye
                 : eye == kRight         ? Eyes::kRightEye
                                         : Eyes::kMonoEye;
  const auto has = [&](const char* plane) { return find_plane(header.eyes[0], plane) != nullptr; };
  options.statistics = has("squares"), options.share_paths = has("alone");
  options.layers = has("normal"), options.transparent = has("hits");
  return picture;
}

void add_part(const std::string& path, const RenderOptions& options, PictureSamples& sum) {
  const StoredPicture part = open_picture(path);
  bool same = part.size.width == sum.width && part.size.height == sum.height && part.eyes.size() == sum.eyes.size();
  for (size_t i = 0; same && i < sum.eyes.size(); i++) same = part.eyes[i].eye == sum.eyes[i].eye;
  if (!same) fail(path, fmt::format("is not {} pixels wide, or has other eyes", options.width));
  for (size_t i = 0; i < sum.eyes.size(); i++) add_eye(path, part.eyes[i], sum, sum.eyes[i]);
}

}  // namespace ods
