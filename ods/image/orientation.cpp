// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/orientation.h"

#include <optional>
#include <string>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/exif.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/tiff_directory.h"

namespace ods {

static uint64_t stated(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kHeif) return 1;  // its properties irot and imir apply, which decoders obey
  if (format == FileFormat::kTiff) return tiff_number(file, read_tiff_directory(file), kTiffOrientation).value_or(1);
  const std::string exif = read_exif(file);
  return exif.empty() ? 1 : exif_orientation(exif);
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
