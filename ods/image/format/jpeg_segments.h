// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What libjpeg does not tell of a JPEG file. ITU-T T.81, annex B; Adobe, "XMP Specification Part 3" for its packets.
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

// Whether a JPEG of so many bytes goes on from its first marker to its last one, the end of the image. Thumbnails in
// its headers have ends of their own, and do not count.
bool is_whole_jpeg(size_t file_size, const ByteReader& read);

// What stands between the start of the image and its first scan.
struct JpegSegment {
  unsigned char marker = 0;
  uint64_t offset = 0;
  uint64_t size = 0;  // in the file, with marker and length
  std::string data;   // behind the length
};

inline constexpr unsigned char kJpegApp1 = 0xE1;
inline constexpr size_t kLongestJpegSegment = 65533;  // bytes of data
// How the data begins of the segment that holds a packet of XMP, and of those that hold extended XMP.
inline constexpr std::string_view kJpegXmp{"http://ns.adobe.com/xap/1.0/\0", 29};
inline constexpr std::string_view kJpegExtendedXmp{"http://ns.adobe.com/xmp/extension/\0", 35};

// Throws Error(kInput): no JPEG, cut short or damaged before its first scan.
std::vector<JpegSegment> read_jpeg_headers(const FileInput& file);

std::string jpeg_segment(unsigned char marker, std::string_view data);

// The segment that holds a packet of XMP; nullptr: there is none.
const JpegSegment* find_packet(const std::vector<JpegSegment>& headers);

// Where a packet of XMP belongs: behind what readers look for first, JFIF and Exif.
uint64_t place_of_packet(const std::vector<JpegSegment>& headers);

// The size in pixels that a frame header says; nothing where there is none.
std::optional<Extent> jpeg_size(const std::vector<JpegSegment>& headers);

}  // namespace ods
