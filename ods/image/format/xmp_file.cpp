// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/xmp_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include "ods/base/error.h"
#include "ods/image/format/file_format.h"
#include "ods/image/format/inflate.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/png_chunks.h"
#include "ods/image/format/stereo_jpeg.h"
#include "ods/image/format/tiff_directory.h"

namespace ods {

// ImageMagick keeps the XMP of another format in a chunk of this name.
constexpr std::string_view kRawXmpKeyword{"Raw profile type xmp\0", 21};
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

// The replacements are in the order of the file.
static void write_with(const FileInput& file, AtomicFile& to, const std::vector<std::pair<Cut, std::string>>& changes) {
  uint64_t at = 0;
  for (const auto& [cut, bytes] : changes) {
    file.copy(at, cut.at - at, to);
    append(to, bytes);
    at = cut.at + cut.size;
  }
  file.copy(at, file.size() - at, to);
}

// --- JPEG ------------------------------------------------------------------------------------------------------------

static Cut place_in_jpeg(const std::vector<JpegSegment>& segments) {
  const JpegSegment* old = find_packet(segments);
  return old == nullptr ? Cut{place_of_packet(segments), 0} : Cut{old->offset, old->size};
}

// A list of further pictures in the file (MPF) follows their new places.
static void write_jpeg(const FileInput& file, AtomicFile& to, const std::string& packet) {
  const std::vector<JpegSegment> segments = read_jpeg_headers(file);
  const Cut cut = place_in_jpeg(segments);
  if (packet.size() + kJpegXmp.size() > kLongestJpegSegment) {
    throw untaggable(file, fmt::format("its XMP would have {} bytes, but a JPEG has room for {}", packet.size(),
                                       kLongestJpegSegment - kJpegXmp.size()));
  }
  const std::string bytes = packet.empty() ? "" : jpeg_segment(kJpegApp1, std::string(kJpegXmp) + packet);
  std::vector<std::pair<Cut, std::string>> changes{{cut, bytes}};
  const int64_t growth = static_cast<int64_t>(bytes.size()) - static_cast<int64_t>(cut.size);
  for (const JpegSegment& segment : segments) {
    const bool is_behind = cut.at > segment.offset;
    const std::optional<std::string> mpf = grown_mpf(segment, growth, is_behind);
    if (!mpf) continue;
    changes.insert(is_behind ? changes.end() - 1 : changes.end(),
                   {{segment.offset, segment.size}, jpeg_segment(segment.marker, *mpf)});
  }
  write_with(file, to, changes);
}

// --- PNG -------------------------------------------------------------------------------------------------------------

namespace {

struct PngPacket {
  Cut place;
  std::optional<std::string> text;  // not set if it is damaged
  bool is_plain = false;            // as the XMP specification has it: not compressed, not ImageMagick's
};

}  // namespace

// The digits of ImageMagick's text: a name, a length, and the bytes as hexadecimal.
static std::optional<std::string> raw_profile(std::string_view text) {
  const size_t name = text.find_first_not_of('\n');
  const size_t length = text.find('\n', std::min(name, text.size()));
  const size_t digits = text.find('\n', std::min(length, text.size() - 1) + 1);
  if (text.empty() || digits == std::string_view::npos) return std::nullopt;
  std::string bytes, pair;
  for (const char c : text.substr(digits)) {
    if (c == '\n') continue;
    if (!std::isxdigit(static_cast<unsigned char>(c))) return std::nullopt;
    pair += c;
    if (pair.size() == 2) bytes += static_cast<char>(std::stoi(pair, nullptr, 16)), pair.clear();
  }
  return bytes;
}

// The packet in the data of a chunk with XMP, after its keyword.
static std::optional<std::string> packet_in_chunk(const std::string& type, std::string_view data) {
  if (type == "zTXt") {  // compression method
    const std::optional<std::string> text = data.empty() ? std::nullopt : inflated(data.substr(1), kLongestPacket);
    return text ? raw_profile(*text) : std::nullopt;
  }
  if (type == "tEXt") return raw_profile(data);
  // Compression flag and method, then language and translated keyword, each with a terminating zero.
  const size_t language = data.find('\0', 2);
  const size_t keyword = language == std::string_view::npos ? language : data.find('\0', language + 1);
  if (keyword == std::string_view::npos) return std::nullopt;
  const std::string_view text = data.substr(keyword + 1);
  return data[0] == 0 ? std::string(text) : inflated(text, kLongestPacket);
}

static std::optional<PngPacket> find_in_png(const FileInput& file) {
  for (uint64_t at = 8; at + 12 <= file.size();) {
    const PngChunk chunk = read_png_chunk(file, at);
    if (chunk.type == "IEND") break;
    const std::string_view keyword = chunk.type == "iTXt" ? kPngXmpKeyword : kRawXmpKeyword;
    const bool is_text = chunk.type == "iTXt" || chunk.type == "zTXt" || chunk.type == "tEXt";
    if (is_text && chunk.length > keyword.size() && file.read(at + 8, keyword.size()) == keyword) {
      PngPacket packet{{at, chunk.length + 12}, std::nullopt};
      if (chunk.length > kLongestPacket) return packet;
      const std::string data = file.read(at + 8, chunk.length).substr(keyword.size());
      packet.is_plain = chunk.type == "iTXt" && data[0] == 0;
      packet.text = packet_in_chunk(chunk.type, data);
      return packet;
    }
    at += chunk.length + 12;
  }
  return std::nullopt;
}

static void write_png(const FileInput& file, AtomicFile& to, const std::string& packet) {
  const std::optional<PngPacket> old = find_in_png(file);
  if (old && !old->is_plain) throw untaggable(file, "its XMP is compressed, which ods cannot change");
  const Cut place = old ? old->place : Cut{kPngAfterHeader, 0};
  write_with(file, to, {{place, packet.empty() ? "" : xmp_chunk(packet)}});
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

// Gives Google's namespaces the prefixes that they usually have: XML allows any.
static std::string with_usual_prefixes(std::string packet) {
  constexpr std::pair<std::string_view, std::string_view> kSpaces[] = {
      {"GPano", "http://ns.google.com/photos/1.0/panorama/"}, {"GImage", "http://ns.google.com/photos/1.0/image/"}};
  for (const auto& [usual, uri] : kSpaces) {
    const size_t at = packet.find(uri);
    const size_t name = at == std::string::npos ? at : packet.rfind("xmlns:", at);
    if (name == std::string::npos || at < name + 8) continue;
    const std::string prefix = packet.substr(name + 6, at - name - 8);  // up to the equals sign and the quote
    const bool is_name = !prefix.empty() && std::ranges::all_of(prefix, [](unsigned char c) {
      return std::isalnum(c) || c == '_' || c == '-' || c == '.';
    });
    if (!is_name || prefix == usual) continue;
    for (const auto& [from, to] : {std::pair{prefix + ":", std::string(usual) + ":"},
                                   std::pair{":" + prefix + "=", ":" + std::string(usual) + "="}}) {
      for (size_t found = packet.find(from); found != std::string::npos; found = packet.find(from, found + 1)) {
        const bool is_whole =
            from[0] == ':' || found == 0 || !std::isalnum(static_cast<unsigned char>(packet[found - 1]));
        if (is_whole) packet.replace(found, from.size(), to);
      }
    }
  }
  return packet;
}

std::string read_xmp(const FileInput& file) {
  try {
    return with_usual_prefixes(packet_of(file));
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
