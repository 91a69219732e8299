// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The items of a HEIF file (pictures, Exif) byte by byte. Sources: ISO/IEC 14496-12, 8.11 (meta box); ISO/IEC 23008-12,
// "Image File Format". The box `meta` must be open: open_box(meta, 4). All functions throw MalformedFile.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/image/format/boxes.h"

namespace ods {

// The item that programs display.
uint32_t heif_primary(const Box& meta);

struct HeifItemType {
  uint32_t item = 0;
  BoxType type = 0;
};
std::vector<HeifItemType> heif_item_types(Box& meta);

// Properties of an item, or of a group of items, in the order in which they apply.
struct HeifProperty {
  const Box* box = nullptr;
  bool is_essential = false;  // readers that do not know it must not show the item
};
std::vector<HeifProperty> heif_properties(Box& meta, uint32_t item);

// One of the references of an item to others: `dimg` (its parts), `auxl`, `cdsc`.
struct HeifReference {
  BoxType type = 0;
  uint32_t from = 0;
  std::vector<uint32_t> to;
};
std::vector<HeifReference> heif_references(Box& meta);

// The bytes of an item. `read` returns bytes of the file. Throws MalformedFile also for more than `most` bytes.
using ReadBytes = std::function<std::string(uint64_t offset, uint64_t count)>;
std::string heif_item_bytes(const Box& meta, uint32_t item, const ReadBytes& read, uint64_t most);

// Apple's names of properties that its writers use for the contents of `cmin` and `cmex`, and for the disparity
// adjustment of a stereo pair, for which ISO has none. Read from a file that Apple's Image I/O wrote.
inline constexpr std::string_view kAppleIntrinsics = "\x22\xcc\x04\xc7\xd6\xd9\x4e\x07\x9d\x90\x4e\xb6\xec\xba\xf3\xa3";
inline constexpr std::string_view kAppleExtrinsics = "\x43\x63\xe9\x14\x5b\x7d\x4a\xab\x97\xae\xbe\xa6\x98\x03\xb4\x34";
inline constexpr std::string_view kAppleDisparity = "\xde\x22\x50\x85\x36\xcb\x43\x65\x87\x43\x2f\x87\x05\xe7\xc7\x8a";

// The contents of a property with this type or, in a box `uuid`, with Apple's name for it. Returns nullopt for others.
std::optional<std::string_view> heif_property_body(const Box& property, BoxType type, std::string_view apples);

}  // namespace ods
