// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/photo_metadata.h"

#include <fmt/format.h>

#include "ods/image/exif.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"

namespace ods {

std::string keep_photo_metadata(const std::string& from, const std::string& to, SaveOptions& options) {
  const FileInput file(from);
  for (const Attribute& property : gpano_properties(read_xmp(file))) {
    if (property.name.starts_with("GPano:InitialView") || property.name == "GPano:InitialHorizontalFOVDegrees") {
      options.attributes.push_back(property);
    }
  }
  options.exif = read_exif(file);
  const std::optional<FileFormat> format = format_of_path(to);
  if (options.exif.empty() || format == FileFormat::kJpeg || format == FileFormat::kPng) return "";
  return fmt::format("'{}' does not keep the Exif of '{}' (date, place, camera, author); .jpg and .png do", to, from);
}

}  // namespace ods
