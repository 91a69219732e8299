// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/xmp_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ods/base/error.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/tiff_directory.h"

namespace ods {

constexpr uint64_t kLongestPacket = uint64_t{16} << 20;

static Error untaggable(const FileInput& file, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot tag '{}': {}", file.path(), why));
}

namespace {

// A range of the file to be replaced.
struct Cut {
  uint64_t at = 0;
  uint64_t size = 0;
};

}  // namespace

static void write_with(const FileInput& file, AtomicFile& to, const Cut& cut, const std::string& bytes) {
  file.copy(0, cut.at, to);
  append(to, bytes);
  file.copy(cut.at + cut.size, file.size() - cut.at - cut.size, to);
}

// --- JPEG ------------------------------------------------------------------------------------------------------------

static Cut place_in_jpeg(const std::vector<JpegSegment>& segments) {
  const JpegSegment* old = find_packet(segments);
  return old == nullptr ? Cut{place_of_packet(segments), 0} : Cut{old->offset, old->size};
}

static void write_jpeg(const FileInput& file, AtomicFile& to, const std::string& packet) {
  const Cut cut = place_in_jpeg(read_jpeg_headers(file));
  if (packet.size() + kJpegXmp.size() > kLongestJpegSegment) {
    throw untaggable(file, fmt::format("its XMP would have {} bytes, but a JPEG has room for {}", packet.size(),
                                       kLongestJpegSegment - kJpegXmp.size()));
  }
  write_with(file, to, cut, packet.empty() ? "" : jpeg_segment(kJpegApp1, std::string(kJpegXmp) + packet));
}

// --- PNG -------------------------------------------------------------------------------------------------------------

namespace {

struct PngPacket {
  Cut place;
  std::optional<std::string> text;  // not set if it is compressed or damaged
};

}  // namespace

static std::optional<PngPacket> find_in_png(const FileInput& file) {
  for (uint64_t at = 8; at + 12 <= file.size();) {
    const PngChunk chunk = read_png_chunk(file, at);
    if (chunk.type == "IEND") break;
    if (chunk.type == "iTXt" && chunk.length >= kPngXmpKeyword.size() &&
        file.read(at + 8, kPngXmpKeyword.size()) == kPngXmpKeyword) {
      PngPacket packet{{at, chunk.length + 12}, std::nullopt};
      if (chunk.length > kLongestPacket) return packet;
      std::string data = file.read(at + 8, chunk.length).substr(kPngXmpKeyword.size());
      // Compression flag and method, then language and translated keyword, each with a terminating zero.
      const size_t language = data.find('\0', 2), keyword = data.find('\0', language + 1);
      if (data[0] == 0 && language != std::string::npos && keyword != std::string::npos) {
        packet.text = data.substr(keyword + 1);
      }
      return packet;
    }
    at += chunk.length + 12;
  }
  return std::nullopt;
}

static void write_png(const FileInput& file, AtomicFile& to, const std::string& packet) {
  const std::optional<PngPacket> old = find_in_png(file);
  if (old && !old->text) throw untaggable(file, "its XMP is compressed, which ods cannot change");
  const Cut place = old ? old->place : Cut{kPngAfterHeader, 0};
  write_with(file, to, place, packet.empty() ? "" : xmp_chunk(packet));
}

// --- all -------------------------------------------------------------------------------------------------------------

// The XMP specification, part 3, allows readers to find a packet by its markers in any file.
static std::string find_by_marks(const FileInput& file) {
  const std::string text = file.read(0, std::min<uint64_t>(file.size(), 1u << 20u));
  const size_t begin = text.find("<x:xmpmeta"), end = text.find("</x:xmpmeta>");
  return begin < end && end != std::string::npos ? text.substr(begin, end - begin) : std::string();
}

static std::string packet_of(const FileInput& file) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kJpeg) {
    const std::vector<JpegSegment> segments = read_jpeg_headers(file);
    const JpegSegment* segment = find_packet(segments);
    return segment == nullptr ? "" : segment->data.substr(kJpegXmp.size());
  }
  if (format == FileFormat::kPng) {
    const std::optional<PngPacket> packet = find_in_png(file);
    return packet ? packet->text.value_or("") : "";
  }
  if (format == FileFormat::kTiff) {
    return tiff_value(file, read_tiff_directory(file), kTiffXmp, kLongestPacket).value_or("");
  }
  return find_by_marks(file);
}

std::string read_xmp(const FileInput& file) {
  try {
    return packet_of(file);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {};  // reading the pixels reports the error
  }
}

std::string read_xmp(const std::string& path) {
  return read_xmp(FileInput(path));
}

void write_xmp(const FileInput& file, AtomicFile& to, const std::string& packet) {
  const std::optional<FileFormat> format = format_of_file(file);
  if (format == FileFormat::kJpeg) {
    write_jpeg(file, to, packet);
  } else if (format == FileFormat::kPng) {
    write_png(file, to, packet);
  } else if (format == FileFormat::kTiff) {
    write_tiff_value(file, to, read_tiff_directory(file), kTiffXmp, packet);
  } else {
    throw untaggable(file, "only JPEG, PNG and TIFF pictures can hold GPano");
  }
}

}  // namespace ods
