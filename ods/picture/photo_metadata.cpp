// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/photo_metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ods/image/exif.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"

namespace ods {

// The pictures that the file holds beside its eyes, for messages; or an empty string.
static std::string other_pictures(const FileInput& file, const std::string& xmp) {
  const bool has_depth = xmp.find("GDepth:") != std::string::npos || xmp.find("Device:Depth") != std::string::npos;
  if (has_depth) return "the depth map";
  if (format_of_file(file) != FileFormat::kJpeg || read_stereo_jpeg(file).others == 0) return {};
  return xmp.find("hdrgm:") != std::string::npos ? "the gain map" : "the further pictures (gain map, preview)";
}

std::string keep_photo_metadata(const std::string& from, const std::string& to, SaveOptions& options) {
  const FileInput file(from);
  const std::string xmp = read_xmp(file);
  for (const Attribute& property : gpano_properties(xmp)) {
    if (property.name.starts_with("GPano:InitialView") || property.name == "GPano:InitialHorizontalFOVDegrees") {
      options.attributes.push_back(property);
    }
  }
  options.exif = read_exif(file);
  const std::optional<FileFormat> format = format_of_path(to);
  std::vector<std::string> lost;
  const bool keeps_exif = format == FileFormat::kJpeg || format == FileFormat::kPng;
  if (!options.exif.empty() && !keeps_exif)
    lost.emplace_back("the Exif (date, place, camera, author; .jpg and .png do)");
  if (const std::string others = other_pictures(file, xmp); !others.empty()) lost.push_back(others);
  if (lost.empty()) return "";
  return fmt::format("'{}' does not keep {} of '{}'", to, fmt::join(lost, " and "), from);
}

}  // namespace ods
