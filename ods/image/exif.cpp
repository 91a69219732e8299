// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/exif.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/tiff_directory.h"
#include "ods/image/heif_items.h"

namespace ods {

// --- in a file -------------------------------------------------------------------------------------------------------

constexpr uint64_t kLongestExif = uint64_t{16} << 20;

static std::string in_png(const FileInput& file) {
  for (uint64_t at = 8; at + 12 <= file.size();) {
    const PngChunk chunk = read_png_chunk(file, at);
    if (chunk.type == "IDAT" || chunk.type == "IEND") break;
    if (chunk.type == "eXIf" && chunk.length < kLongestExif) return file.read(at + 8, chunk.length);
    at += chunk.length + 12;
  }
  return "";
}

// Chunks of a RIFF file: a name, a little-endian length, the data, padded to an even length.
static std::string in_webp(const FileInput& file) {
  for (uint64_t at = 12; at + 8 <= file.size();) {
    const std::string header = file.read(at, 8);
    const uint64_t length = get_number(header, 4, 4, std::endian::little);
    if (length > file.size() - at - 8) break;
    if (header.starts_with("EXIF") && length < kLongestExif) {
      const std::string exif = file.read(at + 8, length);
      return exif.substr(exif.starts_with(kExifPrefix) ? kExifPrefix.size() : 0);
    }
    at += 8 + length + length % 2;
  }
  return "";
}

static std::string in_jpeg(const FileInput& file) {
  for (const JpegSegment& segment : read_jpeg_headers(file)) {
    if (segment.marker == kJpegApp1 && segment.data.starts_with(kExifPrefix))
      return segment.data.substr(kExifPrefix.size());
  }
  return "";
}

static std::string in_heif(const FileInput& file) {
  try {
    return read_heif_exif(file, kLongestExif);
  } catch (const MalformedFile& fault) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", file.path(), fault.what()));
  }
}

std::string read_exif(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kPng) return in_png(file);
  if (format == FileFormat::kWebp) return in_webp(file);
  if (format == FileFormat::kHeif) return in_heif(file);
  return format == FileFormat::kJpeg ? in_jpeg(file) : "";
}

// --- its directories -------------------------------------------------------------------------------------------------

namespace {

constexpr uint16_t kExifDirectory = 0x8769, kWidth = 0xA002, kHeight = 0xA003;
constexpr uint16_t kThumbnail = 0x0201, kThumbnailLength = 0x0202;
constexpr uint64_t kShort = 3;

// Numbers of the byte order that the first two bytes declare.
struct TiffNumbers {
  std::string bytes;

  std::endian order() const { return bytes.starts_with("II") ? std::endian::little : std::endian::big; }
  uint64_t get(size_t at, size_t count) const { return get_number(bytes, at, count, order()); }
  void set(size_t at, uint64_t value, size_t count) { set_number(bytes, at, value, count, order()); }

  size_t first_directory() const { return get(4, 4); }
  size_t end_of(size_t directory) const { return directory + 2 + 12 * get(directory, 2); }
  // Returns the position of a tag's entry.
  std::optional<size_t> find(size_t directory, uint16_t tag) const {
    for (size_t entry = directory + 2; entry < end_of(directory); entry += 12) {
      if (get(entry, 2) == tag) return entry;
    }
    return std::nullopt;
  }
  size_t bytes_of(size_t entry) const { return get(entry + 2, 2) == kShort ? 2 : 4; }
  std::optional<uint64_t> value(size_t directory, uint16_t tag) const {
    const std::optional<size_t> entry = find(directory, tag);
    return entry ? std::optional(get(*entry + 8, bytes_of(*entry))) : std::nullopt;
  }
  void replace(size_t directory, uint16_t tag, uint64_t value) {
    if (const std::optional<size_t> entry = find(directory, tag)) set(*entry + 8, value, bytes_of(*entry));
  }
};

// The thumbnail is in a second directory, usually at the end.
void drop_thumbnail(TiffNumbers& tiff) {
  const size_t link = tiff.end_of(tiff.first_directory());
  const size_t second = tiff.get(link, 4);
  if (second == 0) return;
  const std::optional<uint64_t> begin = tiff.value(second, kThumbnail), length = tiff.value(second, kThumbnailLength);
  tiff.set(link, 0, 4);
  if (!begin || !length || *begin >= tiff.bytes.size() || *length > tiff.bytes.size() - *begin) return;
  if (*begin + *length == tiff.bytes.size()) {
    tiff.bytes.resize(*begin);
  } else {
    std::fill_n(tiff.bytes.begin() + static_cast<ptrdiff_t>(*begin), *length, '\0');
  }
}

}  // namespace

uint64_t exif_orientation(std::string_view exif) {
  const TiffNumbers tiff{std::string(exif)};
  return tiff.value(tiff.first_directory(), kTiffOrientation).value_or(1);
}

std::string exif_for(std::string exif, Extent size) {
  try {
    TiffNumbers tiff{std::move(exif)};
    const size_t first = tiff.first_directory();
    tiff.replace(first, kTiffOrientation, 1);
    if (const std::optional<uint64_t> camera = tiff.value(first, kExifDirectory)) {
      tiff.replace(*camera, kWidth, static_cast<uint64_t>(size.width));
      tiff.replace(*camera, kHeight, static_cast<uint64_t>(size.height));
    }
    drop_thumbnail(tiff);
    return tiff.bytes;
  } catch (const MalformedFile&) {
    return "";
  }
}

}  // namespace ods
