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
constexpr std::string_view kJps = "_JPSJPS_";
constexpr unsigned char kApp2 = 0xE2, kApp3 = 0xE3;
constexpr uint64_t kEntries = 0xB002, kDisparity = 0x020002;  // the list of pictures, and their type

// The index of an MPO: a TIFF directory, whose offsets count from `bytes`.
struct MpfIndex {
  std::string_view bytes;

  std::endian order() const { return bytes.starts_with("MM") ? std::endian::big : std::endian::little; }
  uint64_t number(size_t at, size_t count) const { return get_number(bytes, at, count, order()); }
};

}  // namespace

// The places of the entries in the index, one for each picture: its type, size and offset from the index, 4 bytes each.
static std::vector<size_t> places_of_entries(const MpfIndex& index) {
  constexpr size_t kEntry = 16;
  std::vector<size_t> places;
  const size_t directory = index.number(4, 4);
  const uint64_t fields = index.number(directory, 2);
  for (uint64_t i = 0; i < fields; i++) {
    const size_t field = directory + 2 + 12 * i;
    if (index.number(field, 2) != kEntries) continue;
    const size_t size = index.number(field + 4, 4), at = index.number(field + 8, 4);
    if (size > index.bytes.size() || at > index.bytes.size() - size)
      throw MalformedFile("its list of pictures (MPF) is damaged");
    for (size_t entry = at; entry + kEntry <= at + size; entry += kEntry) places.push_back(entry);
  }
  return places;
}

static void read_mpf(const FileInput& file, const JpegSegment& segment, StereoJpeg& stereo) {
  const uint64_t start = segment.offset + 4 + kMpf.size();  // of the index
  try {
    const MpfIndex index{std::string_view(segment.data).substr(kMpf.size())};
    std::vector<FileRange> pictures;  // of the type Disparity
    for (const size_t entry : places_of_entries(index)) {
      const bool is_eye = (index.number(entry, 4) & 0xFFFFFF) == kDisparity;
      if (is_eye) pictures.push_back({index.number(entry + 8, 4), index.number(entry + 4, 4)});
      if (!is_eye && index.number(entry + 8, 4) > 0) stereo.others++;
    }
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

std::optional<std::string> grown_mpf(const JpegSegment& segment, int64_t growth, bool is_behind) {
  if (segment.marker != kApp2 || !segment.data.starts_with(kMpf)) return std::nullopt;
  std::string bytes = segment.data.substr(kMpf.size());
  const MpfIndex index{bytes};
  const auto grow = [&](size_t at) {
    set_number(bytes, at, index.number(at, 4) + static_cast<uint64_t>(growth), 4, index.order());
  };
  try {
    for (const size_t entry : places_of_entries(index)) {
      const bool is_first = index.number(entry + 8, 4) == 0;
      if (is_first) grow(entry + 4);
      if (!is_first && is_behind) grow(entry + 8);
    }
  } catch (const MalformedFile&) {
    return std::nullopt;
  }
  return std::string(kMpf) + bytes;
}

namespace {

// A directory of MPF: its fields, then the values that do not fit in them.
class MpfDirectory {
 public:
  explicit MpfDirectory(uint64_t offset) : offset_(offset) {}

  void add(uint64_t tag, uint64_t type, uint64_t count, const std::string& value) {
    fields_.push_back({tag, type, count, value});
  }

  // next: the offset of the next directory, or 0.
  std::string bytes(uint64_t next) const {
    std::string head, values;
    append_number(head, fields_.size(), 2);
    for (const Field& field : fields_) {
      append_number(head, field.tag, 2);
      append_number(head, field.type, 2);
      append_number(head, field.count, 4);
      if (field.value.size() <= 4) {
        head += field.value;
      } else {
        append_number(head, offset_ + size_of_head() + values.size(), 4);
        values += field.value;
      }
    }
    append_number(head, next, 4);
    return head + values;
  }

  uint64_t end() const { return offset_ + bytes(0).size(); }

 private:
  struct Field {
    uint64_t tag, type, count;
    std::string value;
  };
  size_t size_of_head() const { return 2 + 12 * fields_.size() + 4; }

  uint64_t offset_;
  std::vector<Field> fields_;
};

}  // namespace

constexpr uint64_t kUndefinedType = 7, kLong = 4, kFirstDirectory = 8;
constexpr std::string_view kBigEndian{"MM\0*\0\0\0\x8", kFirstDirectory};

static std::string four_bytes(uint64_t value) {
  std::string bytes;
  append_number(bytes, value, 4);
  return bytes;
}

// The attributes of picture 1 (left) or 2 (right).
static MpfDirectory attributes_of(uint64_t picture, uint64_t offset) {
  MpfDirectory directory(offset);
  if (picture != 1) directory.add(0xB000, kUndefinedType, 4, "0100");  // the version
  directory.add(0xB101, kLong, 1, four_bytes(picture));
  directory.add(0xB204, kLong, 1, four_bytes(1));  // the base viewpoint
  return directory;
}

// The index of two pictures. second: the offset of the second one from the index.
static std::string mpf_index(uint64_t first_size, uint64_t second_size, uint64_t second) {
  constexpr uint64_t kShown = 0x20000000;  // the one that other programs display
  std::string entries;
  for (const uint64_t number :
       {kShown | kDisparity, first_size, uint64_t{0}, uint64_t{0}, kDisparity, second_size, second, uint64_t{0}}) {
    append_number(entries, number, 4);
  }
  MpfDirectory index(kFirstDirectory);
  index.add(0xB000, kUndefinedType, 4, "0100");
  index.add(0xB001, kLong, 1, four_bytes(2));
  index.add(kEntries, kUndefinedType, entries.size(), entries);
  return std::string(kBigEndian) + index.bytes(index.end()) + attributes_of(1, index.end()).bytes(0);
}

// --- JPS -------------------------------------------------------------------------------------------------------------

namespace {

// A layout of both eyes in a descriptor: its third byte, and the flags of the second one that distinguish it.
struct JpsLayout {
  std::string_view name;
  unsigned char placement;
  unsigned char mask, flags;
};

constexpr unsigned char kHalfHeight = 1, kHalfWidth = 2, kLeftFirst = 4;
constexpr JpsLayout kJpsLayouts[] = {
    {"row-interleaved", 1, 0, kLeftFirst},
    {"cross-eyed", 2, kLeftFirst, 0},
    {"side-by-side-half", 2, kLeftFirst | kHalfWidth, kLeftFirst | kHalfWidth},
    {"side-by-side", 2, kLeftFirst, kLeftFirst},
    {"bottom-top", 3, kLeftFirst, 0},
    {"top-bottom-half", 3, kLeftFirst | kHalfHeight, kLeftFirst | kHalfHeight},
    {"top-bottom", 3, kLeftFirst, kLeftFirst},
    {"anaglyph", 4, 0, 0},
};

}  // namespace

// Four bytes: separation, flags, layout, and the type, 1 for two eyes.
static std::string jps_layout(std::string_view descriptor) {
  const auto byte = [&](size_t at) { return static_cast<unsigned char>(descriptor[at]); };
  if (byte(3) == 0) return "mono";
  if (byte(3) != 1) return {};
  for (const JpsLayout& layout : kJpsLayouts) {
    if (byte(2) == layout.placement && (byte(1) & layout.mask) == (layout.flags & layout.mask)) {
      return std::string(layout.name);
    }
  }
  return {};
}

// --- both ------------------------------------------------------------------------------------------------------------

StereoJpeg read_stereo_jpeg(const FileInput& file) {
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

// The place after JFIF and Exif, which readers expect first.
static size_t place_of_segment(std::string_view jpeg) {
  size_t at = 2;
  while (jpeg.substr(at, 2) == "\xff\xe0" || jpeg.substr(at, 2) == "\xff\xe1") at += 2 + get_number(jpeg, at + 2, 2);
  return at;
}

static std::string with_segment(std::string_view jpeg, size_t place, const std::string& segment) {
  return std::string(jpeg.substr(0, place)) + segment + std::string(jpeg.substr(place));
}

std::string make_mpo(std::string_view left, std::string_view right) {
  const auto segment = [](const std::string& mpf) { return jpeg_segment(kApp2, std::string(kMpf) + mpf); };
  const std::string second = with_segment(
      right, place_of_segment(right), segment(std::string(kBigEndian) + attributes_of(2, kFirstDirectory).bytes(0)));
  const size_t place = place_of_segment(left), first_size = left.size() + segment(mpf_index(0, 0, 0)).size();
  const size_t start = place + 4 + kMpf.size();  // of the index
  return with_segment(left, place, segment(mpf_index(first_size, second.size(), first_size - start))) + second;
}

std::optional<std::string> make_jps(std::string_view jpeg, std::string_view layout) {
  const auto row = std::ranges::find(kJpsLayouts, layout, &JpsLayout::name);
  if (row == std::end(kJpsLayouts)) return std::nullopt;
  const std::string descriptor{'\0', '\4', '\0', static_cast<char>(row->flags), static_cast<char>(row->placement), 1};
  return with_segment(jpeg, place_of_segment(jpeg), jpeg_segment(kApp3, std::string(kJps) + descriptor));
}

void add_stereo(FileInfo& info, const StereoJpeg& stereo) {
  info.is_pair = stereo.right.size > 0;
  if (!stereo.layout.empty()) info.text[kStereoLayout] = stereo.layout;
  if (!stereo.fault.empty()) info.text[kStereoFault] = stereo.fault;
}

}  // namespace ods
