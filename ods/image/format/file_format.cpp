// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/file_format.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>

#include "ods/base/text.h"

namespace ods {

using namespace std::string_view_literals;

namespace {

struct Extension {
  std::string_view name;
  FileFormat format;
};

}  // namespace
static const Extension kExtensions[] = {
    {"png", FileFormat::kPng},   {"jpg", FileFormat::kJpeg}, {"jpeg", FileFormat::kJpeg}, {"mpo", FileFormat::kJpeg},
    {"jps", FileFormat::kJpeg},  {"tif", FileFormat::kTiff}, {"tiff", FileFormat::kTiff}, {"webp", FileFormat::kWebp},
    {"heic", FileFormat::kHeif}, {"hdr", FileFormat::kHdr},  {"exr", FileFormat::kExr},
};

constexpr std::string_view kOnlyRead[] = {"pns", "heif", "avif"};

static std::string extension_of(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().native();
  return small_letters(extension.substr(extension.empty() ? 0 : 1));
}

std::optional<FileFormat> format_of_path(const std::string& path) {
  const std::string extension = extension_of(path);
  for (const Extension& known : kExtensions) {
    if (known.name == extension) return known.format;
  }
  return std::nullopt;
}

bool names_picture(const std::string& path) {
  const std::string extension = extension_of(path);
  return format_of_path(path) ||
         std::find(std::begin(kOnlyRead), std::end(kOnlyRead), extension) != std::end(kOnlyRead);
}

// ISO/IEC 23008-12 and the AVIF specification: the brand of the file.
static bool is_heif(std::string_view bytes) {
  if (bytes.size() < 12 || bytes.substr(4, 4) != "ftyp") return false;
  constexpr std::string_view kBrands[] = {"heic", "heix", "heim", "heis", "mif1", "mif2",
                                          "avif", "miaf", "hevc", "hevx", "msf1", "avis"};
  return std::find(std::begin(kBrands), std::end(kBrands), bytes.substr(8, 4)) != std::end(kBrands);
}

std::optional<FileFormat> format_of_bytes(std::span<const std::byte> file) {
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return FileFormat::kPng;
  if (bytes.starts_with("\xff\xd8\xff"sv)) return FileFormat::kJpeg;
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return FileFormat::kTiff;
  if (bytes.starts_with("II+\0"sv) || bytes.starts_with("MM\0+"sv)) return FileFormat::kTiff;
  if (bytes.starts_with("RIFF"sv) && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP"sv) return FileFormat::kWebp;
  if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) return FileFormat::kHdr;
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return FileFormat::kExr;
  if (is_heif(bytes)) return FileFormat::kHeif;
  return std::nullopt;
}

std::optional<FileFormat> format_of_file(const FileInput& file) {
  const std::string start = file.read(0, std::min<uint64_t>(file.size(), 16));
  return format_of_bytes(std::as_bytes(std::span(start)));
}

std::string known_extensions() {
  std::string list;
  for (const Extension& known : kExtensions) {
    if (!list.empty()) list += ", ";
    list += known.name;
  }
  return list;
}

std::string readable_extensions() {
  std::string list = known_extensions();
  for (const std::string_view extension : kOnlyRead) list += ", " + std::string(extension);
  return list;
}

bool is_scene_referred(FileFormat format) {
  return format == FileFormat::kHdr || format == FileFormat::kExr;
}

int longest_side(FileFormat format) {
  switch (format) {
    case FileFormat::kWebp:
      return 16383;
    case FileFormat::kJpeg:
      return 65500;  // libjpeg's limit
    case FileFormat::kPng:
      return 1000000;  // libpng's limit
    case FileFormat::kHeif:
      return 16384;  // HEVC's highest level has 16888
    case FileFormat::kTiff:
    case FileFormat::kHdr:
    case FileFormat::kExr:
      break;
  }
  return std::numeric_limits<int>::max();
}

}  // namespace ods
