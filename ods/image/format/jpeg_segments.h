// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads JPEG structure that libjpeg does not expose. Sources: ITU-T T.81, annex B; Adobe, "XMP Specification Part 3"
// for packets.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/extent.h"
#include "ods/files/file_input.h"
#include "ods/files/read_file.h"

namespace ods {

// Returns whether a JPEG of this size is complete from its first marker to its end-of-image marker. End markers of
// thumbnails embedded in headers do not count.
bool is_whole_jpeg(size_t file_size, const ByteReader& read);

// A segment between the start of the image and its first scan.
struct JpegSegment {
  unsigned char marker = 0;
  uint64_t offset = 0;
  uint64_t size = 0;  // in the file, including marker and length
  std::string data;   // without marker and length
};

inline constexpr unsigned char kJpegApp1 = 0xE1;
inline constexpr size_t kLongestJpegSegment = 65533;  // bytes of data
// The prefixes of segments with an XMP packet, and of those with extended XMP.
inline constexpr std::string_view kJpegXmp{"http://ns.adobe.com/xap/1.0/\0", 29};
inline constexpr std::string_view kJpegExtendedXmp{"http://ns.adobe.com/xmp/extension/\0", 35};

// Throws Error(kInput) if the file is not a JPEG, truncated, or damaged before its first scan.
std::vector<JpegSegment> read_jpeg_headers(const FileInput& file);

std::string jpeg_segment(unsigned char marker, std::string_view data);

// The segment with an XMP packet, or nullptr.
const JpegSegment* find_packet(const std::vector<JpegSegment>& headers);

// The file offset for an XMP packet: after JFIF and Exif, which readers expect first.
uint64_t place_of_packet(const std::vector<JpegSegment>& headers);

// The size in pixels from the frame header, or nullopt if there is none.
std::optional<Extent> jpeg_size(const std::vector<JpegSegment>& headers);

}  // namespace ods
