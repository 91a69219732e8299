// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/orientation.h"

#include <algorithm>
#include <string>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/tiff_directory.h"

namespace ods {

constexpr uint16_t kOrientation = 274;
constexpr uint64_t kLongestExif = uint64_t{16} << 20;

// The TIFF in an Exif segment.
static uint64_t in_exif(std::string_view tiff) {
  const bool is_little = tiff.starts_with("II");
  const auto number = [&](size_t at, size_t count) {
    get_number(tiff, at, count);  // throws if it is out of bounds
    std::string bytes(tiff.substr(at, count));
    if (is_little) std::reverse(bytes.begin(), bytes.end());
    return get_number(bytes, 0, count);
  };
  const size_t directory = number(4, 4), count = number(directory, 2);
  for (size_t i = 0; i < count; i++) {
    const size_t entry = directory + 2 + 12 * i;
    if (number(entry, 2) == kOrientation) return number(entry + 8, 2);
  }
  return 1;
}

constexpr std::string_view kExif{"Exif\0\0", 6};

static uint64_t in_png(const FileInput& file) {
  for (uint64_t at = 8; at + 12 <= file.size();) {
    const PngChunk chunk = read_png_chunk(file, at);
    if (chunk.type == "IDAT" || chunk.type == "IEND") break;
    if (chunk.type == "eXIf" && chunk.length < kLongestExif) return in_exif(file.read(at + 8, chunk.length));
    at += chunk.length + 12;
  }
  return 1;
}

// Chunks of a RIFF file: a name, a little-endian length, the data, padded to an even length.
static uint64_t in_webp(const FileInput& file) {
  for (uint64_t at = 12; at + 8 <= file.size();) {
    const std::string header = file.read(at, 8);
    uint64_t length = 0;
    for (size_t i = 8; i-- > 4;) length = length << 8 | static_cast<unsigned char>(header[i]);
    if (length > file.size() - at - 8) break;
    if (header.starts_with("EXIF") && length < kLongestExif) {
      const std::string exif = file.read(at + 8, length);
      return in_exif(std::string_view(exif).substr(exif.starts_with(kExif) ? kExif.size() : 0));
    }
    at += 8 + length + length % 2;
  }
  return 1;
}

static uint64_t stated(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kTiff) return tiff_number(file, read_tiff_directory(file), kOrientation).value_or(1);
  if (format == FileFormat::kPng) return in_png(file);
  if (format == FileFormat::kWebp) return in_webp(file);
  if (format != FileFormat::kJpeg) return 1;
  for (const JpegSegment& segment : read_jpeg_headers(file)) {
    if (segment.marker == kJpegApp1 && segment.data.starts_with(kExif))
      return in_exif(std::string_view(segment.data).substr(kExif.size()));
  }
  return 1;
}

int orientation_of(const FileInput& file) {
  try {
    const uint64_t orientation = stated(file);
    return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
  } catch (const Error&) {
    return 1;  // reading the pixels reports the error
  } catch (const MalformedFile&) {
    return 1;
  }
}

}  // namespace ods
