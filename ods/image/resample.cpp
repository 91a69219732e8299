// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/resample.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "ods/image/tone.h"

namespace ods {

// --- the filter ----------------------------------------------------------------------------------------------------

// Below this the picture is only interpolated: half a texel's hundredth of blur would cost its sharpness for nothing.
static const float kLeastRadius = 0.15f;
static const int kMostPoints = 65;  // along one axis

// Points an equal step apart. Their weights, 1 together, rise and fall by equal steps.
struct Tent {
  int count = 1;
  float offset = 0.0f;  // of the first point
  float step = 0.0f;
  float first_weight = 1.0f;

  float at(int i) const { return offset + step * static_cast<float>(i); }
  float weight(int i) const { return first_weight * static_cast<float>(std::min(2 * i + 1, 2 * (count - i) - 1)); }
};

// Points whose variance is the tent's own, radius^2 / 6. Those of a tent of radius 1 have a somewhat larger one, by the
// sums of 1, 3, 5, ... and their squares and cubes: a sixth of `variance`.
static Tent make_tent(float variance_of_6) {
  Tent tent;
  if (variance_of_6 < kLeastRadius * kLeastRadius) return tent;
  tent.count = std::min(1 + static_cast<int>(std::ceil(2.0f * std::sqrt(variance_of_6))), kMostPoints);
  const bool even = tent.count % 2 == 0;
  const float n = static_cast<float>(tent.count), nn = n * n;
  const float variance = even ? 1.0f + 2.0f / nn : (nn - 1.0f) * (nn + 3.0f) / (nn * (nn + 1.0f));
  const float radius = std::sqrt(variance_of_6 / variance);
  tent.first_weight = 2.0f / (even ? nn : nn + 1.0f);
  tent.step = 2.0f * radius / n;
  tent.offset = 0.5f * tent.step - radius;
  return tent;
}

void filter_points(const Footprint& footprint, std::vector<FilterPoint>& points) {
  const vec2 dx = footprint.dx, dy = footprint.dy;
  // Axes of the ellipse that a round pixel becomes: eigenvectors of J J^T, and s^2 along them.
  const float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  points.assign(1, {vec2(0.0f), vec2(0.0f), 1.0f});
  if (xx + yy <= 1.0f) return;
  const float middle = 0.5f * (xx + yy), half = std::sqrt(0.25f * (xx - yy) * (xx - yy) + xy * xy);
  const float large = middle + half, small = middle - half;
  const Tent along = make_tent(large - 1.0f), across = make_tent(small - 1.0f);
  if (along.count == 1 || !std::isfinite(large)) return;
  vec2 axis = xx >= yy ? vec2(large - yy, xy) : vec2(xy, large - xx);
  axis = length(axis) > 0.0f ? normalize(axis) : vec2(1.0f, 0.0f);
  const vec2 other(-axis.y, axis.x);
  const auto back = [&](vec2 v, float square) { return vec2(dot(dx, v), dot(dy, v)) / square; };
  const vec2 pixels_along = back(axis, large), pixels_across = small > 0.5f ? back(other, small) : vec2(0.0f);
  points.clear();
  for (int j = 0; j < across.count; j++) {
    for (int i = 0; i < along.count; i++) {
      const float t = along.at(i), u = across.at(j);
      points.push_back(
          {axis * t + other * u, pixels_along * t + pixels_across * u, along.weight(i) * across.weight(j)});
    }
  }
}

// --- texels --------------------------------------------------------------------------------------------------------

static std::vector<float> light_of_halves() {
  std::vector<float> light;
  for (int bits = 0; bits < 1 << 16; bits++) {
    light.push_back(finite(glm::unpackHalf1x16(static_cast<uint16_t>(bits)), -65504.0f, 65504.0f));
  }
  return light;
}

constexpr float kMost = std::numeric_limits<float>::max();

// Samples of a file to light and to numbers. Whoever reads many asks for the table once.
template <class T>
struct Codes {
  using Type = T;
  static constexpr bool kIsAssociated = false;  // colour is not multiplied by alpha yet
  static const float* table() {
    static const std::vector<float> kTable = light_of_codes(std::numeric_limits<T>::max());
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
  static float light(const float*, float value) { return finite(value, -kMost, kMost); }
  static float number(float value) { return finite(value, -kMost, kMost); }
};

template <class Samples>
static typename Samples::Type sample_at(const std::byte* texel, int channel) {
  typename Samples::Type sample;
  std::memcpy(&sample, texel + static_cast<size_t>(channel) * sizeof sample, sizeof sample);
  return sample;
}

// A register of the processor, which compilers do not find by themselves here. Both g++ and clang know it so.
using Four = float __attribute__((vector_size(16)));

// The last of the channels is alpha where kAlpha says so.
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

// Texels as they lie in a picture.
struct Block {
  const std::byte* first;
  ptrdiff_t pixel_stride;
  ptrdiff_t row_stride;
};

template <class Samples, int kCount, bool kAlpha>
static void read_lights(const Block& block, int width, int height, Four* out) {
  const float* table = Samples::table();
  const std::byte* start = block.first;
  for (int y = 0; y < height; y++, start += block.row_stride) {
    const std::byte* texel = start;
    for (int x = 0; x < width; x++, texel += block.pixel_stride) {
      *out++ = read_light<Samples, kCount, kAlpha>(table, texel);
    }
  }
}

// What is between texels is not beyond them: the cubic's overshoot is cut. kAcross: columns of the filter; 0: any.
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
  sum = sum > low ? sum : low;  // NaN too, of numbers near the largest
  return sum < high ? sum : high;
}

template <class Samples>
static void read_numbers(const std::byte* texel, int count, float* out) {
  for (int c = 0; c < count; c++) out[c] = Samples::number(sample_at<Samples>(texel, c));
}

using ReadLights = void (*)(const Block& block, int width, int height, Four* out);

template <class Samples>
static ReadLights light_reader(int count, bool alpha) {
  if (alpha) return count == 4 ? read_lights<Samples, 4, true> : read_lights<Samples, 2, true>;
  if (count == 1) return read_lights<Samples, 1, false>;
  if (count == 2) return read_lights<Samples, 2, false>;
  return count == 3 ? read_lights<Samples, 3, false> : read_lights<Samples, 4, false>;
}

static ReadLights light_reader_of(Sample sample, int count, bool alpha) {
  switch (sample) {
    case Sample::kUint8:
      return light_reader<Codes<uint8_t>>(count, alpha);
    case Sample::kUint16:
      return light_reader<Codes<uint16_t>>(count, alpha);
    case Sample::kHalf:
      return light_reader<Halves>(count, alpha);
    case Sample::kFloat:
      break;
  }
  return light_reader<Floats>(count, alpha);
}

using ReadNumbers = void (*)(const std::byte* texel, int count, float* out);

static ReadNumbers number_reader_of(Sample sample) {
  switch (sample) {
    case Sample::kUint8:
      return read_numbers<Codes<uint8_t>>;
    case Sample::kUint16:
      return read_numbers<Codes<uint16_t>>;
    case Sample::kHalf:
      return read_numbers<Halves>;
    case Sample::kFloat:
      break;
  }
  return read_numbers<Floats>;
}

// --- layers --------------------------------------------------------------------------------------------------------

struct Resampler::Group {
  ReadLights read_lights;
  ReadNumbers read_numbers;  // of layers that must not be averaged
  size_t layer;
  ptrdiff_t offset;  // bytes, in a texel
  int first;         // channel of the whole
  int count;
  ptrdiff_t size;  // bytes

  Block block(const Source& source, int eye, int x, int y) const {
    const LayerPixels& from = source.picture->eyes[static_cast<size_t>(eye)].layers[layer];
    return {from.first + y * from.row_stride + x * from.pixel_stride + offset, from.pixel_stride, from.row_stride};
  }
};

Resampler::Resampler(const Source& source, bool adds_alpha) : source_(source) {
  const std::vector<LayerPixels>& layers = source.picture->eyes[0].layers;
  for (size_t i = 0; i < layers.size(); i++) {
    const LayerPixels& layer = layers[i];
    const int all = static_cast<int>(layer.channels.size());
    // Alpha belongs to the colours before it.
    const bool alpha = layer.rule == LayerRule::kLight && (all == 2 || all == 4) && layer.channels.back() == "A";
    for (int first = 0; first < all; first += 4) {
      const int count = std::min(all - first, 4);
      const Group group{light_reader_of(layer.sample, count, alpha),
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
}

Resampler::~Resampler() = default;

// Catmull-Rom, for the texels at -1, 0, 1 and 2.
static Four cubic_weights(float t) {
  const Four once{-0.5f, 0.0f, 0.5f, 0.0f}, squared{1.0f, -2.5f, 2.0f, -0.5f}, cubed{-0.5f, 1.5f, -1.5f, 0.5f};
  const Four middle{0.0f, 1.0f, 0.0f, 0.0f};
  return middle + t * (once + t * (squared + t * cubed));
}

struct Position {
  int texel;
  float beyond;  // its middle
};

// A place this near to the middle of a texel is meant to be there: angles and their way back leave that much.
static Position split(float at) {
  const float kTolerance = 1.0f / 256.0f;
  const float from = at - 0.5f;
  const int towards_0 = static_cast<int>(from), whole = towards_0 - (static_cast<float>(towards_0) > from ? 1 : 0);
  const float beyond = from - static_cast<float>(whole);
  if (beyond < kTolerance) return {whole, 0.0f};
  if (beyond > 1.0f - kTolerance) return {whole + 1, 0.0f};
  return {whole, beyond};
}

static void set_weights(float at, const Tent& tent, TexelWeights& to) {
  if (tent.count == 1) {
    const Position position = split(at);
    to.first = position.texel - 1;
    to.count = 4;
    const Four weights = cubic_weights(position.beyond);
    std::memcpy(to.weights, &weights, sizeof weights);
    return;
  }
  Position position = split(at + tent.at(0));
  to.first = position.texel - 1;
  to.count = 0;
  Four sums{};  // of the four weights from to.count on, to which points still add
  for (int i = 0, texel = position.texel; i < tent.count; i++) {
    position = split(at + tent.at(i));
    for (; texel < position.texel; texel++) {
      to.weights[to.count++] = sums[0];
      sums = Four{sums[1], sums[2], sums[3], 0.0f};
    }
    sums += cubic_weights(position.beyond) * tent.weight(i);
  }
  std::memcpy(to.weights + to.count, &sums, sizeof sums);
  to.count += 4;
}

bool texel_filter(const Footprint& footprint, vec2 at, TexelFilter& filter) {
  // Beyond it the ellipse leans so far that columns and rows tell another one.
  const float kMostLean = 0.1f;
  // A filter this wide has fewer texels than there is room for.
  const float kMostRadius = 12.0f;
  // An ellipse within this circle is only interpolated, however it leans.
  const float kSharp = 1.0f + kLeastRadius * kLeastRadius;
  const vec2 dx = footprint.dx, dy = footprint.dy;
  const float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  const bool sharp = xx < kSharp && yy < kSharp && xy * xy < (kSharp - xx) * (kSharp - yy);
  const bool fits = xx + yy < kMostRadius * kMostRadius && xy * xy <= kMostLean * kMostLean * xx * yy;
  if (!sharp && !fits) return false;
  set_weights(at.x, sharp ? Tent() : make_tent(xx - 1.0f), filter.across);
  set_weights(at.y, sharp ? Tent() : make_tent(yy - 1.0f), filter.down);
  return true;
}

// A fisheye's circle has them if it has their corners.
bool Resampler::has_all(const TexelFilter& filter, const Cell& cell) const {
  const int left = filter.across.first, right = left + filter.across.count - 1;
  const int top = filter.down.first, bottom = top + filter.down.count - 1;
  if (left < cell.left || right >= cell.right || top < cell.top || bottom >= cell.bottom) return false;
  if (!is_fisheye(source_.camera.projection.kind)) return true;
  return has_texel(source_, cell, left, top) && has_texel(source_, cell, right, top) &&
         has_texel(source_, cell, left, bottom) && has_texel(source_, cell, right, bottom);
}

void Resampler::add(const Place& place, const Cell& cell, float weight, float* sums) const {
  TexelFilter filter;
  set_weights(place.at.x, Tent(), filter.across);
  set_weights(place.at.y, Tent(), filter.down);
  const int left = filter.across.first, top = filter.down.first;
  const bool inside = has_all(filter, cell);
  Texel around[16];
  for (int i = 0; i < 16 && !inside; i++) {
    around[i] = texel_of(source_, place.eye, cell, left + i % 4, top + i / 4);
  }
  for (const Group& group : mixed_) {
    Four texels[16];
    std::byte gathered[16 * sizeof(Four)];
    const ptrdiff_t size = group.size;
    for (int i = 0; i < 16 && !inside; i++) {
      const Texel& t = around[i];
      std::memcpy(gathered + i * size, group.block(source_, t.eye, t.x, t.y).first, static_cast<size_t>(size));
    }
    const Block block = inside ? group.block(source_, place.eye, left, top) : Block{gathered, size, 4 * size};
    group.read_lights(block, 4, 4, texels);
    const Four value = mix_texels<4>(texels, 4, filter);
    for (int c = 0; c < group.count; c++) sums[group.first + c] += weight * value[c];
  }
}

// The texels of filters as a cell has them, and how many they are if every filter reads its own.
struct Reach {
  Cell box;
  int texels = 0;
};

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

// Neighbours share most of their texels, which are read once for all: of as many pixels as have them in a small box.
void Resampler::fill(int eye, std::span<const TexelFilter> filters, float* out) const {
  const int kMostTexels = 1024;  // of one filter
  const Reach reach = reach_of(filters);
  const int left = reach.box.left, top = reach.box.top, width = reach.box.right - left, height = reach.box.bottom - top;
  if (filters.size() > 1 && width * height > std::min(reach.texels, kMostTexels)) {
    const size_t half = filters.size() / 2;
    fill(eye, filters.first(half), out);
    return fill(eye, filters.subspan(half), out + half * static_cast<size_t>(channels_));
  }
  Four texels[kMostTexels];
  for (const Group& group : mixed_) {
    group.read_lights(group.block(source_, eye, left, top), width, height, texels);
    float* pixel = out + group.first;
    for (const TexelFilter& filter : filters) {
      const Four* first = texels + (filter.down.first - top) * width + (filter.across.first - left);
      const Four value =
          filter.across.count == 4 ? mix_texels<4>(first, width, filter) : mix_texels<0>(first, width, filter);
      for (int c = 0; c < group.count; c++) pixel[c] = value[c];
      pixel += channels_;
    }
  }
}

bool PixelRun::add(const Footprint& footprint, vec2 at, float* pixel) {
  if (waiting_ == std::size(filters_)) fill();
  TexelFilter& filter = filters_[waiting_];
  if (!texel_filter(footprint, at, filter) || !resampler_.has_all(filter, cell_)) {
    fill();
    return false;
  }
  if (waiting_++ == 0) first_ = pixel;
  return true;
}

void PixelRun::fill() {
  if (waiting_ > 0) resampler_.fill(eye_, {filters_, waiting_}, first_);
  waiting_ = 0;
}

void Resampler::finish(const Place& place, float* out) const {
  const Extent size = source_.picture->size;
  const int x = std::clamp(static_cast<int>(place.at.x), 0, size.width - 1);
  const int y = std::clamp(static_cast<int>(place.at.y), 0, size.height - 1);
  for (const Group& group : nearest_) {
    group.read_numbers(group.block(source_, place.eye, x, y).first, group.count, out + group.first);
  }
  if (added_alpha_ >= 0) out[added_alpha_] = 1.0f;
}

}  // namespace ods
