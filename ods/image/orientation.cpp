// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/orientation.h"

#include <algorithm>
#include <string>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/tiff_directory.h"

namespace ods {

constexpr uint16_t kOrientation = 274;

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

static uint64_t stated(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kTiff) return tiff_number(file, read_tiff_directory(file), kOrientation).value_or(1);
  if (format != FileFormat::kJpeg) return 1;
  constexpr std::string_view kExif{"Exif\0\0", 6};
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
