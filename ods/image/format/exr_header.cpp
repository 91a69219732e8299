// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "ods/base/checksum.h"
#include "ods/base/error.h"

namespace ods {

constexpr uint64_t kStart = 8;                     // magic number and version, in bytes
constexpr uint64_t kLongestHeader = 64ull << 20u;  // limit on the header's bytes

static Error unusable(const FileInput& file, const std::string& why) {
  return Error(ErrorKind::kInput, fmt::format("cannot use '{}': {}", file.path(), why));
}

template <class T>
static T number_at(std::string_view bytes, size_t at) {  // little endian, like all supported machines
  T value{};
  if (at <= bytes.size() && sizeof value <= bytes.size() - at) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <class T>
static std::string bytes_of(const T* values, size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

ExrHeader read_exr_header(const FileInput& file) {
  constexpr uint32_t kSeveralParts = 1u << 12u;
  const Error damaged = unusable(file, "the EXR is cut short or damaged");
  const std::string bytes = file.read(0, std::min(file.size(), kLongestHeader));
  if (bytes.size() < kStart || !bytes.starts_with("\x76\x2f\x31\x01")) throw damaged;
  if ((number_at<uint32_t>(bytes, 4) & kSeveralParts) != 0) throw unusable(file, "it is a multi-part EXR");
  ExrHeader header;
  size_t at = kStart;
  const auto word = [&] {
    const size_t end = bytes.find('\0', at);
    if (end == std::string::npos) throw damaged;
    const std::string text = bytes.substr(at, end - at);
    at = end + 1;
    return text;
  };
  for (std::string name = word(); !name.empty(); name = word()) {
    const std::string type = word();
    const int32_t size = number_at<int32_t>(bytes, at);
    if (size < 0 || at + 4 > bytes.size() || static_cast<size_t>(size) > bytes.size() - at - 4) throw damaged;
    header.attributes.push_back({name, type, bytes.substr(at + 4, static_cast<size_t>(size))});
    at += 4 + static_cast<size_t>(size);
  }
  header.end = at;
  return header;
}

// --- reading ---------------------------------------------------------------------------------------------------------

// Each channel: its name, a zero, 16 bytes.
static std::vector<std::string> channel_names(const std::string& list) {
  std::vector<std::string> names;
  for (size_t at = 0; at < list.size() && list[at] != 0;) {
    const size_t end = list.find('\0', at);
    if (end == std::string::npos) break;
    names.push_back(list.substr(at, end - at));
    at = end + 1 + 16;
  }
  return names;
}

static void add_numbers(FileInfo& info, const ExrAttribute& attribute, size_t count) {
  std::vector<float>& numbers = info.numbers[attribute.name];
  for (size_t i = 0; i < count; i++) numbers.push_back(number_at<float>(attribute.value, 4 * i));
}

FileInfo exr_info(const ExrHeader& header) {
  FileInfo info;
  info.is_float = true;
  for (const ExrAttribute& each : header.attributes) {
    if (each.name == "channels") info.channels = channel_names(each.value);
    if (each.name == "displayWindow" && each.value.size() == 16) {
      const auto side = [&](size_t low, size_t high) {
        const int64_t pixels = int64_t{number_at<int32_t>(each.value, high)} - number_at<int32_t>(each.value, low) + 1;
        return static_cast<int>(std::clamp<int64_t>(pixels, 0, kMaxSide));
      };
      info.width = side(0, 8);
      info.height = side(4, 12);
    }
    if (each.type == "string") info.text[each.name] = each.value;
    if (each.type == "float") add_numbers(info, each, 1);
    if (each.type == "v2f") add_numbers(info, each, 2);
    if (each.type == "v3f") add_numbers(info, each, 3);
    if (each.type == "int") info.numbers[each.name] = {static_cast<float>(number_at<int32_t>(each.value, 0))};
    if (each.type == "envmap" && each.value == std::string(1, '\0')) info.text["textureformat"] = "LatLong Environment";
  }
  return info;
}

// --- writing ---------------------------------------------------------------------------------------------------------

static std::string sized(const std::string& bytes) {
  const int32_t size = static_cast<int32_t>(bytes.size());
  return bytes_of(&size, 1) + bytes;
}

ExrAttribute exr_attribute(const Attribute& attribute) {
  if (const int* i = std::get_if<int>(&attribute.value)) return {attribute.name, "int", bytes_of(i, 1)};
  if (const float* f = std::get_if<float>(&attribute.value)) return {attribute.name, "float", bytes_of(f, 1)};
  if (const std::string* s = std::get_if<std::string>(&attribute.value)) return {attribute.name, "string", *s};
  if (const auto* floats = std::get_if<std::vector<float>>(&attribute.value)) {
    assert(floats->size() == 2 || floats->size() == 3);
    return {attribute.name, floats->size() == 2 ? "v2f" : "v3f", bytes_of(floats->data(), floats->size())};
  }
  std::string words;
  for (const std::string& word : std::get<std::vector<std::string>>(attribute.value)) words += sized(word);
  return {attribute.name, "stringvector", words};
}

std::string exr_checksum(const ExrHeader& header) {
  uint32_t checksum = 0;
  for (const ExrAttribute& each : header.attributes) {
    if (each.name == kExrChecksum) continue;
    checksum = crc32(each.name + '\0' + each.type + '\0' + sized(each.value), checksum);
  }
  return fmt::format("{:08x}", checksum);
}

// The offset table ends at the start of the earliest chunk, which need not be the first one in the table.
static std::vector<uint64_t> read_offsets(const FileInput& file, uint64_t at) {
  constexpr uint64_t kPiece = 8192;  // offsets
  const Error damaged = unusable(file, "the EXR's offsets are damaged, as if it was never finished");
  std::vector<uint64_t> offsets;
  uint64_t first = file.size();
  for (; at + kExrOffsetSize * offsets.size() < first;) {
    const uint64_t from = at + kExrOffsetSize * offsets.size();
    const std::string bytes = file.read(from, std::min(kPiece, (first - from) / kExrOffsetSize) * kExrOffsetSize);
    if (bytes.empty()) throw damaged;
    for (size_t i = 0; i < bytes.size() && at + kExrOffsetSize * offsets.size() < first; i += kExrOffsetSize) {
      offsets.push_back(number_at<uint64_t>(bytes, i));
      if (offsets.back() < at + kExrOffsetSize * offsets.size() || offsets.back() >= file.size()) throw damaged;
      first = std::min(first, offsets.back());
    }
  }
  if (offsets.empty() || at + kExrOffsetSize * offsets.size() != first) throw damaged;
  return offsets;
}

void write_exr_header(const FileInput& file, AtomicFile& to, const ExrHeader& header) {
  std::vector<uint64_t> offsets = read_offsets(file, header.end);
  const uint64_t chunks = header.end + kExrOffsetSize * offsets.size();
  std::string bytes = file.read(0, kStart);
  for (const ExrAttribute& each : header.attributes) {
    bytes += each.name + '\0' + each.type + '\0' + sized(each.value);
  }
  bytes += '\0';
  for (uint64_t& offset : offsets) offset = offset - header.end + bytes.size();
  append(to, bytes + bytes_of(offsets.data(), offsets.size()));
  file.copy(chunks, file.size() - chunks, to);
}

}  // namespace ods
