// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/exr_guard.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "ods/image/format/exr_header.h"
#include "ods/image/format/image_limits.h"

namespace ods {

namespace {

constexpr size_t kLongestName = 255;
constexpr int64_t kMaxRowsOfAChunk = 256;  // DWAB's

// OpenEXR reads values of these types with their proper size, regardless of the size in the file.
struct TypeSize {
  std::string_view type;
  int32_t size;
};
constexpr TypeSize kTypeSizes[] = {{"box2f", 16},
                                   {"box2i", 16},
                                   {"chromaticities", 32},
                                   {"compression", 1},
                                   {"deepImageState", 1},
                                   {"double", 8},
                                   {"envmap", 1},
                                   {"float", 4},
                                   {"int", 4},
                                   {"keycode", 28},
                                   {"lineOrder", 1},
                                   {"m33d", 72},
                                   {"m33f", 36},
                                   {"m44d", 128},
                                   {"m44f", 64},
                                   {"rational", 8},
                                   {"tiledesc", 9},
                                   {"timecode", 8},
                                   {"v2d", 16},
                                   {"v2f", 8},
                                   {"v2i", 8},
                                   {"v3d", 24},
                                   {"v3f", 12},
                                   {"v3i", 12}};

struct Box {
  int32_t left, top, right, bottom;
};

class HeaderReader {
 public:
  HeaderReader(size_t size, const ByteReader& read) : size_(size), read_(read) {}

  size_t at = 0;

  template <class T>
  std::optional<T> number(size_t where) const {  // little endian, like all supported machines
    T value;
    if (where > size_ || size_ - where < sizeof value || !read_(where, &value, sizeof value)) return std::nullopt;
    return value;
  }

  // Reads up to the next zero, and skips it.
  std::optional<std::string> word() {
    char bytes[kLongestName + 1] = {};
    const size_t count = std::min(sizeof bytes, size_ - std::min(at, size_));
    if (count == 0 || !read_(at, bytes, count)) return std::nullopt;
    const char* end = static_cast<const char*>(std::memchr(bytes, 0, count));
    if (!end) return std::nullopt;
    at += static_cast<size_t>(end - bytes) + 1;
    return std::string(static_cast<const char*>(bytes), end);
  }

  bool skip(size_t count) {
    if (at > size_ || count > size_ - at) return false;
    at += count;
    return true;
  }

  bool has_room(int64_t offsets) const { return offsets <= static_cast<int64_t>(size_ / kExrOffsetSize); }

 private:
  size_t size_;
  const ByteReader& read_;
};

// Returns whether a list of channels ends at the end of its attribute.
bool is_channel_list(HeaderReader in, size_t size) {
  constexpr size_t kChannel = 16;  // bytes after its name
  const size_t end = in.at + size;
  while (in.at < end) {
    const std::optional<std::string> name = in.word();
    if (!name || (!name->empty() && !in.skip(kChannel))) return false;
    if (name->empty()) return in.at == end;
  }
  return false;
}

bool is_text_list(HeaderReader in, size_t size) {
  const size_t end = in.at + size;
  while (in.at < end) {
    const std::optional<uint32_t> length = in.number<uint32_t>(in.at);
    if (!length || !in.skip(sizeof *length) || !in.skip(*length)) return false;
  }
  return in.at == end;
}

bool is_preview(const HeaderReader& in, size_t size) {
  const uint64_t width = in.number<uint32_t>(in.at).value_or(0), height = in.number<uint32_t>(in.at + 4).value_or(0);
  return width <= size && height <= size && size == 8 + 4 * width * height;
}

// Returns whether OpenEXR will read as many bytes of the value at in.at as the file claims. If not, it continues at
// another position than this guard, or allocates memory for missing data.
bool has_true_size(const HeaderReader& in, const std::string& type, size_t size) {
  for (const TypeSize& known : kTypeSizes) {
    if (known.type == type) return size == static_cast<size_t>(known.size);
  }
  if (type == "chlist") return is_channel_list(in, size);
  if (type == "stringvector") return is_text_list(in, size);
  if (type == "preview") return is_preview(in, size);
  return type != "floatvector" || size % sizeof(float) == 0;
}

constexpr const char* kDamaged = "the EXR is cut short or damaged";

// Skips attributes up to the empty name at their end. Returns their fault.
std::string skip_attributes(HeaderReader& in, size_t file_size) {
  Box box{};
  int64_t columns = 0, rows = kMaxRowsOfAChunk;  // size of a chunk; 0 columns for the width of the picture
  for (;;) {
    const std::optional<std::string> name = in.word();
    if (!name) return kDamaged;
    if (name->empty()) break;
    const std::optional<std::string> type = in.word();
    const std::optional<int32_t> size = in.number<int32_t>(in.at);
    if (!type || !size || *size < 0 || !in.skip(sizeof *size)) return kDamaged;
    if (!has_true_size(in, *type, static_cast<size_t>(*size))) return kDamaged;
    if (*name == "dataWindow") box = in.number<Box>(in.at).value_or(Box{});
    if (*name == "tiles") {
      columns = in.number<uint32_t>(in.at).value_or(0);
      rows = in.number<uint32_t>(in.at + 4).value_or(0);
    }
    if (!in.skip(static_cast<size_t>(*size))) return kDamaged;
  }
  const int64_t width = int64_t{box.right} - box.left + 1, height = int64_t{box.bottom} - box.top + 1;
  if (width < 1 || height < 1 || rows < 1) return "";  // invalid, but small
  const auto side = [](int64_t length) { return static_cast<int>(std::min<int64_t>(length, INT32_MAX)); };
  const int longest = side(std::max({width, height, columns, rows}));
  const std::string fault = image_size_fault(side(width), side(height), longest, file_size);
  if (!fault.empty()) return fault;
  const int64_t across = columns > 0 ? (width + columns - 1) / columns : 1, down = (height + rows - 1) / rows;
  return in.has_room(across) && in.has_room(down) && in.has_room(across * down) ? "" : kDamaged;
}

}  // namespace

std::string exr_header_fault(size_t file_size, const ByteReader& read) {
  const uint32_t kSeveralParts = 1u << 12u;
  HeaderReader in(file_size, read);
  const std::optional<uint32_t> version = in.number<uint32_t>(4);
  if (!version) return kDamaged;
  in.at = 8;
  do {
    if (std::string fault = skip_attributes(in, file_size); !fault.empty()) return fault;
    const std::optional<char> next = in.number<char>(in.at);
    if (!next) return kDamaged;
    if (*next == 0) break;
  } while (*version & kSeveralParts);
  return "";
}

}  // namespace ods
