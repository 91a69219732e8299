// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/sound_entry.h"

#include <optional>

namespace ods {

void open_sound_entry(Box& entry) {
  const uint64_t version = get_number(entry.body, 8, 2);
  open_box(entry, version == 1 ? 44 : version == 2 ? 64 : 28);
}

namespace {

enum Descriptor : uint64_t { kStream = 3, kDecoder = 4, kSpecific = 5 };

}  // namespace

// Enters a descriptor of this kind: skips its tag and its size, which has 7 bits per byte. Returns false for another
// kind.
static bool enter(std::string_view& bytes, Descriptor tag) {
  if (get_number(bytes, 0, 1) != tag) return false;
  size_t at = 1;
  while (at < 5 && (get_number(bytes, at, 1) & 0x80) != 0) at++;
  bytes.remove_prefix(at + 1);
  return true;
}

static void skip(std::string_view& bytes, size_t count) {
  if (count > bytes.size()) throw MalformedFile("an esds is cut short");
  bytes.remove_prefix(count);
}

// AudioSpecificConfig: 5 bits type, 4 rate, 4 channels; type and rate are longer if all their bits are set.
static int aac_channels(std::string_view bytes) {
  constexpr int kChannels[] = {0, 1, 2, 3, 4, 5, 6, 8};
  uint64_t bits = 0;
  for (size_t i = 0; i < 8; i++) bits = bits << 8 | (i < bytes.size() ? get_number(bytes, i, 1) : 0);
  int at = 0;
  const auto take = [&](int count) {
    at += count;
    return bits >> (64 - at) & ((uint64_t{1} << count) - 1);
  };
  if (take(5) == 31) take(6);
  if (take(4) == 15) take(24);
  const uint64_t channels = take(4);
  return channels < std::size(kChannels) ? kChannels[channels] : 0;
}

static int esds_channels(std::string_view bytes) {
  skip(bytes, 4);  // version and flags
  if (!enter(bytes, kStream)) return 0;
  const uint64_t flags = get_number(bytes, 2, 1);
  skip(bytes, 3);
  if ((flags & 0x80) != 0) skip(bytes, 2);
  if ((flags & 0x40) != 0) skip(bytes, 1 + get_number(bytes, 0, 1));
  if ((flags & 0x20) != 0) skip(bytes, 2);
  if (!enter(bytes, kDecoder)) return 0;
  const bool is_aac = get_number(bytes, 0, 1) == 0x40;
  skip(bytes, 13);
  return is_aac && enter(bytes, kSpecific) ? aac_channels(bytes) : 0;
}

int count_channels(const Box& entry) {
  try {
    if (const Box* esds = find_child(entry, box_type("esds"))) return esds_channels(esds->body);
    const bool is_second = get_number(entry.body, 8, 2) == 2;
    const uint64_t count = is_second ? get_number(entry.body, 40, 4) : get_number(entry.body, 16, 2);
    return count <= 255 ? static_cast<int>(count) : 0;
  } catch (const MalformedFile&) {
    return 0;
  }
}

}  // namespace ods
