// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/stereo_jpeg.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "ods/base/bytes.h"
#include "ods/image/format/jpeg_segments.h"

namespace ods {

// --- MPO -------------------------------------------------------------------------------------------------------------

namespace {

constexpr std::string_view kMpf{"MPF\0", 4};
constexpr unsigned char kApp2 = 0xE2, kApp3 = 0xE3;

// The index of an MPO: a TIFF directory, whose offsets count from `bytes`.
struct MpfIndex {
  std::string_view bytes;

  uint64_t number(size_t at, size_t count) const {
    return get_number(bytes, at, count, bytes.starts_with("MM") ? std::endian::big : std::endian::little);
  }
};

}  // namespace

// The offsets, from the index, and the sizes of the pictures of the type Disparity.
static std::vector<FileRange> disparity_pictures(const MpfIndex& index) {
  constexpr uint64_t kEntries = 0xB002, kDisparity = 0x020002;
  constexpr size_t kEntry = 16;
  std::vector<FileRange> pictures;
  const size_t directory = index.number(4, 4);
  const uint64_t fields = index.number(directory, 2);
  for (uint64_t i = 0; i < fields; i++) {
    const size_t field = directory + 2 + 12 * i;
    if (index.number(field, 2) != kEntries) continue;
    const size_t size = index.number(field + 4, 4), at = index.number(field + 8, 4);
    if (size > index.bytes.size()) throw MalformedFile("its list of pictures (MPF) is damaged");
    for (size_t entry = at; entry + kEntry <= at + size; entry += kEntry) {
      if ((index.number(entry, 4) & 0xFFFFFF) != kDisparity) continue;
      pictures.push_back({index.number(entry + 8, 4), index.number(entry + 4, 4)});
    }
  }
  return pictures;
}

static void read_mpf(const FileInput& file, const JpegSegment& segment, StereoJpeg& stereo) {
  const uint64_t start = segment.offset + 4 + kMpf.size();  // of the index
  try {
    const std::vector<FileRange> pictures = disparity_pictures({std::string_view(segment.data).substr(kMpf.size())});
    if (pictures.size() != 2) return;
    const FileRange right{start + pictures[1].offset, pictures[1].size};
    if (right.offset >= file.size() || right.size > file.size() - right.offset || right.size == 0) {
      throw MalformedFile("the second picture in its list (MPF) is cut short: only the first one is read");
    }
    stereo.right = right;
  } catch (const MalformedFile& fault) {
    stereo.fault = fault.what();
  }
}

// --- JPS -------------------------------------------------------------------------------------------------------------

// Four bytes: separation, flags, layout, and the type, 1 for two eyes.
static std::string jps_layout(std::string_view descriptor) {
  const auto byte = [&](size_t at) { return static_cast<unsigned char>(descriptor[at]); };
  const bool half_height = byte(1) & 1, half_width = byte(1) & 2, left_first = byte(1) & 4;
  if (byte(3) == 0) return "mono";
  if (byte(3) != 1) return {};
  switch (byte(2)) {
    case 1:
      return "row-interleaved";
    case 2:
      return !left_first ? "cross-eyed" : half_width ? "side-by-side-half" : "side-by-side";
    case 3:
      return !left_first ? "bottom-top" : half_height ? "top-bottom-half" : "top-bottom";
    case 4:
      return "anaglyph";
    default:
      return {};
  }
}

// --- both ------------------------------------------------------------------------------------------------------------

StereoJpeg read_stereo_jpeg(const FileInput& file) {
  constexpr std::string_view kJps = "_JPSJPS_";
  constexpr size_t kDescriptor = kJps.size() + 2;  // after its length
  StereoJpeg stereo;
  for (const JpegSegment& segment : read_jpeg_headers(file)) {
    if (segment.marker == kApp2 && segment.data.starts_with(kMpf)) read_mpf(file, segment, stereo);
    if (segment.marker == kApp3 && segment.data.starts_with(kJps) && segment.data.size() >= kDescriptor + 4) {
      stereo.layout = jps_layout(std::string_view(segment.data).substr(kDescriptor, 4));
    }
  }
  return stereo;
}

void add_stereo(FileInfo& info, const StereoJpeg& stereo) {
  info.is_pair = stereo.right.size > 0;
  if (!stereo.layout.empty()) info.text[kStereoLayout] = stereo.layout;
  if (!stereo.fault.empty()) info.text[kStereoFault] = stereo.fault;
}

}  // namespace ods
