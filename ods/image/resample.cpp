// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/resample.h"

#include <algorithm>
#include <bit>
#include <cassert>
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

struct Tent {
  int count = 1;
  float offset = 0.0f;  // of the first point
  float step = 0.0f;
  float share = 1.0f;  // of a point's weight
  float radius = 0.0f;

  float at(int i) const { return offset + step * static_cast<float>(i); }
  float weight(int i) const {
    const float t = (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count) - 1.0f;
    return (1.0f - std::abs(t)) * share;
  }
};

// Points whose variance is the tent's own, radius^2 / 6.
static Tent make_tent(float variance_of_6) {
  Tent tent;
  if (variance_of_6 < kLeastRadius * kLeastRadius) return tent;
  const float radius = std::sqrt(variance_of_6);
  tent.count = std::min(1 + static_cast<int>(std::ceil(2.0f * radius)), kMostPoints);
  float sum = 0.0f, squares = 0.0f;
  for (int i = 0; i < tent.count; i++) {
    const float t = (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(tent.count) - 1.0f;
    sum += 1.0f - std::abs(t);
    squares += (1.0f - std::abs(t)) * t * t;
  }
  const float scale = radius * std::sqrt(sum / (6.0f * squares));
  tent.share = 1.0f / sum;
  tent.step = 2.0f * scale / static_cast<float>(tent.count);
  tent.offset = 0.5f * tent.step - scale;
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

// What is between texels is not beyond them: the cubic's overshoot is cut.
template <class Samples, int kCount, bool kAlpha, class Block>
static void add_texels(const Block& block, const TexelFilter& filter, float weight, float* sums) {
  const float* table = Samples::table();
  Four low = read_light<Samples, kCount, kAlpha>(table, block.first), high = low, sum{};
  const std::byte* start = block.first;
  for (int y = 0; y < filter.down.count; y++, start += block.row_stride) {
    Four row{};
    const std::byte* texel = start;
    for (int x = 0; x < filter.across.count; x++, texel += block.pixel_stride) {
      const Four value = read_light<Samples, kCount, kAlpha>(table, texel);
      row += value * filter.across.weights[x];
      low = value < low ? value : low;
      high = value > high ? value : high;
    }
    sum += row * filter.down.weights[y];
  }
  sum = sum > low ? sum : low;  // NaN too, of numbers near the largest
  sum = sum < high ? sum : high;
  for (int c = 0; c < kCount; c++) sums[c] += weight * sum[c];
}

template <class Samples>
static void read_numbers(const std::byte* texel, int count, float* out) {
  for (int c = 0; c < count; c++) out[c] = Samples::number(sample_at<Samples>(texel, c));
}

template <class Block>
using AddTexels = void (*)(const Block&, const TexelFilter&, float, float*);

template <class Samples, class Block>
static AddTexels<Block> adder(int count, bool alpha) {
  if (alpha) return count == 4 ? add_texels<Samples, 4, true, Block> : add_texels<Samples, 2, true, Block>;
  if (count == 1) return add_texels<Samples, 1, false, Block>;
  if (count == 2) return add_texels<Samples, 2, false, Block>;
  return count == 3 ? add_texels<Samples, 3, false, Block> : add_texels<Samples, 4, false, Block>;
}

template <class Block>
static AddTexels<Block> adder_of(Sample sample, int count, bool alpha) {
  switch (sample) {
    case Sample::kUint8:
      return adder<Codes<uint8_t>, Block>(count, alpha);
    case Sample::kUint16:
      return adder<Codes<uint16_t>, Block>(count, alpha);
    case Sample::kHalf:
      return adder<Halves, Block>(count, alpha);
    case Sample::kFloat:
      break;
  }
  return adder<Floats, Block>(count, alpha);
}

static void (*reader_of(Sample sample))(const std::byte*, int, float*) {
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

Resampler::Resampler(const Source& source, bool adds_alpha) : source_(source) {
  const std::vector<LayerPixels>& layers = source.picture->eyes[0].layers;
  for (size_t i = 0; i < layers.size(); i++) {
    const LayerPixels& layer = layers[i];
    const int all = static_cast<int>(layer.channels.size());
    // Alpha belongs to the colours before it.
    const bool alpha = layer.rule == LayerRule::kLight && (all == 2 || all == 4) && layer.channels.back() == "A";
    for (int first = 0; first < all; first += 4) {
      const int count = std::min(all - first, 4);
      const Group group{adder_of<Block>(layer.sample, count, alpha),
                        reader_of(layer.sample),
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

static const std::byte* address(const LayerPixels& layer, int x, int y) {
  return layer.first + y * layer.row_stride + x * layer.pixel_stride;
}

// Catmull-Rom, for the texels at -1, 0, 1 and 2.
static void cubic_weights(float t, float* w) {
  w[0] = t * (-0.5f + t * (1.0f - 0.5f * t));
  w[1] = 1.0f + t * t * (-2.5f + 1.5f * t);
  w[2] = t * (0.5f + t * (2.0f - 1.5f * t));
  w[3] = t * t * (-0.5f + 0.5f * t);
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

// Whether a filter's texels are all of a cell's. A fisheye's circle has them if it has their corners.
static bool has_all(const Source& source, const Cell& cell, const TexelFilter& filter) {
  const int left = filter.across.first, right = left + filter.across.count - 1;
  const int top = filter.down.first, bottom = top + filter.down.count - 1;
  if (left < cell.left || right >= cell.right || top < cell.top || bottom >= cell.bottom) return false;
  if (!is_fisheye(source.camera.projection.kind)) return true;
  return has_texel(source, cell, left, top) && has_texel(source, cell, right, top) &&
         has_texel(source, cell, left, bottom) && has_texel(source, cell, right, bottom);
}

Resampler::Block Resampler::block_at(const Group& group, int eye, const TexelFilter& filter) const {
  const LayerPixels& layer = source_.picture->eyes[static_cast<size_t>(eye)].layers[group.layer];
  return {address(layer, filter.across.first, filter.down.first) + group.offset, layer.pixel_stride, layer.row_stride};
}

static void set_weights(float at, const Tent& tent, TexelWeights& to) {
  if (tent.count == 1) {
    const Position position = split(at);
    to.first = position.texel - 1;
    to.count = 4;
    cubic_weights(position.beyond, to.weights);
    return;
  }
  to.first = split(at + tent.at(0)).texel - 1;
  to.count = split(at + tent.at(tent.count - 1)).texel + 2 - to.first + 1;
  std::fill_n(to.weights, to.count, 0.0f);
  for (int i = 0; i < tent.count; i++) {
    const Position position = split(at + tent.at(i));
    float cubic[4];
    cubic_weights(position.beyond, cubic);
    float* weights = to.weights + (position.texel - 1 - to.first);
    for (int k = 0; k < 4; k++) weights[k] += cubic[k] * tent.weight(i);
  }
}

bool texel_filter(const Footprint& footprint, vec2 at, TexelFilter& filter) {
  // Beyond it the ellipse leans so far that columns and rows tell another one.
  const float kMostLean = 0.1f;
  // A filter this wide has fewer texels than there is room for.
  const float kMostRadius = 12.0f;
  const vec2 dx = footprint.dx, dy = footprint.dy;
  const float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  const bool fits = xx + yy < kMostRadius * kMostRadius && xy * xy <= kMostLean * kMostLean * xx * yy;
  if (!fits) return false;
  set_weights(at.x, make_tent(xx - 1.0f), filter.across);
  set_weights(at.y, make_tent(yy - 1.0f), filter.down);
  return true;
}

void Resampler::add(const Place& place, const Cell& cell, float weight, float* sums) const {
  TexelFilter filter;
  set_weights(place.at.x, Tent(), filter.across);
  set_weights(place.at.y, Tent(), filter.down);
  const int left = filter.across.first, top = filter.down.first;
  const bool inside = has_all(source_, cell, filter);
  Texel around[16];
  for (int i = 0; i < 16 && !inside; i++) {
    around[i] = texel_of(source_, place.eye, cell, left + i % 4, top + i / 4);
  }
  for (const Group& group : mixed_) {
    if (inside) {
      group.add(block_at(group, place.eye, filter), filter, weight, sums + group.first);
      continue;
    }
    std::byte gathered[16 * 4 * sizeof(float)];
    const ptrdiff_t size = group.size;
    for (int i = 0; i < 16; i++) {
      const Texel& t = around[i];
      const LayerPixels& layer = source_.picture->eyes[static_cast<size_t>(t.eye)].layers[group.layer];
      std::memcpy(gathered + i * size, address(layer, t.x, t.y) + group.offset, static_cast<size_t>(size));
    }
    group.add({gathered, size, 4 * size}, filter, weight, sums + group.first);
  }
}

bool Resampler::add(int eye, const TexelFilter& filter, const Cell& cell, float* sums) const {
  if (!has_all(source_, cell, filter)) return false;
  for (const Group& group : mixed_) group.add(block_at(group, eye, filter), filter, 1.0f, sums + group.first);
  return true;
}

void Resampler::finish(const Place& place, float* out) const {
  const Extent size = source_.picture->size;
  const int x = std::clamp(static_cast<int>(place.at.x), 0, size.width - 1);
  const int y = std::clamp(static_cast<int>(place.at.y), 0, size.height - 1);
  for (const Group& group : nearest_) {
    const LayerPixels& layer = source_.picture->eyes[static_cast<size_t>(place.eye)].layers[group.layer];
    group.read(address(layer, x, y) + group.offset, group.count, out + group.first);
  }
  if (added_alpha_ >= 0) out[added_alpha_] = 1.0f;
}

}  // namespace ods
