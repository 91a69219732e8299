// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/resample.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <climits>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "ods/base/wide.h"
#include "ods/image/tone.h"

namespace ods {

// --- texels --------------------------------------------------------------------------------------------------------

static std::vector<float> light_of_halves() {
  std::vector<float> light;
  for (int bits = 0; bits < 1 << 16; bits++) {
    light.push_back(finite(glm::unpackHalf1x16(static_cast<uint16_t>(bits)), -65504.0f, 65504.0f));
  }
  return light;
}

constexpr float kMax = std::numeric_limits<float>::max();

namespace {

// Converts samples of a file to linear light and to numbers. Callers that read many samples fetch the table once.
template <class T>
struct Codes {
  using Type = T;
  static constexpr bool kIsAssociated = false;  // colour is not premultiplied yet
  static const float* table() {
    static const std::vector<float> kTable = linear_from_encoded(std::numeric_limits<T>::max());
    return kTable.data();
  }
  static float light(const float* table, T code) { return table[code]; }
  static float number(T code) { return static_cast<float>(code) / std::numeric_limits<T>::max(); }
};

struct Halves {
  using Type = uint16_t;
  static constexpr bool kIsAssociated = true;
  static const float* table() {
    static const std::vector<float> kTable = light_of_halves();
    return kTable.data();
  }
  static float light(const float* table, uint16_t bits) { return table[bits]; }
  static float number(uint16_t bits) { return table()[bits]; }
};

struct Floats {
  using Type = float;
  static constexpr bool kIsAssociated = true;
  static const float* table() { return nullptr; }
  static float light(const float*, float value) { return finite(value, -kMax, kMax); }
  static float number(float value) { return finite(value, -kMax, kMax); }
};

}  // namespace

template <class Samples>
static typename Samples::Type sample_at(const std::byte* texel, int channel) {
  typename Samples::Type sample;
  std::memcpy(&sample, texel + static_cast<size_t>(channel) * sizeof sample, sizeof sample);
  return sample;
}

// A SIMD register, which compilers do not use automatically here. Both g++ and clang support this attribute.
using Four = float __attribute__((vector_size(16)));

// kAlpha: the last of the channels is alpha.
template <class Samples, int kCount, bool kAlpha>
static Four read_light(const float* table, const std::byte* texel) {
  const auto at = [&](int c) {
    if (c >= kCount) return 0.0f;
    const typename Samples::Type sample = sample_at<Samples>(texel, c < kCount ? c : 0);
    return kAlpha && c == kCount - 1 ? Samples::number(sample) : Samples::light(table, sample);
  };
  const Four value{at(0), at(1), at(2), at(3)};
  if (!kAlpha || Samples::kIsAssociated) return value;
  const float alpha = value[kCount - 1];
  Four share{alpha, alpha, alpha, alpha};
  share[kCount - 1] = 1.0f;
  return value * share;
}

template <class Samples, int kCount, bool kAlpha>
static void read_lights(const LayerPixels& layer, const std::byte* first, Extent size, Four* out) {
  const float* table = Samples::table();
  for (int y = 0; y < size.height; y++, first += layer.row_stride) {
    const std::byte* texel = first;
    for (int x = 0; x < size.width; x++, texel += layer.pixel_stride) {
      *out++ = read_light<Samples, kCount, kAlpha>(table, texel);
    }
  }
}

// Clamps the cubic's overshoot to the range of the texels. kAcross: columns of the filter; 0 for any number.
template <int kAcross>
static Four mix_texels(const Four* texels, int width, const TexelFilter& filter) {
  const int across = kAcross > 0 ? kAcross : filter.across.count;
  Four low = *texels, high = low, sum{};
  for (int y = 0; y < filter.down.count; y++, texels += width) {
    Four row{};
    for (int x = 0; x < across; x++) {
      const Four value = texels[x];
      row += value * filter.across.weights[x];
      low = value < low ? value : low;
      high = value > high ? value : high;
    }
    sum += row * filter.down.weights[y];
  }
  sum = sum > low ? sum : low;  // also replaces NaN, which results from values near the largest float
  return sum < high ? sum : high;
}

template <class Samples>
static void read_numbers(const std::byte* texel, int count, float* out) {
  for (int c = 0; c < count; c++) out[c] = Samples::number(sample_at<Samples>(texel, c));
}

// first: of the texels in the layer. g++ 14 cannot compile Resampler::Group if it contains a type of this file.
using ReadLights = void (*)(const LayerPixels& layer, const std::byte* first, Extent size, Four* out);

template <class Samples>
static ReadLights light_reader(int count, bool alpha) {
  if (alpha) return count == 4 ? read_lights<Samples, 4, true> : read_lights<Samples, 2, true>;
  if (count == 1) return read_lights<Samples, 1, false>;
  if (count == 2) return read_lights<Samples, 2, false>;
  return count == 3 ? read_lights<Samples, 3, false> : read_lights<Samples, 4, false>;
}

static ReadLights light_reader_of(SampleType sample, int count, bool alpha) {
  switch (sample) {
    case SampleType::kUint8:
      return light_reader<Codes<uint8_t>>(count, alpha);
    case SampleType::kUint16:
      return light_reader<Codes<uint16_t>>(count, alpha);
    case SampleType::kHalf:
      return light_reader<Halves>(count, alpha);
    case SampleType::kFloat:
      break;
  }
  return light_reader<Floats>(count, alpha);
}

using ReadNumbers = void (*)(const std::byte* texel, int count, float* out);

static ReadNumbers number_reader_of(SampleType sample) {
  switch (sample) {
    case SampleType::kUint8:
      return read_numbers<Codes<uint8_t>>;
    case SampleType::kUint16:
      return read_numbers<Codes<uint16_t>>;
    case SampleType::kHalf:
      return read_numbers<Halves>;
    case SampleType::kFloat:
      break;
  }
  return read_numbers<Floats>;
}

// --- layers --------------------------------------------------------------------------------------------------------

struct Resampler::Group {
  const TexelReader* reader = nullptr;  // replaces all members below except the channels
  ReadLights read_lights;
  ReadNumbers read_numbers;  // for layers that must not be averaged
  size_t layer;
  ptrdiff_t offset;  // within a texel, bytes
  int first;         // first channel in the pixel
  int count;
  ptrdiff_t size;  // size of the group in a texel, bytes

  const LayerPixels& layer_of(const Source& source, int source_eye) const {
    return source.picture->eyes[static_cast<size_t>(source_eye)].layers[layer];
  }

  const std::byte* texel(const LayerPixels& from, int x, int y) const {
    return from.first + y * from.row_stride + x * from.pixel_stride + offset;
  }

  void read(const Source& source, int source_eye, const Cell& box, Four* out) const {
    if (reader != nullptr) return reader->read(source_eye, box, reinterpret_cast<float*>(out));
    const LayerPixels& from = layer_of(source, source_eye);
    read_lights(from, texel(from, box.left, box.top), {box.right - box.left, box.bottom - box.top}, out);
  }
};

Resampler::Resampler(const Source& source, const TexelReader& reader)
    : source_(source), reader_(&reader), channels_(3) {
  mixed_.push_back({&reader, nullptr, nullptr, 0, 0, 0, 3, 0});
}

Resampler::Resampler(const Source& source, bool adds_alpha) : source_(source) {
  const std::vector<LayerPixels>& layers = source.picture->eyes[0].layers;
  for (size_t i = 0; i < layers.size(); i++) {
    const LayerPixels& layer = layers[i];
    const int all = static_cast<int>(layer.channels.size());
    // Alpha belongs to the preceding colours.
    const bool alpha = layer.rule == LayerRule::kLight && (all == 2 || all == 4) && layer.channels.back() == "A";
    for (int first = 0; first < all; first += 4) {
      const int count = std::min(all - first, 4);
      const Group group{nullptr,
                        light_reader_of(layer.sample, count, alpha),
                        number_reader_of(layer.sample),
                        i,
                        first * static_cast<ptrdiff_t>(bytes_of(layer.sample)),
                        channels_ + first,
                        count,
                        count * static_cast<ptrdiff_t>(bytes_of(layer.sample))};
      (layer.rule == LayerRule::kNearest ? nearest_ : mixed_).push_back(group);
    }
    channels_ += all;
    if (i == 0 && adds_alpha) added_alpha_ = channels_++;
  }
  leaves_some_alone_ = !nearest_.empty() || added_alpha_ >= 0;
}

Resampler::~Resampler() = default;

namespace {

// The box of texels for several filters, and their total number if every filter reads its own.
struct Reach {
  Cell box;
  int texels = 0;
};

}  // namespace

static Reach reach_of(std::span<const TexelFilter> filters) {
  Reach reach{{INT_MAX, INT_MAX, INT_MIN, INT_MIN}};
  for (const TexelFilter& filter : filters) {
    const TexelWeights &across = filter.across, &down = filter.down;
    reach.box.left = std::min(reach.box.left, across.first);
    reach.box.top = std::min(reach.box.top, down.first);
    reach.box.right = std::max(reach.box.right, across.first + across.count);
    reach.box.bottom = std::max(reach.box.bottom, down.first + down.count);
    reach.texels += across.count * down.count;
  }
  return reach;
}

// A fisheye's circle contains a filter's texels if it contains their corners.
bool Resampler::has_all(std::span<const TexelFilter> filters, const Cell& cell) const {
  const Cell box = reach_of(filters).box;
  if (box.left < cell.left || box.right > cell.right || box.top < cell.top || box.bottom > cell.bottom) return false;
  if (!has_image_circle(source_.camera.projection.kind)) return true;
  return std::all_of(filters.begin(), filters.end(), [&](const TexelFilter& filter) {
    const int left = filter.across.first, right = left + filter.across.count - 1;
    const int top = filter.down.first, bottom = top + filter.down.count - 1;
    return has_texel(source_, cell, left, top) && has_texel(source_, cell, right, top) &&
           has_texel(source_, cell, left, bottom) && has_texel(source_, cell, right, bottom);
  });
}

void Resampler::add(const Place& place, const Cell& cell, float weight, float* sums) const {
  TexelFilter filter;
  texel_filters({}, {&place.at, 1}, &filter);
  const int left = filter.across.first, top = filter.down.first;
  const bool inside = has_all({&filter, 1}, cell);
  Texel around[16];
  for (int i = 0; i < 16 && !inside; i++) {
    around[i] = texel_of(source_, place.source_eye, cell, left + i % 4, top + i / 4);
  }
  for (const Group& group : mixed_) {
    Four texels[16];
    if (inside) {
      group.read(source_, place.source_eye, {left, top, left + 4, top + 4}, texels);
    } else {
      for (int i = 0; i < 16; i++) {
        const Texel& t = around[i];
        group.read(source_, t.source_eye, {t.x, t.y, t.x + 1, t.y + 1}, texels + i);
      }
    }
    const Four value = mix_texels<4>(texels, 4, filter);
    for (int c = 0; c < group.count; c++) sums[group.first + c] += weight * value[c];
  }
}

static bool contains(const TexelBlock* block, int source_eye, const Cell& box) {
  return block != nullptr && block->source_eye == source_eye && box.left >= block->box.left &&
         box.right <= block->box.right && box.top >= block->box.top && box.bottom <= block->box.bottom;
}

// `texels` begin at the left top corner of a box of this width.
ODS_WIDE static void mix_pixels(std::span<const TexelFilter> filters, const Four* texels, int left, int top, int width,
                                int count, float* pixel, int stride) {
  for (const TexelFilter& filter : filters) {
    const Four* first = texels + (filter.down.first - top) * width + (filter.across.first - left);
    const Four value =
        filter.across.count == 4 ? mix_texels<4>(first, width, filter) : mix_texels<0>(first, width, filter);
    for (int c = 0; c < count; c++) pixel[c] = value[c];
    pixel += stride;
  }
}

// Adjacent pixels share most of their texels, which are read once for as many pixels as fit into a small box.
void Resampler::fill(int source_eye, std::span<const TexelFilter> filters, float* out, const TexelBlock* block) const {
  const int kMaxTexels = 1024;  // for one filter
  const Reach reach = reach_of(filters);
  if (contains(block, source_eye, reach.box)) {
    const auto* texels = reinterpret_cast<const Four*>(block->texels.data());
    const Cell& box = block->box;
    return mix_pixels(filters, texels, box.left, box.top, box.right - box.left, mixed_[0].count, out, channels_);
  }
  const int left = reach.box.left, top = reach.box.top, width = reach.box.right - left, height = reach.box.bottom - top;
  if (filters.size() > 1 && width * height > std::min(reach.texels, kMaxTexels)) {
    const size_t half = filters.size() / 2;
    fill(source_eye, filters.first(half), out, block);
    return fill(source_eye, filters.subspan(half), out + half * static_cast<size_t>(channels_), block);
  }
  Four texels[kMaxTexels];
  for (const Group& group : mixed_) {
    group.read(source_, source_eye, reach.box, texels);
    mix_pixels(filters, texels, left, top, width, group.count, out + group.first, channels_);
  }
}

void Resampler::read(TexelBlock& block) const {
  const Cell& box = block.box;
  block.texels.resize(4 * static_cast<size_t>(box.right - box.left) * static_cast<size_t>(box.bottom - box.top));
  reader_->read(block.source_eye, box, block.texels.data());
}

void Resampler::copy(int source_eye, int y, std::span<float> out) const {
  constexpr int kAtOnce = 64;
  const int width = source_.picture->size.width;
  const size_t stride = static_cast<size_t>(channels_);
  for (const Group& group : mixed_) {
    Four texels[kAtOnce];
    float* pixel = &out[static_cast<size_t>(group.first)];
    for (int x = 0; x < width; x += kAtOnce) {
      const int count = std::min(kAtOnce, width - x);
      group.read(source_, source_eye, {x, y, x + count, y + 1}, texels);
      for (int i = 0; i < count; i++, pixel += stride) {
        for (int c = 0; c < group.count; c++) pixel[c] = texels[i][c];
      }
    }
  }
  if (!leaves_some_alone_) return;
  for (int x = 0; x < width; x++) {
    const vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    finish({source_eye, middle, true}, &out[static_cast<size_t>(x) * stride]);
  }
}

bool PixelRun::add(const std::optional<TexelTents>& tents, std::span<const vec2> places, float* pixels) {
  if (waiting_ + places.size() > std::size(filters_)) fill();
  TexelFilter* filters = filters_ + waiting_;
  if (tents) texel_filters(*tents, places, filters);
  if (!tents || !resampler_.has_all({filters, places.size()}, cell_)) {
    fill();
    return false;
  }
  if (waiting_ == 0) first_ = pixels;
  waiting_ += places.size();
  return true;
}

void PixelRun::fill() {
  if (waiting_ > 0) resampler_.fill(source_eye_, {filters_, waiting_}, first_, block_);
  waiting_ = 0;
}

void Resampler::set_rest(const Place& place, float* out) const {
  if (added_alpha_ >= 0) out[added_alpha_] = 1.0f;
  const Extent size = source_.picture->size;
  const int x = std::clamp(static_cast<int>(place.at.x), 0, size.width - 1);
  const int y = std::clamp(static_cast<int>(place.at.y), 0, size.height - 1);
  for (const Group& group : nearest_) {
    const std::byte* texel = group.texel(group.layer_of(source_, place.source_eye), x, y);
    group.read_numbers(texel, group.count, out + group.first);
  }
}

}  // namespace ods
