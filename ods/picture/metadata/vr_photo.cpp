// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/vr_photo.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/base64.h"
#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/md5.h"
#include "ods/image/format/jpeg_segments.h"
#include "ods/image/format/xmp.h"
#include "ods/image/format/xmp_file.h"
#include "ods/picture/metadata/metadata.h"

namespace ods {

constexpr size_t kId = 32;                  // characters of an MD5
constexpr size_t kExtended = 35 + kId + 8;  // bytes of a segment before its part of the packet
constexpr uint64_t kMaxRight = uint64_t{3} << 30;

static Error damaged(const std::string& path, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot read the right eye in '{}': {}", path, why));
}

// --- extended XMP ----------------------------------------------------------------------------------------------------

namespace {

// A segment of extended XMP.
struct Piece {
  uint64_t whole = 0;  // bytes of the packet
  uint64_t at = 0;
  std::string_view bytes;
};

}  // namespace

static std::string capitals(std::string_view id) {
  std::string result(id);
  std::transform(id.begin(), id.end(), result.begin(), [](char c) { return c >= 'a' && c <= 'f' ? c - 32 : c; });
  return result;
}

static bool is_extended(const JpegSegment& segment) {
  return segment.marker == kJpegApp1 && segment.data.size() >= kExtended && segment.data.starts_with(kJpegExtendedXmp);
}

static std::string id_of(const JpegSegment& segment) {
  return capitals(std::string_view(segment.data).substr(kJpegExtendedXmp.size(), kId));
}

// The id in a packet, in capitals, if there are segments with it; else the id of the first segment.
static std::string find_id(const std::vector<JpegSegment>& segments, std::string_view packet) {
  const std::string stated = capitals(xmp_property(packet, "xmpNote:HasExtendedXMP"));
  std::string first;
  for (const JpegSegment& segment : segments) {
    if (!is_extended(segment)) continue;
    const std::string id = id_of(segment);
    if (id == stated) return id;
    if (first.empty()) first = id;
  }
  return first;
}

// The segments of the packet with this id, in order of offset.
static std::vector<Piece> pieces_of(const std::vector<JpegSegment>& segments, std::string_view id) {
  std::vector<Piece> pieces;
  for (const JpegSegment& segment : segments) {
    if (!is_extended(segment) || id_of(segment) != id) continue;
    const std::string_view data = segment.data;
    const size_t numbers = kJpegExtendedXmp.size() + kId;
    pieces.push_back({get_number(data, numbers, 4), get_number(data, numbers + 4, 4), data.substr(kExtended)});
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.at < b.at; });
  return pieces;
}

// Memory grows with the segments actually read, not with a length in the file's metadata.
static std::string join(const std::vector<Piece>& pieces, const std::string& path) {
  std::string packet;
  for (const Piece& piece : pieces) {
    if (piece.at != packet.size()) throw damaged(path, "parts of it are missing or duplicated");
    packet += piece.bytes;
  }
  for (const Piece& piece : pieces) {
    if (piece.whole != packet.size()) throw damaged(path, "its length differs from the one stated");
  }
  return packet;
}

static std::string extended_xmp(const std::vector<JpegSegment>& segments, std::string_view packet,
                                const std::string& path, std::vector<std::string>& warnings) {
  const std::string id = find_id(segments, packet);
  const std::string extended = join(pieces_of(segments, id), path);
  if (extended.empty()) throw damaged(path, "it is not there");
  if (capitals(xmp_property(packet, "xmpNote:HasExtendedXMP")) != id || md5(extended) != id) {
    warnings.push_back("the MD5 of the XMP that has its right eye does not match: another program changed it");
  }
  return extended;
}

// --- reading ---------------------------------------------------------------------------------------------------------

static std::string_view standard_packet(const std::vector<JpegSegment>& segments) {
  const JpegSegment* segment = find_packet(segments);
  return segment == nullptr ? std::string_view() : std::string_view(segment->data).substr(kJpegXmp.size());
}

static bool has_jpeg(const std::vector<JpegSegment>& segments, std::string_view packet) {
  if (xmp_property(packet, "GImage:Mime") == "image/jpeg") return true;
  const std::vector<Piece> pieces = pieces_of(segments, find_id(segments, packet));
  return !pieces.empty() && pieces[0].bytes.find("GImage:") != std::string_view::npos;
}

// Other kinds of photo also embed a second picture, such as another focus or a depth map.
static bool is_photo(const std::vector<JpegSegment>& segments) {
  const std::string_view packet = standard_packet(segments), type = xmp_property(packet, "GPano:ProjectionType");
  const auto has = [&](std::string_view name) { return packet.find(name) != std::string_view::npos; };
  if (!type.empty() && type != "equirectangular") return false;
  if (type.empty() && !has("GPano:") && (has("GFocus:") || has("GDepth:"))) return false;
  return has_jpeg(segments, packet);
}

bool is_photo(const std::string& path) {
  const FileInput file(path);
  if (file.size() < 4 || file.read(0, 3) != "\xff\xd8\xff") return false;
  try {
    return is_photo(read_jpeg_headers(file));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return false;  // reading the pixels reports the error
  }
}

static size_t count_right_eyes(std::string_view xmp) {
  constexpr std::string_view kName = "GImage:Data";
  size_t count = 0;
  for (size_t at = xmp.find(kName); at != std::string_view::npos; at = xmp.find(kName, at + 1)) {
    count += at == 0 || xmp[at - 1] != '/' ? 1 : 0;
  }
  return count;
}

std::string read_right_eye(const std::string& path, std::vector<std::string>& warnings) {
  const std::vector<JpegSegment> segments = read_jpeg_headers(FileInput(path));
  const std::string_view packet = standard_packet(segments);
  std::string_view data = xmp_property(packet, "GImage:Data");
  std::string extended;
  if (data.empty()) {
    extended = extended_xmp(segments, packet, path, warnings);
    data = xmp_property(extended, "GImage:Data");
  }
  if (count_right_eyes(packet) + count_right_eyes(extended) > 1) {
    warnings.push_back("it has more than one right eye: the first is used");
  }
  const std::string right = decode_base64(data);
  if (!right.starts_with("\xff\xd8\xff")) throw damaged(path, "it is not a JPEG");
  return right;
}

// --- writing ---------------------------------------------------------------------------------------------------------

void write_photo(const FileInput& left, const std::string& right, const StereoCamera& camera, Extent size,
                 AtomicFile& to) {
  if (right.size() > kMaxRight) throw damaged(left.path(), "it has more than 3 GiB, the limit of such a photo");
  const std::string extended = make_xmp_body({{"GImage:Data", encode_base64(right)}});
  const std::string id = md5(extended);
  std::vector<Attribute> properties;
  add_gpano(properties, camera, size);
  properties.push_back({"GImage:Mime", std::string("image/jpeg")});
  properties.push_back({"xmpNote:HasExtendedXMP", id});
  const uint64_t place = place_of_packet(read_jpeg_headers(left));
  left.copy(0, place, to);
  append(to, jpeg_segment(kJpegApp1, std::string(kJpegXmp) + make_xmp(properties)));
  constexpr size_t kPiece = kLongestJpegSegment - kExtended;
  for (size_t at = 0; at < extended.size(); at += kPiece) {
    std::string piece = std::string(kJpegExtendedXmp) + id;
    append_number(piece, extended.size(), 4);
    append_number(piece, at, 4);
    append(to, jpeg_segment(kJpegApp1, piece + extended.substr(at, kPiece)));
  }
  left.copy(place, left.size() - place, to);
}

}  // namespace ods
