// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/depth_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "ods/base/error.h"
#include "ods/depth/npy.h"
#include "ods/files/file_input.h"
#include "ods/files/read_file.h"
#include "ods/image/codec/decoder.h"
#include "ods/image/format/image_limits.h"

namespace ods {

namespace {

// --- PFM -------------------------------------------------------------------------------------------------------------

// The next token of the header, which ends at a single blank.
std::string next_word(const std::string& head, size_t& at) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
  at = std::min(at, head.size());  // the previous token was the last
  while (at < head.size() && is_blank(head[at])) at++;
  const size_t start = at;
  while (at < head.size() && !is_blank(head[at])) at++;
  return head.substr(start, at++ - start);
}

Image read_pfm(const FileInput& file) {
  const std::string head = file.read(0, std::min<uint64_t>(file.size(), 200));
  size_t at = 2;
  const std::string words[] = {next_word(head, at), next_word(head, at), next_word(head, at)};
  const int channels = head[1] == 'F' ? 3 : 1;
  const int width = std::atoi(words[0].c_str()), height = std::atoi(words[1].c_str());
  const double scale = std::atof(words[2].c_str());
  const std::string fault = image_size_fault(width, height, std::max(width, height), file.size());
  if (!fault.empty()) throw cannot_read(file.path(), fault);
  if (scale == 0.0 || at > head.size()) throw cannot_read(file.path(), "its PFM header is damaged");
  Image image(width, height, 1);
  const size_t row = static_cast<size_t>(width * channels) * sizeof(float);
  for (int y = height - 1; y >= 0; y--, at += row) {  // from the bottom up
    const std::string bytes = file.read(at, row);
    for (int x = 0; x < width; x++) {
      uint32_t bits;
      std::memcpy(&bits, bytes.data() + static_cast<size_t>(x * channels) * sizeof bits, sizeof bits);
      *image.at(x, y) = std::bit_cast<float>(scale < 0.0 ? bits : __builtin_bswap32(bits));
    }
  }
  return image;
}

// --- pictures --------------------------------------------------------------------------------------------------------

// The index of the depth channel, or of the first one.
size_t depth_channel(const std::vector<std::string>& channels) {
  for (const std::string_view end : {"Z", "Depth.Z", "depth.Z", ".Z", ".V", "Y"}) {
    for (size_t i = 0; i < channels.size(); i++) {
      if (channels[i] == end || (end.size() > 1 && channels[i].ends_with(end))) return i;
    }
  }
  return 0;
}

// The number of pixels of a row with different red, green and blue, which represent depths by an unknown colour scale.
int count_colorful(const Decoder& decoder, const std::byte* row) {
  const size_t pixel = decoder.bytes_of_pixel(0, 3), size = bytes_of(decoder.info.samples[0]);
  int count = 0;
  for (int x = 0; x < decoder.info.width; x++, row += pixel) {
    const float red = sample_value(decoder.info.samples[0], row);
    for (const size_t c : {size, 2 * size}) {
      if (std::abs(sample_value(decoder.info.samples[0], row + c) - red) <= 0.06f) continue;
      count++;
      break;
    }
  }
  return count;
}

int largest_code(SampleType sample) {
  return sample == SampleType::kUint8 ? 255 : sample == SampleType::kUint16 ? 65535 : 0;
}

DepthNumbers read_picture(const std::string& path) {
  const std::unique_ptr<Decoder> decoder = open_decoder(picture_on_disk(path));
  const FileInfo& info = decoder->info;
  const size_t channel = depth_channel(info.channels);
  const SampleType sample = info.samples[channel];
  const bool has_colors = channel == 0 && info.channels.size() >= 3 && !info.is_float;
  const size_t first = has_colors ? 0 : channel, count = has_colors ? 3 : 1;
  const size_t pixel = decoder->bytes_of_pixel(first, count), row = pixel * static_cast<size_t>(info.width);
  DepthNumbers depth{Image(info.width, info.height, 1), largest_code(sample), path};
  std::vector<std::byte> rows(row * static_cast<size_t>(std::min(decoder->band_rows(), info.height)));
  int64_t colorful = 0;
  for (int begin = 0; begin < info.height; begin += decoder->band_rows()) {
    const int end = std::min(begin + decoder->band_rows(), info.height);
    decoder->read(begin, end, first, count, rows.data());
    for (int y = begin; y < end; y++) {
      const std::byte* from = &rows[row * static_cast<size_t>(y - begin)];
      if (has_colors) colorful += count_colorful(*decoder, from);
      for (int x = 0; x < info.width; x++, from += pixel) *depth.numbers.at(x, y) = sample_value(sample, from);
    }
  }
  if (colorful * 100 > int64_t{info.width} * info.height) {
    throw cannot_read(path, "it has colours, but depth is grey: save the depth itself, not a visualisation of it");
  }
  return depth;
}

}  // namespace

DepthNumbers read_depth_numbers(const std::string& path) {
  const FileInput file(path);
  const std::string start = file.read(0, std::min<uint64_t>(file.size(), 6));
  if (start.starts_with("Pf") || start.starts_with("PF")) return {read_pfm(file), 0, path};
  if (start == "\x93NUMPY") {
    NpyArray array = read_npy(file);
    return {std::move(array.numbers), array.codes, path};
  }
  return read_picture(path);
}

}  // namespace ods
