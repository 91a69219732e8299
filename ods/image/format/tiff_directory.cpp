// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/tiff_directory.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/bytes.h"
#include "ods/base/error.h"

namespace ods {

static Error damaged(const FileInput& file) {
  return Error(ErrorKind::kInput, fmt::format("cannot use '{}': the TIFF is cut short or damaged", file.path()));
}

static uint64_t number_of(std::string_view bytes, bool is_little) {
  return get_number(bytes, 0, bytes.size(), is_little ? std::endian::little : std::endian::big);
}

static std::string bytes_of(uint64_t value, size_t count, bool is_little) {
  std::string bytes(count, '\0');
  for (size_t i = 0; i < count; i++) {
    bytes[is_little ? i : count - 1 - i] = static_cast<char>(value >> (8 * i) & 0xff);
  }
  return bytes;
}

// The number of bytes in an offset, and in a count.
static size_t offset_size(const TiffDirectory& directory) {
  return directory.is_big ? 8 : 4;
}

// The file position of the first directory's offset.
static size_t first_offset(const TiffDirectory& directory) {
  return directory.is_big ? 8 : 4;
}

TiffDirectory read_tiff_directory(const FileInput& file) {
  constexpr uint64_t kMax = 65535;
  if (file.size() < 16) throw damaged(file);
  const std::string start = file.read(0, 16);
  TiffDirectory directory;
  directory.is_little = start[0] == 'I';
  directory.is_big = number_of(start.substr(2, 2), directory.is_little) == 43;
  const size_t size = offset_size(directory), count_size = directory.is_big ? 8 : 2, entry_size = 4 + 2 * size;
  const auto number = [&](std::string_view bytes) { return number_of(bytes, directory.is_little); };
  const uint64_t at = number(std::string_view(start).substr(first_offset(directory), size));
  if (at < first_offset(directory) + size || at > file.size() || count_size > file.size() - at) throw damaged(file);
  const uint64_t count = number(file.read(at, count_size));
  if (count > kMax || count * entry_size + size > file.size() - at - count_size) throw damaged(file);
  const std::string bytes = file.read(at + count_size, count * entry_size + size);
  const std::string_view view = bytes;
  for (size_t i = 0; i < count; i++) {
    const std::string_view entry = view.substr(i * entry_size, entry_size);
    directory.entries.push_back({static_cast<uint16_t>(number(entry.substr(0, 2))),
                                 static_cast<uint16_t>(number(entry.substr(2, 2))), number(entry.substr(4, size)),
                                 std::string(entry.substr(4 + size))});
  }
  directory.next = number(view.substr(count * entry_size));
  return directory;
}

// The size of a value type; 0 if unknown.
static size_t type_size(uint16_t type) {
  constexpr size_t kSizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
  return type < std::size(kSizes) ? kSizes[type] : 0;
}

static const TiffEntry* find_entry(const TiffDirectory& directory, uint16_t tag) {
  const auto found = std::find_if(directory.entries.begin(), directory.entries.end(),
                                  [&](const TiffEntry& entry) { return entry.tag == tag; });
  return found == directory.entries.end() ? nullptr : &*found;
}

std::optional<std::string> tiff_value(const FileInput& file, const TiffDirectory& directory, uint16_t tag,
                                      uint64_t maximum) {
  const TiffEntry* entry = find_entry(directory, tag);
  if (entry == nullptr || type_size(entry->type) == 0 || entry->count > maximum / type_size(entry->type)) return {};
  const uint64_t size = entry->count * type_size(entry->type);
  if (size <= entry->place.size()) return entry->place.substr(0, size);
  const uint64_t at = number_of(entry->place, directory.is_little);
  if (at > file.size() || size > file.size() - at) return {};
  return file.read(at, size);
}

std::optional<uint64_t> tiff_number(const FileInput& file, const TiffDirectory& directory, uint16_t tag) {
  const TiffEntry* entry = find_entry(directory, tag);
  const std::optional<std::string> value = tiff_value(file, directory, tag, 8);
  if (!value || entry->count == 0) return std::nullopt;
  return number_of(value->substr(0, type_size(entry->type)), directory.is_little);
}

static void replace_entry(TiffDirectory& directory, const TiffEntry& entry) {
  std::erase_if(directory.entries, [&](const TiffEntry& each) { return each.tag == entry.tag; });
  if (entry.count == 0) return;
  const auto place = std::find_if(directory.entries.begin(), directory.entries.end(),
                                  [&](const TiffEntry& each) { return each.tag > entry.tag; });
  directory.entries.insert(place, entry);
}

void write_tiff_value(const FileInput& file, AtomicFile& to, TiffDirectory directory, uint16_t tag,
                      const std::string& bytes) {
  constexpr uint64_t kLongest = 0xffffffff, kByteType = 1;
  const size_t size = offset_size(directory);
  const auto number = [&](uint64_t value, size_t count) { return bytes_of(value, count, directory.is_little); };
  const auto aligned = [](uint64_t at) { return (at + 7) / 8 * 8; };
  const uint64_t value_at = aligned(file.size()), directory_at = aligned(value_at + bytes.size());
  std::string place = bytes.size() > size ? number(value_at, size) : bytes;
  place.resize(size);
  replace_entry(directory, {tag, kByteType, bytes.size(), place});
  const uint64_t length = 8 + directory.entries.size() * (4 + 2 * size) + size;
  if (!directory.is_big && (directory_at > kLongest || length > kLongest - directory_at)) {
    throw Error(ErrorKind::kInput,
                fmt::format("cannot tag '{}': a TIFF has at most 4 GiB; save it as a BigTIFF first", file.path()));
  }
  std::string end(value_at - file.size(), '\0');
  end += bytes;
  end.resize(directory_at - file.size());
  end += number(directory.entries.size(), directory.is_big ? 8 : 2);
  for (const TiffEntry& entry : directory.entries) {
    end += number(entry.tag, 2) + number(entry.type, 2) + number(entry.count, size) + entry.place;
  }
  end += number(directory.next, size);
  const uint64_t first = first_offset(directory);
  file.copy(0, first, to);
  append(to, number(directory_at, size));
  file.copy(first + size, file.size() - first - size, to);
  append(to, end);
}

}  // namespace ods
