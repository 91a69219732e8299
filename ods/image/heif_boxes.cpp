// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/heif_boxes.h"

namespace ods {

static uint32_t number_at(std::string_view bytes, size_t at, size_t count) {
  return static_cast<uint32_t>(get_number(bytes, at, count));
}

uint32_t heif_primary(const Box& meta) {
  const Box* primary = find_child(meta, box_type("pitm"));
  if (primary == nullptr) throw MalformedFile("it names no picture to show");
  return number_at(primary->body, 4, get_number(primary->body, 0, 1) == 0 ? 2 : 4);
}

std::vector<HeifItemType> heif_item_types(Box& meta) {
  Box* list = find_child(meta, box_type("iinf"));
  if (list == nullptr) return {};
  open_box(*list, get_number(list->body, 0, 1) == 0 ? 6 : 8);
  std::vector<HeifItemType> items;
  for (const Box& each : list->children) {
    if (each.type != box_type("infe") || get_number(each.body, 0, 1) < 2) continue;
    const size_t bytes = get_number(each.body, 0, 1) == 2 ? 2 : 4;
    items.push_back({number_at(each.body, 4, bytes), number_at(each.body, 4 + bytes + 2, 4)});
  }
  return items;
}

// The indices of an item's properties, from 1.
static std::vector<std::pair<size_t, bool>> numbers_of(const Box& associations, uint32_t item) {
  const std::string& body = associations.body;
  const uint64_t version = get_number(body, 0, 1), flags = get_number(body, 1, 3), count = get_number(body, 4, 4);
  const size_t id_bytes = version == 0 ? 2 : 4, bytes = (flags & 1) != 0 ? 2 : 1;
  const uint64_t essential = bytes == 2 ? 0x8000 : 0x80;
  size_t at = 8;
  std::vector<std::pair<size_t, bool>> numbers;
  for (uint64_t i = 0; i < count; i++) {
    const uint64_t id = get_number(body, at, id_bytes), own = get_number(body, at + id_bytes, 1);
    at += id_bytes + 1;
    for (uint64_t k = 0; k < own; k++, at += bytes) {
      const uint64_t number = get_number(body, at, bytes);
      if (id == item) numbers.emplace_back(number & (essential - 1), (number & essential) != 0);
    }
  }
  return numbers;
}

std::vector<HeifProperty> heif_properties(Box& meta, uint32_t item) {
  Box* found = find_child(meta, box_type("iprp"));
  if (found == nullptr) return {};
  open_box(*found, 0);
  const Box& all = open_child(*found, box_type("ipco"));
  std::vector<HeifProperty> properties;
  for (const Box& box : found->children) {
    if (box.type != box_type("ipma")) continue;
    for (const auto& [number, is_essential] : numbers_of(box, item)) {
      if (number >= 1 && number <= all.children.size()) properties.push_back({&all.children[number - 1], is_essential});
    }
  }
  return properties;
}

std::vector<HeifReference> heif_references(Box& meta) {
  Box* references = find_child(meta, box_type("iref"));
  if (references == nullptr) return {};
  open_box(*references, 4);
  const size_t bytes = get_number(references->body, 0, 1) == 0 ? 2 : 4;
  std::vector<HeifReference> all;
  for (const Box& each : references->children) {
    HeifReference& one = all.emplace_back(HeifReference{each.type, number_at(each.body, 0, bytes), {}});
    const uint64_t count = get_number(each.body, bytes, 2);
    for (uint64_t i = 0; i < count; i++) one.to.push_back(number_at(each.body, bytes + 2 + i * bytes, bytes));
  }
  return all;
}

namespace {

struct Extent64 {
  uint64_t offset = 0, size = 0;
};

struct ItemPlace {
  uint64_t method = 0;  // 0: in the file, 1: in the box idat
  std::vector<Extent64> extents;
};

// Numbers one after the other.
struct Cursor {
  const std::string& bytes;
  size_t at;
  uint64_t next(size_t count) {
    const uint64_t value = count == 0 ? 0 : get_number(bytes, at, count);
    at += count;
    return value;
  }
};

}  // namespace

static ItemPlace place_of(const Box& places, uint32_t item) {
  Cursor cursor{places.body, 0};
  const uint64_t version = cursor.next(1);
  cursor.next(3);
  const uint64_t sizes = cursor.next(2);
  const size_t offset_bytes = sizes >> 12, length_bytes = sizes >> 8 & 15, base_bytes = sizes >> 4 & 15;
  const size_t index_bytes = version == 0 ? 0 : sizes & 15, id_bytes = version < 2 ? 2 : 4;
  const uint64_t count = cursor.next(id_bytes);
  for (uint64_t i = 0; i < count; i++) {
    const uint64_t id = cursor.next(id_bytes);
    ItemPlace place;
    place.method = version == 0 ? 0 : cursor.next(2) & 15;
    cursor.next(2);
    const uint64_t base = cursor.next(base_bytes), extents = cursor.next(2);
    for (uint64_t k = 0; k < extents; k++) {
      cursor.next(index_bytes);
      const uint64_t offset = cursor.next(offset_bytes);
      place.extents.push_back({base + offset, cursor.next(length_bytes)});
    }
    if (id == item) return place;
  }
  throw MalformedFile("it lists a picture without its place");
}

std::string heif_item_bytes(const Box& meta, uint32_t item, const ReadBytes& read, uint64_t most) {
  const Box* places = find_child(meta, box_type("iloc"));
  if (places == nullptr) throw MalformedFile("it has no list of places (iloc)");
  const ItemPlace place = place_of(*places, item);
  const Box* inside = find_child(meta, box_type("idat"));
  if (place.method > 1 || (place.method == 1 && inside == nullptr)) {
    throw MalformedFile("one of its items is in another place than the file");
  }
  std::string bytes;
  for (const Extent64& each : place.extents) {
    if (each.size > most || bytes.size() + each.size > most) throw MalformedFile("one of its items is too large");
    if (place.method == 0) {
      bytes += read(each.offset, each.size);
      continue;
    }
    if (each.offset > inside->body.size()) throw MalformedFile("one of its items is past the end of its box");
    bytes += inside->body.substr(each.offset, each.size);
  }
  return bytes;
}

std::optional<std::string_view> heif_property_body(const Box& property, BoxType type, std::string_view apples) {
  const std::string_view body = property.body;
  if (property.type == type) return body;
  if (property.type == box_type("uuid") && body.starts_with(apples)) return body.substr(apples.size());
  return std::nullopt;
}

}  // namespace ods
