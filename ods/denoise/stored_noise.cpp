// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/stored_noise.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/base/text.h"
#include "ods/convert/convert.h"
#include "ods/convert/reproject.h"
#include "ods/files/scratch.h"
#include "ods/picture/channel_layers.h"

namespace ods {
namespace {

// The channels of one layer, in the requested order.
struct Channels {
  size_t layer = 0;
  std::vector<size_t> from;
};

std::string group_of(const LayerPixels& layer) {
  return small_letters(split_name(layer.channels[0]).first);
}

std::optional<Channels> channels_of(const LayerPixels& layer, size_t number) {
  static const std::string_view kWords[3][6] = {{"r", "red", "x"}, {"g", "green", "y"}, {"b", "blue", "z"}};
  Channels found{number, {}};
  for (const auto& words : kWords) {
    for (size_t c = 0; c < layer.channels.size(); c++) {
      const std::string last = small_letters(split_name(layer.channels[c]).second);
      if (std::find(std::begin(words), std::end(words), last) != std::end(words)) found.from.push_back(c);
    }
  }
  if (found.from.size() == 3) return found;
  if (layer.channels.size() == 1) return Channels{number, {0, 0, 0}};
  return {};
}

std::optional<Channels> find_layer(const StoredPicture& stored, const std::string& wanted) {
  const std::string name = small_letters(wanted);
  const std::vector<LayerPixels>& layers = stored.eyes[0].layers;
  for (const bool whole : {true, false}) {
    for (size_t i = 1; i < layers.size(); i++) {
      const std::string group = group_of(layers[i]);
      const bool is_it = group.empty() ? small_letters(layers[i].channels[0]) == name
                                       : (whole ? group : split_name(group).second) == name;
      if (!is_it) continue;
      if (const auto channels = channels_of(layers[i], i)) return channels;
    }
  }
  return {};
}

std::optional<Channels> find_first(const StoredPicture& stored, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const auto found = find_layer(stored, name)) return found;
  }
  return {};
}

std::string names_of_layers(const StoredPicture& stored) {
  std::string names;
  for (size_t i = 1; i < stored.eyes[0].layers.size(); i++) {
    const LayerPixels& layer = stored.eyes[0].layers[i];
    const std::string group = split_name(layer.channels[0]).first;
    names += (names.empty() ? "" : ", ") + (group.empty() ? layer.channels[0] : group);
  }
  return names.empty() ? "it has no other layers" : "its layers are " + names;
}

Channels named_layer(const StoredPicture& stored, const std::string& name, const std::string& path) {
  if (const auto found = find_layer(stored, name)) return *found;
  throw Error(ErrorKind::kUsage,
              fmt::format("'{}' has no layer '{}' of one or three channels: {}", path, name, names_of_layers(stored)));
}

Image read_layer(const StoredPicture& stored, size_t eye, const Channels& channels) {
  const LayerPixels& layer = stored.eyes[eye].layers[channels.layer];
  const size_t count = channels.from.size(), size = bytes_of(layer.sample);
  Image image(stored.size.width, stored.size.height, static_cast<int>(count));
  tbb::parallel_for(0, stored.size.height, [&](int y) {
    const std::byte* in = layer.first + y * layer.row_stride;
    float* out = image.at(0, y);
    for (int x = 0; x < stored.size.width; x++, in += layer.pixel_stride) {
      for (size_t c = 0; c < count; c++) *out++ = sample_value(layer.sample, in + channels.from[c] * size);
    }
  });
  return image;
}

// From two means of half of the samples: the mean of all is their middle, and its variance is their half difference
// squared.
Image variance_of_halves(const Image& a, const Image& b) {
  Image variance = a;
  for (size_t i = 0; i < variance.pixels.size(); i++) {
    const float half = 0.5f * (a.pixels[i] - b.pixels[i]);
    variance.pixels[i] = half * half;
  }
  return variance;
}

// Names of such pictures in other programs.
constexpr const char* kHalves[][2] = {
    {"halfA", "halfB"}, {"half_a", "half_b"}, {"half1", "half2"}, {"bufferA", "bufferB"}, {"buffer_a", "buffer_b"}};

// The layers and channels of a picture's statistics and features.
struct Found {
  Channels radiance;
  std::optional<Channels> variance, half_a, half_b, samples, depth, normal, albedo;
};

Found find_all(const StoredPicture& stored, const NoiseLayers& layers, const std::string& path) {
  Found found;
  found.radiance = find_layer(stored, "raw").value_or(Channels{0, {0, 1, 2}});
  if (!layers.half_a.empty()) {
    found.half_a = named_layer(stored, layers.half_a, path);
    found.half_b = named_layer(stored, layers.half_b, path);
  } else if (!layers.variance.empty()) {
    found.variance = named_layer(stored, layers.variance, path);
  } else {
    found.variance = find_layer(stored, "variance");
    if (found.variance) found.samples = find_layer(stored, "samples");
    for (const auto& [a, b] : kHalves) {
      if (found.variance || found.half_a) break;
      found.half_a = find_layer(stored, a), found.half_b = find_layer(stored, b);
      if (!found.half_b) found.half_a.reset();
    }
  }
  if (!found.variance && !found.half_a && layers.needed) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' has no noise statistics: render it with `statistics`, or name a layer with "
                            "`variance`, or two with `half-a` and `half-b`; {}",
                            path, names_of_layers(stored)));
  }
  if (found.samples) found.samples->from.resize(1);
  if (const auto layer = depth_layer(stored)) found.depth = Channels{*layer, {0}};
  found.normal = find_first(stored, {"N", "denoising normal", "normal", "normals"});
  found.albedo = find_first(stored, {"albedo", "denoising albedo"});
  return found;
}

int64_t count_unusable(const EyeImage& eye) {
  int64_t count = 0;
  for (size_t i = 0; i < eye.radiance.pixels.size(); i += 3) {
    float sum = 0.0f;
    bool is_unusable = !eye.samples.pixels.empty() && eye.samples.pixels[i / 3] < 2.0f;
    for (size_t c = i; c < i + 3; c++) {
      sum += eye.radiance.pixels[c] + eye.variance.pixels[c];
      is_unusable = is_unusable || eye.variance.pixels[c] < 0.0f;
    }
    if (is_unusable || !std::isfinite(sum)) count++;
  }
  return count;
}

}  // namespace

StoredNoise read_noise(const StoredPicture& stored, const NoiseLayers& layers, const std::string& path) {
  if (!stored.is_float) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is display-encoded and has no noise statistics: use an .exr "
                                               "with statistics (ods render `statistics`)",
                                               path));
  }
  const Found found = find_all(stored, layers, path);
  const size_t pixels = static_cast<size_t>(stored.size.width) * static_cast<size_t>(stored.size.height);
  check_memory(14 * sizeof(float) * pixels * stored.eyes.size(), "the picture",
               "a smaller picture or a single eye needs less");
  StoredNoise noise;
  noise.has_features = found.normal || found.albedo;
  for (size_t i = 0; i < stored.eyes.size(); i++) {
    EyeImage& eye = noise.picture.eyes.emplace_back();
    const auto read = [&](const std::optional<Channels>& channels) {
      return channels ? read_layer(stored, i, *channels) : Image();
    };
    eye.eye = stored.eyes[i].eye;
    eye.radiance = read_layer(stored, i, found.radiance);
    eye.variance = found.half_a ? variance_of_halves(read(found.half_a), read(found.half_b)) : read(found.variance);
    eye.samples = read(found.samples);
    eye.depth = read(found.depth);
    eye.normal = read(found.normal);
    eye.albedo = read(found.albedo);
    if (layers.needed) noise.unusable += count_unusable(eye);
    stored.memory->release();  // not needed again before the result is saved
  }
  if (noise.unusable == static_cast<int64_t>(pixels * stored.eyes.size())) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' has no pixel with usable light and variance (NaN, infinite, negative "
                            "or of one sample): render it with 2 samples or more",
                            path));
  }
  return noise;
}

PictureRows denoised_rows(const StoredPicture& stored, const Picture& denoised) {
  PictureRows rows;
  rows.eye = stored.size;
  for (const StoredEye& eye : stored.eyes) rows.eyes.push_back(eye.eye);
  rows.layers = row_layers(stored);
  const bool adds_raw = !find_layer(stored, "raw");
  if (adds_raw) rows.layers.push_back({{"raw.R", "raw.G", "raw.B"}, LayerRule::kLight, rows.layers[0].sample});
  rows.fill = [&stored, &denoised, adds_raw](int index, int y, std::span<float> row) {
    const std::vector<LayerPixels>& layers = stored.eyes[static_cast<size_t>(index)].layers;
    const float* light = denoised.eyes[static_cast<size_t>(index)].radiance.at(0, y);
    float* out = row.data();
    for (int x = 0; x < stored.size.width; x++, light += 3) {
      float* const pixel = out;
      for (const LayerPixels& layer : layers) {
        const std::byte* in = layer.first + y * layer.row_stride + x * layer.pixel_stride;
        for (size_t c = 0; c < layer.channels.size(); c++)
          *out++ = sample_value(layer.sample, in + c * bytes_of(layer.sample));
      }
      if (adds_raw) out = std::copy_n(pixel, 3, out);
      std::copy_n(light, 3, pixel);
    }
  };
  return rows;
}

}  // namespace ods
