// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/pixel_place.h"

#include <fmt/format.h>

#include <cmath>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/tiff_directory.h"

namespace ods {

namespace {

// Pixels per unit of length.
struct Resolution {
  double across = 0.0, down = 0.0;
  bool has_unit = false;
};

}  // namespace

static std::optional<Resolution> resolution_of_jpeg(const FileInput& file) {
  constexpr unsigned char kApp0 = 0xE0;
  for (const JpegSegment& segment : read_jpeg_headers(file)) {
    const std::string& data = segment.data;
    if (segment.marker != kApp0 || data.size() < 12 || data.compare(0, 5, std::string("JFIF\0", 5)) != 0) continue;
    return Resolution{static_cast<double>(get_number(data, 8, 2)), static_cast<double>(get_number(data, 10, 2)),
                      data[7] != 0};
  }
  return std::nullopt;
}

static std::optional<Resolution> resolution_of_png(const FileInput& file) {
  for (uint64_t at = 8; at + 12 <= file.size();) {
    const PngChunk chunk = read_png_chunk(file, at);
    if (chunk.type == "IDAT" || chunk.type == "IEND") break;
    if (chunk.type == "pHYs" && chunk.length == 9) {
      const std::string data = file.read(at + 8, 9);
      return Resolution{static_cast<double>(get_number(data, 0, 4)), static_cast<double>(get_number(data, 4, 4)),
                        data[8] == 1};
    }
    at += chunk.length + 12;
  }
  return std::nullopt;
}

// A rational number of a TIFF, which is two integers of 32 bits; 0 if the entry is missing or damaged.
static double tiff_ratio(const FileInput& file, const TiffDirectory& directory, uint16_t tag) {
  const std::optional<std::string> value = tiff_value(file, directory, tag, 8);
  const std::optional<uint64_t> both = tiff_number(file, directory, tag);
  if (!both || value->size() != 8) return 0.0;
  const uint64_t low = *both & 0xffffffff, high = *both >> 32;
  const uint64_t over = directory.is_little ? low : high, under = directory.is_little ? high : low;
  return under == 0 ? 0.0 : static_cast<double>(over) / static_cast<double>(under);
}

static std::optional<Resolution> resolution_of_tiff(const FileInput& file, const TiffDirectory& directory) {
  constexpr uint16_t kXResolution = 282, kYResolution = 283, kUnit = 296;
  return Resolution{tiff_ratio(file, directory, kXResolution), tiff_ratio(file, directory, kYResolution),
                    tiff_number(file, directory, kUnit).value_or(2) != 1};
}

// Positions are lengths, in the unit of the resolution.
static void read_area(const FileInput& file, const TiffDirectory& directory, const Resolution& resolution,
                      FileInfo& info) {
  constexpr uint16_t kXPosition = 286, kYPosition = 287, kFullWidth = 33300, kFullHeight = 33301;
  constexpr double kLargest = 1 << 24;
  const auto width = static_cast<double>(tiff_number(file, directory, kFullWidth).value_or(0));
  const auto height = static_cast<double>(tiff_number(file, directory, kFullHeight).value_or(0));
  const double left = std::round(tiff_ratio(file, directory, kXPosition) * resolution.across);
  const double top = std::round(tiff_ratio(file, directory, kYPosition) * resolution.down);
  const bool is_inside = left + info.width <= width && top + info.height <= height;
  const bool is_whole = width == info.width && height == info.height;
  if (!is_inside || is_whole || width > kLargest || height > kLargest) return;
  info.numbers[std::string(kWholeArea)] = {static_cast<float>(left), static_cast<float>(top), static_cast<float>(width),
                                           static_cast<float>(height)};
}

double plausible_aspect(double aspect) {
  constexpr double kMost = 4.0, kEqual = 0.01;  // scanners and editors leave numbers that differ a little, or nonsense
  const double off = aspect > 0.0 ? std::abs(std::log(aspect)) : 0.0;
  return off < kEqual || off > std::log(kMost) ? 1.0 : aspect;
}

static void read_aspect(const Resolution& resolution, int orientation, FileInfo& info) {
  if (!(resolution.across > 0.0 && resolution.down > 0.0)) return;
  const double aspect = plausible_aspect(resolution.down / resolution.across);
  if (aspect == 1.0) return;
  if (!resolution.has_unit) {
    info.text[std::string(kPixelDoubt)] = fmt::format(
        "its pixels may not be square: it has the ratio {:g}:{:g}, which programs write in both senses; "
        "taken for square",
        resolution.across, resolution.down);
    return;
  }
  info.numbers[std::string(kPixelAspect)] = {static_cast<float>(orientation >= 5 ? 1.0 / aspect : aspect)};
}

void read_pixel_place(const FileInput& file, FileFormat format, int orientation, FileInfo& info) {
  try {
    std::optional<Resolution> resolution;
    if (format == FileFormat::kJpeg) resolution = resolution_of_jpeg(file);
    if (format == FileFormat::kPng) resolution = resolution_of_png(file);
    if (format == FileFormat::kTiff) {
      const TiffDirectory directory = read_tiff_directory(file);
      resolution = resolution_of_tiff(file, directory);
      if (orientation == 1) read_area(file, directory, *resolution, info);
    }
    if (resolution) read_aspect(*resolution, orientation, info);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;  // damaged metadata have no say; reading the pixels reports them
  }
}

double pixel_aspect(const FileInfo& info) {
  const auto found = info.numbers.find(std::string(kPixelAspect));
  return found == info.numbers.end() ? 1.0 : static_cast<double>(found->second[0]);
}

}  // namespace ods
