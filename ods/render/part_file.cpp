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

#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/base/memory.h"
#include "ods/files/file_input.h"
#include "ods/image/format/exr_header.h"
#include "ods/picture/channel_layers.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "ods/render/render_target.h"

namespace ods {
namespace {

constexpr const char* kPart = "ods:part";
constexpr const char* kSamples = "ods:samples";
constexpr const char* kExposure = "ods:exposure";
constexpr const char* kTone = "ods:tone";
constexpr const char* kSettings = "ods:settings";
constexpr const char* kSidecar = "ods:sidecar";

// The CRC-32 of a row's other numbers of this eye, the same in each pixel: a flipped bit can pass zlib's Adler-32.
constexpr const char* kCheck = "check";

// A number's bits as whole numbers that floats represent exactly.
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
      if (words[i] >= 0.0f && words[i] < 1u << kBits)
        bits |= static_cast<Bits>(static_cast<int32_t>(words[i])) << (i * kBits);
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
  layers.push_back({channels_of(kCheck, 1, Words<uint32_t>::kCount), LayerRule::kNearest, SampleType::kFloat});
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
    to += Words<uint32_t>::kCount;
  }
  const size_t channels = row.size() / width, end = channels - Words<uint32_t>::kCount;
  uint32_t crc = 0;
  for (size_t x = 0; x < width; x++) crc = crc32(std::as_bytes(row.subspan(x * channels + 3, end - 3)), crc);
  for (size_t x = 0; x < width; x++) Words<uint32_t>::split(crc, &row[x * channels + end]);
}

// The layer of an eye that contains a plane; nullptr if there is none.
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
void add_number(bool is_depth, Number number, Number& sum) {
  if (is_depth) {
    sum = number;
  } else if constexpr (std::is_integral_v<Number>) {
    if (__builtin_add_overflow(sum, number, &sum)) sum = 0;  // the file was not written by this program
  } else {
    sum += number;
  }
}

// Adds one number of each pixel; they are `stride` bytes apart, and `numbers` apart in the sums.
template <typename Number>
void add_numbers(bool is_depth, const std::byte* from, const size_t* offsets, size_t stride, size_t pixels, Number* sum,
                 size_t numbers) {
  for (size_t i = 0; i < pixels; i++, from += stride, sum += numbers) {
    std::array<float, Words<Number>::kCount> words;
    for (size_t w = 0; w < words.size(); w++) std::memcpy(&words[w], from + offsets[w], sizeof(float));
    add_number(is_depth, Words<Number>::join(words.data()), *sum);
  }
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
  options.attributes = {
      {kPart, part_text(picture.options.part)},         {kSamples, picture.options.samples},
      {kExposure, fmt::format("{}", picture.exposure)}, {kTone, std::string(tone_curve_name(picture.tone))},
      {kSettings, settings_text(picture.settings)},     {kSidecar, picture.camera}};
  options.rows_alone = true;    // rows are so long that combining several saves nothing
  options.has_checksum = true;  // a checksum of the header
  return save_picture(rows, &camera, options, path).front();
}

// A header with a flipped bit could mean other sums, or fewer.
static void check_header(const std::string& path, const FileInfo& info) {
  const auto stored = info.text.find(kExrChecksum);
  if (stored == info.text.end()) {
    fail(path,
         "has no checksum of its header, as parts of older versions: merge it with its own version of ods, or "
         "render it again");
  }
  if (stored->second != exr_checksum(read_exr_header(FileInput(path)))) {
    fail(path, "is damaged: its header is not as it was written; render the part again");
  }
}

SampledPicture read_part_header(const std::string& path) {
  const FileInfo info = read_info(path);
  const auto text = [&](const char* name) {
    const auto found = info.text.find(name);
    return found == info.text.end() ? "" : found->second;
  };
  const auto samples = info.numbers.find(kSamples);
  SampledPicture picture;
  const std::optional<Settings> settings = parse_settings(text(kSettings));
  picture.settings = settings.value_or(Settings());
  picture.camera = text(kSidecar);
  const float exposure = std::strtof(text(kExposure).c_str(), nullptr);
  if (std::isfinite(exposure)) picture.exposure = exposure;
  picture.tone = find_in(kToneCurveTable, text(kTone)).value_or(picture.tone);
  RenderOptions& options = picture.options;
  const std::optional<Part> part = parse_part(text(kPart));
  options.samples = samples == info.numbers.end() ? 0 : static_cast<int>(samples->second.front());
  if (!part || options.samples < 1 || options.samples > kMaxSamples || picture.camera.empty()) {
    fail(path, "is not a part of a picture: ods render `part` makes those");
  }
  check_header(path, info);
  if (!settings) fail(path, "is damaged: its settings are not as they were written; render the part again");
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

// --- reading --------------------------------------------------------------------------------------------------------

namespace {

// The byte offsets of an eye's numbers in a pixel of a part, in the order of each_plane() and channels_of().
struct EyeOffsets {
  std::vector<size_t> sums;     // numbers of the requested planes
  std::vector<size_t> checked;  // numbers of all planes with a CRC in the row
  std::array<size_t, Words<uint32_t>::kCount> check{};
};

}  // namespace

struct PartsReader::File {
  std::string path;
  std::unique_ptr<RowReader> rows;
  size_t stride = 0;  // bytes per pixel
  std::vector<EyeOffsets> eyes;
};

PartsReader::File PartsReader::open(const std::string& path) const {
  File file{path, open_rows(path), 0, {}};
  const FileInfo& info = file.rows->info();
  if (info.width != options_.width || info.height != options_.height) {
    fail(path, fmt::format("is not {}x{} pixels large", options_.width, options_.height));
  }
  std::vector<size_t> starts;  // start of a pixel's channels
  for (const SampleType sample : info.samples) starts.push_back(file.stride), file.stride += bytes_of(sample);
  RenderOptions one = options_;
  one.width = one.height = 1;
  const PictureSamples pixel = no_samples(one);
  for (const EyeSamples& eye : pixel.eyes) {
    const bool alone = pixel.eyes.size() == 1;
    const ViewChannels channels = channels_of_view(info, alone ? "" : std::string(eye_name(eye.eye)), alone);
    const auto has = [&](const std::string& channel) { return channels.contains(channel); };
    const auto offset = [&](const std::string& channel) {
      if (!has(channel) || info.samples[channels.at(channel)] != SampleType::kFloat) {
        fail(path, fmt::format("lacks {} of eye '{}': render the part again", channel, eye_name(eye.eye)));
      }
      return starts[channels.at(channel)];
    };
    EyeOffsets& offsets = file.eyes.emplace_back();
    each_plane(eye, [&]<typename Number>(const char* name, const std::vector<Number>& plane) {
      for (const std::string& channel : channels_of(name, plane.size(), Words<Number>::kCount))
        offsets.sums.push_back(offset(channel));
      for (const size_t numbers : {size_t{1}, size_t{3}}) {
        for (const std::string& channel : channels_of(name, numbers, Words<Number>::kCount))
          if (has(channel)) offsets.checked.push_back(offset(channel));
      }
    });
    std::ranges::transform(channels_of(kCheck, 1, offsets.check.size()), offsets.check.begin(), offset);
  }
  return file;
}

PartsReader::PartsReader(std::vector<std::string> paths, const RenderOptions& options)
    : paths_(std::move(paths)), options_(options) {
  constexpr size_t kMaxOpen = 200;  // out of the 1024 files that a process may have open
  for (const std::string& path : paths_) {
    File file = open(path);
    if (open_.size() < kMaxOpen) open_.push_back(std::move(file));
  }
}

PartsReader::~PartsReader() = default;

// Adds consecutive pixels, the first of which is `first` and starts at `bytes`.
static void add_pixels(const std::byte* bytes, size_t stride, const size_t* offsets, size_t first, size_t pixels,
                       size_t all, EyeSamples& eye) {
  each_plane(eye, [&]<typename Number>(const char* name, std::vector<Number>& plane) {
    const size_t numbers = plane.size() / all;
    const bool is_depth = std::strcmp(name, "depth") == 0;
    for (size_t n = 0; n < numbers; n++, offsets += Words<Number>::kCount) {
      add_numbers(is_depth, bytes, offsets, stride, pixels, &plane[numbers * first + n], numbers);
    }
  });
}

// Returns whether a row is undamaged.
static bool is_whole(const std::byte* row, size_t stride, size_t width, const EyeOffsets& eye) {
  std::vector<float> words(eye.checked.size());
  uint32_t crc = 0;
  for (size_t x = 0; x < width; x++) {
    for (size_t i = 0; i < words.size(); i++) std::memcpy(&words[i], row + x * stride + eye.checked[i], sizeof(float));
    crc = crc32(std::as_bytes(std::span(words)), crc);
  }
  std::array<float, Words<uint32_t>::kCount> check;
  for (size_t i = 0; i < check.size(); i++) std::memcpy(&check[i], row + eye.check[i], sizeof(float));
  return Words<uint32_t>::join(check.data()) == crc;
}

void PartsReader::add(const File& file, int begin, PictureSamples& band) {
  const size_t width = static_cast<size_t>(band.width), all = width * static_cast<size_t>(band.height);
  if (bytes_.size() < all * file.stride) bytes_.resize(all * file.stride);
  file.rows->read(begin, begin + band.height, file.rows->info().channels.size(), bytes_.data());
  tbb::parallel_for(0, band.height, [&](int y) {
    const std::byte* const row = &bytes_[static_cast<size_t>(y) * width * file.stride];
    for (const EyeOffsets& eye : file.eyes) {
      if (!is_whole(row, file.stride, width, eye)) {
        fail(file.path, fmt::format("is damaged: row {} is not as it was written; render the part again", begin + y));
      }
    }
  });
  constexpr size_t kTogether = 64;  // pixels whose bytes stay in the processor's cache
  tbb::parallel_for(size_t{0}, (all + kTogether - 1) / kTogether, [&](size_t piece) {
    const size_t first = piece * kTogether, pixels = std::min(kTogether, all - first);
    for (size_t i = 0; i < band.eyes.size(); i++) {
      add_pixels(&bytes_[first * file.stride], file.stride, file.eyes[i].sums.data(), first, pixels, all, band.eyes[i]);
    }
  });
}

PictureSamples PartsReader::sum(int begin, int end) {
  RenderOptions options = options_;
  options.height = end - begin;
  PictureSamples band = no_samples(options);
  for (const File& file : open_) add(file, begin, band);
  for (size_t i = open_.size(); i < paths_.size(); i++) add(open(paths_[i]), begin, band);
  return band;
}

// --- merging --------------------------------------------------------------------------------------------------------

static constexpr Image EyeImage::*kImages[] = {&EyeImage::radiance, &EyeImage::depth, &EyeImage::normal,
                                               &EyeImage::albedo,   &EyeImage::alpha, &EyeImage::variance,
                                               &EyeImage::samples};

Picture merge_parts(const std::vector<std::string>& paths, const RenderOptions& options, const Progress& progress) {
  constexpr int kBand = 16;  // rows: the number of threads that read them
  const size_t of_eye = picture_bytes(options) - samples_bytes(options);
  check_memory(eye_list(options.eyes).size() * of_eye, fmt::format("a picture {} pixels wide", options.width),
               "merge it where there is more");
  PartsReader parts(paths, options);
  Picture picture;
  for (const int eye : eye_list(options.eyes)) picture.eyes.push_back(blank_eye(options, eye));
  for (int begin = 0; begin < options.height; begin += kBand) {
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "merging was stopped");
    if (progress.report) progress.report(static_cast<double>(begin) / options.height);
    const int end = std::min(begin + kBand, options.height);
    RenderOptions of_band = options;
    of_band.height = end - begin;
    const Picture band = develop(parts.sum(begin, end), of_band);
    picture.samples_taken += band.samples_taken;
    for (size_t i = 0; i < band.eyes.size(); i++) {
      for (Image EyeImage::*image : kImages) {
        const Image& from = band.eyes[i].*image;
        if (!from.pixels.empty()) std::ranges::copy(from.pixels, (picture.eyes[i].*image).at(0, begin));
      }
    }
  }
  return picture;
}

}  // namespace ods
