// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/base/text.h"
#include "ods/files/file_input.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/color_tags.h"
#include "ods/image/format/pixel_place.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/image_file.h"
#include "ods/image/orientation.h"
#include "ods/image/small_rows.h"
#include "ods/image/tone.h"

namespace ods {

// --- opening ---------------------------------------------------------------------------------------------------------

PictureBytes picture_on_disk(const std::string& path) {
  const auto file = std::make_shared<const FileInput>(path);
  const auto read = [file](size_t offset, void* to, size_t count) { return file->read(offset, to, count); };
  return {path, true, file->size(), read};
}

PictureBytes picture_in_memory(std::span<const std::byte> bytes, const std::string& name) {
  const auto read = [bytes](size_t offset, void* to, size_t count) {
    if (offset > bytes.size() || count > bytes.size() - offset) return false;
    std::copy_n(bytes.data() + offset, count, static_cast<std::byte*>(to));
    return true;
  };
  return {name, false, bytes.size(), read};
}

void check_picture_size(const PictureBytes& file, int width, int height, int tile) {
  const std::string fault = image_size_fault(width, height, std::max({width, height, tile}), file.size);
  if (!fault.empty()) throw cannot_read(file.name, fault);
}

size_t Decoder::bytes_of_pixel(size_t first, size_t count) const {
  size_t bytes = 0;
  for (size_t c = first; c < first + count; c++) bytes += bytes_of(info.samples[c]);
  return bytes;
}

int Decoder::band_rows() const {
  constexpr int kBand = 64;
  return (kBand + rows_together - 1) / rows_together * rows_together;
}

constexpr std::string_view kVideoExtensions[] = {".mp4", ".mov", ".mkv", ".webm"};  // for a message

static bool is_named_as_video(const std::string& name) {
  const std::string low = small_letters(name);
  return std::any_of(std::begin(kVideoExtensions), std::end(kVideoExtensions),
                     [&](std::string_view extension) { return low.ends_with(extension); });
}

static FileFormat format_of(const PictureBytes& file) {
  std::string start(std::min<size_t>(file.size, 16), '\0');
  if (!file.read(0, start.data(), start.size())) throw cannot_read(file.name, "reading stopped halfway");
  if (const std::optional<FileFormat> format = format_of_bytes(std::as_bytes(std::span(start)))) return *format;
  if (is_named_as_video(file.name)) {
    throw cannot_read(file.name,
                      "it is a video; ods convert VIDEO -o 'x.####.png' makes pictures of it; ods "
                      "probe, lint, inject, view and over take videos, too");
  }
  throw cannot_read(file.name, fmt::format("it is not one of {}{}", readable_extensions(), taken_by(start)));
}

static std::unique_ptr<Decoder> open_decoder(const PictureBytes& file, FileFormat format, int view = 0,
                                             int min_width = 0) {
  switch (format) {
    case FileFormat::kPng:
      return open_png(file);
    case FileFormat::kJpeg:
      return open_jpeg(file, min_width);
    case FileFormat::kTiff:
      return open_tiff(file);
    case FileFormat::kWebp:
      return open_webp(file);
    case FileFormat::kHdr:
      return open_hdr(file);
    case FileFormat::kHeif:
      return open_heif(file, view);
    case FileFormat::kExr:
      break;
  }
  return open_exr(file);
}

std::unique_ptr<Decoder> open_decoder(const PictureBytes& file) {
  return open_decoder(file, format_of(file));
}

namespace {

struct Opened {
  std::unique_ptr<Decoder> decoder;
  ColorSpace color;
};

}  // namespace

// A JPEG whose headers are damaged records nothing; reading the pixels reports the fault.
static StereoJpeg stereo_jpeg(const std::string& path) {
  try {
    return read_stereo_jpeg(FileInput(path));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {};
  }
}

static PictureBytes part_of(const PictureBytes& file, const FileRange& range) {
  const auto read = [whole = file.read, range](size_t offset, void* to, size_t count) {
    const bool is_inside = offset <= range.size && count <= range.size - offset;
    return is_inside && whole(range.offset + offset, to, count);
  };
  return {file.name, false, range.size, read};
}

static Opened open(const std::string& path, int view = 0, int min_width = 0) {
  PictureBytes file = picture_on_disk(path);
  const FileFormat format = format_of(file);
  const StereoJpeg stereo = format == FileFormat::kJpeg ? stereo_jpeg(path) : StereoJpeg();
  if (view == 1 && stereo.right.size > 0) file = part_of(file, stereo.right);
  Opened opened{open_decoder(file, format, view, min_width), {}};
  const int orientation = orientation_of(FileInput(path));
  opened.decoder = turned(std::move(opened.decoder), orientation);
  FileInfo& info = opened.decoder->info;
  read_pixel_place(FileInput(path), format, orientation, info);
  if (format == FileFormat::kJpeg) add_stereo(info, stereo);
  opened.color = read_color_space(path, format, info);
  info.color = opened.color.name;
  info.color_fault = opened.color.fault;
  return opened;
}

// --- whole pictures --------------------------------------------------------------------------------------------------

// Calls take(row, y) with the samples of each row.
template <class Take>
static void each_row(Decoder& decoder, size_t first, size_t count, const Take& take) {
  const int height = decoder.info.height, band = decoder.band_rows();
  const size_t row = decoder.bytes_of_pixel(first, count) * static_cast<size_t>(decoder.info.width);
  std::vector<std::byte> rows(row * static_cast<size_t>(std::min(band, height)));
  for (int begin = 0; begin < height; begin += band) {
    const int end = std::min(begin + band, height);
    decoder.read(begin, end, first, count, rows.data());
    for (int y = begin; y < end; y++) take(&rows[row * static_cast<size_t>(y - begin)], y);
  }
}

// Channels of a file, by their indices and in their order, as floats.
static Image read_floats(Decoder& decoder, const std::vector<size_t>& channels) {
  const auto [minimum, maximum] = std::minmax_element(channels.begin(), channels.end());
  const size_t first = *minimum, count = *maximum - first + 1;
  std::vector<size_t> offsets{0};  // offsets of the channels, from the first on
  for (size_t c = first; c < first + count; c++) offsets.push_back(offsets.back() + bytes_of(decoder.info.samples[c]));
  Image image(decoder.info.width, decoder.info.height, static_cast<int>(channels.size()));
  each_row(decoder, first, count, [&](const std::byte* from, int y) {
    float* to = image.at(0, y);
    for (int x = 0; x < image.width; x++, from += offsets.back()) {
      for (const size_t c : channels) *to++ = sample_value(decoder.info.samples[c], from + offsets[c - first]);
    }
  });
  return image;
}

Image read_image(const std::string& path, std::string* color_fault) {
  const auto [decoder, color] = open(path);
  const bool is_grey = decoder->info.channels.size() < 3, is_float = decoder->info.is_float;
  Image image = read_floats(*decoder, is_grey ? std::vector<size_t>{0, 0, 0} : std::vector<size_t>{0, 1, 2});
  for (size_t i = 0; i < image.pixels.size() && !(is_float && color.has_our_primaries); i += 3) {
    vec3 value(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
    value = is_float ? light_of_floats(color, value) : linear_from_encoded(color, value);
    std::copy_n(&value.x, 3, &image.pixels[i]);
  }
  if (color_fault) *color_fault = color.fault;
  return image;
}

FileInfo read_info(const std::string& path) {
  return open(path).decoder->info;
}

Image read_channels(const std::string& path, const std::vector<std::string>& names) {
  const std::unique_ptr<Decoder> decoder = open(path).decoder;
  const std::vector<std::string>& there = decoder->info.channels;
  std::vector<size_t> channels;
  for (const std::string& name : names) {
    channels.push_back(static_cast<size_t>(std::find(there.begin(), there.end(), name) - there.begin()));
    if (channels.back() == there.size()) throw cannot_read(path, fmt::format("it has no channel '{}'", name));
  }
  Image image = read_floats(*decoder, channels);
  if (!decoder->info.is_float) {
    for (float& value : image.pixels) value = srgb_decode(value);
  }
  return image;
}

// The 8-bit code of any sample.
static uint32_t code_of(SampleType sample, const std::byte* at) {
  if (sample == SampleType::kUint8) return static_cast<uint32_t>(*at);
  return static_cast<uint32_t>(finite(sample_value(sample, at), 0.0f, 1.0f) * 255.0f + 0.5f);
}

CodeImage decode_image(std::span<const std::byte> file, const std::string& name, bool keep_depth) {
  const PictureBytes bytes = picture_in_memory(file, name);
  const std::unique_ptr<Decoder> decoder = open_decoder(bytes);
  const FileInfo& info = decoder->info;
  const size_t count = std::min<size_t>(info.channels.size(), 4);
  const bool grey = count < 3, has_alpha = count == 2 || count == 4;
  const SampleType sample = info.samples[0];
  const size_t size = bytes_of(sample), pixel = count * size;
  const bool is_deep = keep_depth && sample == SampleType::kUint16;
  CodeImage image{info.width, info.height, {}, {}};
  const size_t pixels = static_cast<size_t>(info.width) * static_cast<size_t>(info.height);
  is_deep ? image.deep.reserve(3 * pixels) : image.pixels.reserve(pixels);
  each_row(*decoder, 0, count, [&](const std::byte* from, int) {
    for (int x = 0; x < info.width; x++, from += pixel) {
      const std::byte* const at[] = {from, grey ? from : from + size, grey ? from : from + 2 * size};
      if (is_deep) {
        for (const std::byte* each : at) std::memcpy(&image.deep.emplace_back(), each, sizeof(uint16_t));
        continue;
      }
      const uint32_t alpha = has_alpha ? code_of(sample, from + (count - 1) * size) : 255u;
      image.pixels.push_back(code_of(sample, at[0]) | code_of(sample, at[1]) << 8 | code_of(sample, at[2]) << 16 |
                             alpha << 24);
    }
  });
  return image;
}

// --- reading by rows -----------------------------------------------------------------------------------------------

namespace {

class FileRows final : public RowReader {
 public:
  FileRows(const std::string& path, int view, int min_width = 0);
  const FileInfo& info() const override { return info_; }
  const ColorSpace& color_space() const override { return color_; }
  void widen() override;
  bool is_whole_number(size_t channel) const override {
    return channel < decoder_->whole_numbers.size() && decoder_->whole_numbers[channel];
  }
  int band_rows() const override { return decoder_->band_rows(); }
  void read(int begin, int end, size_t channels, std::byte* to) override;
  const std::map<size_t, unsigned>& beyond_floats() const override { return decoder_->beyond_floats; }

 private:
  std::unique_ptr<Decoder> decoder_;
  ColorSpace color_;
  FileInfo info_;                         // its samples have the types that read() returns
  std::optional<SrgbConverter> to_srgb_;  // for integers of another colour space
  std::vector<std::byte> narrow_;         // 8-bit integers that become 16-bit ones
};

FileRows::FileRows(const std::string& path, int view, int min_width) {
  Opened opened = open(path, view, min_width);
  decoder_ = std::move(opened.decoder);
  color_ = opened.color;
  info_ = decoder_->info;
  if (!info_.is_float && !is_our_own(color_, false)) {
    to_srgb_.emplace(color_);
    widen();
  }
}

void FileRows::widen() {
  if (!info_.is_float) std::fill(info_.samples.begin(), info_.samples.end(), SampleType::kUint16);
}

void FileRows::read(int begin, int end, size_t channels, std::byte* to) {
  if (info_.samples[0] == decoder_->info.samples[0]) {
    decoder_->read(begin, end, 0, channels, to);
  } else {
    narrow_.resize(static_cast<size_t>(end - begin) * static_cast<size_t>(info_.width) * channels);
    decoder_->read(begin, end, 0, channels, narrow_.data());
    for (const std::byte code : narrow_) {
      *to++ = code, *to++ = code;  // 257 times as much
    }
    to -= 2 * narrow_.size();
  }
  const size_t samples = static_cast<size_t>(end - begin) * static_cast<size_t>(info_.width) * channels;
  if (to_srgb_) to_srgb_->convert({reinterpret_cast<uint16_t*>(to), samples}, channels);
}

}  // namespace

std::unique_ptr<RowReader> open_rows(const std::string& path, int view) {
  return std::make_unique<FileRows>(path, view);
}

std::unique_ptr<RowReader> open_small_rows(const std::string& path, int min_width) {
  return std::make_unique<FileRows>(path, 0, min_width);
}

}  // namespace ods
