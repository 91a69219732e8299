// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/photo_metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/image/exif.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "ods/image/heif_items.h"

namespace ods {

static int heif_others(const FileInput& file) {
  try {
    return read_heif_items(file).others;
  } catch (const MalformedFile& fault) {
    throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': {}", file.path(), fault.what()));
  }
}

// The pictures that the file holds beside its eyes, for messages; or an empty string.
static std::string other_pictures(const FileInput& file, const std::string& xmp) {
  const bool has_depth = xmp.find("GDepth:") != std::string::npos || xmp.find("Device:Depth") != std::string::npos;
  if (has_depth) return "the depth map";
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kHeif) return heif_others(file) == 0 ? "" : "the further pictures (gain map, depth map)";
  if (format != FileFormat::kJpeg || read_stereo_jpeg(file).others == 0) return {};
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
  const bool keeps_exif = format == FileFormat::kJpeg || format == FileFormat::kPng || format == FileFormat::kHeif;
  if (!options.exif.empty() && !keeps_exif)
    lost.emplace_back("the Exif (date, place, camera, author; .jpg, .png and .heic do)");
  if (const std::string others = other_pictures(file, xmp); !others.empty()) lost.push_back(others);
  if (lost.empty()) return "";
  return fmt::format("'{}' does not keep {} of '{}'", to, fmt::join(lost, " and "), from);
}

}  // namespace ods
