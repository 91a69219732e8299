// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/codec/tiff_samples.h"

#include <cstring>
#include <limits>

namespace ods {

std::optional<SampleType> tiff_sample(TiffNumber number, int bits) {
  if (number == TiffNumber::kFloat) {
    if (bits == 16) return SampleType::kHalf;
    return bits == 32 || bits == 64 ? std::optional(SampleType::kFloat) : std::nullopt;
  }
  const bool is_whole = bits == 8 || bits == 16 || bits == 24 || bits == 32;
  if (number == TiffNumber::kSigned) return is_whole ? std::optional(SampleType::kUint16) : std::nullopt;
  if (bits >= 1 && bits <= 8) return SampleType::kUint8;
  return bits <= 16 || is_whole ? std::optional(SampleType::kUint16) : std::nullopt;
}

bool TiffSamples::needs_whole_pixels() const {
  return is_ink || zero_is_white || !palette.empty() || (alpha && is_associated != is_float());
}

// --- numbers ---------------------------------------------------------------------------------------------------------

namespace {

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <class T>
void store(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

// Bits [at, at + count), most significant bit first.
uint64_t bits_at(const std::byte* bytes, size_t at, size_t count) {
  uint64_t value = 0;
  for (size_t i = at; i < at + count; i++) {
    value = value << 1 | (static_cast<unsigned>(bytes[i / 8]) >> (7 - i % 8) & 1u);
  }
  return value;
}

// A number with whole bytes in this machine's byte order, as converted by libtiff.
uint64_t number_at(const std::byte* bytes, size_t i, int bits) {
  switch (bits) {
    case 8:
      return static_cast<uint64_t>(bytes[i]);
    case 16:
      return load<uint16_t>(bytes + 2 * i);
    case 24:
      return static_cast<uint64_t>(bytes[3 * i]) | static_cast<uint64_t>(bytes[3 * i + 1]) << 8 |
             static_cast<uint64_t>(bytes[3 * i + 2]) << 16;
    case 32:
      return load<uint32_t>(bytes + 4 * i);
    default:
      return bits_at(bytes, i * static_cast<size_t>(bits), static_cast<size_t>(bits));
  }
}

// Converts integers to codes of their sample type; indices into a palette are not changed.
void put_codes(const TiffSamples& samples, const std::byte* from, size_t count, std::byte* to, size_t stride) {
  const bool is_signed = samples.number == TiffNumber::kSigned, is_index = !samples.palette.empty();
  const uint64_t range = uint64_t{1} << (samples.bits - (is_signed ? 1 : 0)), maximum = range - 1;
  const uint64_t codes = samples.sample == SampleType::kUint8 ? 0xff : 0xffff;
  const uint64_t rounding = samples.bits > 16 || is_signed ? maximum / 2 : 0;
  for (size_t i = 0; i < count; i++, to += stride) {
    const uint64_t number = number_at(from, i, samples.bits), value = is_signed && number >= range ? 0 : number;
    const uint64_t code = is_index ? value : (value * codes + rounding) / maximum;
    samples.sample == SampleType::kUint8 ? store(to, static_cast<uint8_t>(code))
                                         : store(to, static_cast<uint16_t>(code));
  }
}

// Returns whether the file's numbers already are samples.
bool is_sample(const TiffSamples& samples) {
  const bool is_double = samples.number == TiffNumber::kFloat && samples.bits == 64;
  return samples.number != TiffNumber::kSigned && !is_double &&
         samples.bits == 8 * static_cast<int>(bytes_of(samples.sample));
}

// Converts `count` numbers of the file to samples, `stride` bytes apart.
void put_samples(const TiffSamples& samples, const std::byte* from, size_t count, std::byte* to, size_t stride) {
  const size_t size = bytes_of(samples.sample);
  if (is_sample(samples)) {
    for (size_t i = 0; i < count; i++, from += size, to += stride) std::memcpy(to, from, size);
  } else if (samples.number == TiffNumber::kFloat) {
    for (size_t i = 0; i < count; i++, to += stride)
      store(to, static_cast<float>(load<double>(from + i * sizeof(double))));
  } else {
    put_codes(samples, from, count, to, stride);
  }
}

// --- colours ---------------------------------------------------------------------------------------------------------

// The light that two inks let through.
template <class T>
T through(T ink, T black) {
  constexpr uint64_t kMax = std::numeric_limits<T>::max();
  return static_cast<T>(((kMax - ink) * (kMax - black) + kMax / 2) / kMax);
}

template <class T>
void put_light(const std::byte* inks, std::byte* to) {
  for (size_t c = 0; c < 3; c++)
    store(to + c * sizeof(T), through(load<T>(inks + c * sizeof(T)), load<T>(inks + 3 * sizeof(T))));
}

void multiply(const TiffSamples& samples, std::byte* pixel) {
  const size_t size = bytes_of(samples.sample);
  const float alpha = sample_value(samples.sample, pixel + *samples.alpha * size);
  for (size_t c = 0; c < samples.channels.size(); c++) {
    std::byte* const at = pixel + c * size;
    if (c == *samples.alpha) continue;
    const float value = sample_value(samples.sample, at) * alpha;
    if (samples.sample == SampleType::kFloat) {
      store(at, value);
    } else {
      uint16_t half = 0;
      floats_to_halves({&value, 1}, &half);
      store(at, half);
    }
  }
}

// Converts colours and alpha of whole pixels to the format of Decoder::read().
void make_colors(const TiffSamples& samples, const std::byte* from, std::span<std::byte> to) {
  const size_t size = bytes_of(samples.sample), pixel = samples.channels.size() * size;
  for (size_t at = 0; at < to.size(); at += pixel, from += samples.inputs * size) {
    if (!samples.palette.empty()) {
      std::memcpy(&to[at], samples.palette[static_cast<size_t>(*from)].data(), 3);
    } else if (samples.is_ink) {
      size == 1 ? put_light<uint8_t>(from, &to[at]) : put_light<uint16_t>(from, &to[at]);
      std::memcpy(&to[at] + 3 * size, from + 4 * size, pixel - 3 * size);
    } else {
      std::memcpy(&to[at], from, pixel);
    }
    for (size_t i = 0; samples.zero_is_white && i < size; i++) to[at + i] = ~to[at + i];
    if (samples.alpha && !samples.is_associated && samples.is_float()) multiply(samples, &to[at]);
  }
  if (samples.alpha && samples.is_associated && !samples.is_float()) {
    divide_by_alpha(samples.sample, to, samples.channels.size(), *samples.alpha, 1.0f);
  }
}

}  // namespace

TiffRows::TiffRows(const TiffSamples& samples, size_t first, size_t count)
    : samples_(samples), first_(first), count_(count) {
  if (!samples.is_separate) return;
  const bool needs_all = samples.needs_whole_pixels();
  first_plane_ = needs_all ? 0 : first;
  planes_ = needs_all ? samples.inputs : count;
}

void TiffRows::convert(std::span<const std::byte* const> planes, size_t width, std::byte* to) {
  const size_t size = bytes_of(samples_.sample), stored = samples_.is_separate ? planes_ : samples_.inputs;
  const std::byte* pixels = planes[0];
  if (samples_.is_separate || !is_sample(samples_)) {
    numbers_.resize(width * stored * size);
    const size_t numbers = samples_.is_separate ? width : width * stored;
    const size_t stride = samples_.is_separate ? stored * size : size;
    for (size_t p = 0; p < planes.size(); p++) put_samples(samples_, planes[p], numbers, &numbers_[p * size], stride);
    pixels = numbers_.data();
  }
  size_t pixel = stored * size;
  const std::byte* from = pixels + (first_ - first_plane_) * size;
  if (samples_.needs_whole_pixels()) {
    pixel = samples_.channels.size() * size;
    colors_.resize(width * pixel);
    make_colors(samples_, pixels, colors_);
    from = colors_.data() + first_ * size;
  }
  if (pixel == count_ * size) return void(std::memcpy(to, from, width * pixel));
  for (size_t x = 0; x < width; x++, from += pixel, to += count_ * size) std::memcpy(to, from, count_ * size);
}

}  // namespace ods
