// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/heif_items.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "ods/image/format/boxes.h"

namespace ods {

static uint32_t read_primary(const Box& meta) {
  const Box* primary = find_child(meta, box_type("pitm"));
  if (primary == nullptr) throw MalformedFile("it names no picture to show");
  const size_t bytes = get_number(primary->body, 0, 1) == 0 ? 2 : 4;
  return static_cast<uint32_t>(get_number(primary->body, 4, bytes));
}

// The pictures of the left and the right eye in the first stereo group.
static std::vector<uint32_t> read_pair(Box& meta) {
  Box* groups = find_child(meta, box_type("grpl"));
  if (groups == nullptr) return {};
  open_box(*groups, 0);
  for (const Box& group : groups->children) {
    if (group.type != box_type("ster") || get_number(group.body, 8, 4) != 2) continue;
    return {static_cast<uint32_t>(get_number(group.body, 12, 4)), static_cast<uint32_t>(get_number(group.body, 16, 4))};
  }
  return {};
}

// Pictures that consist of others: grids of tiles, overlays.
using Parts = std::map<uint32_t, std::vector<uint32_t>>;

static Parts read_parts(Box& meta) {
  Box* references = find_child(meta, box_type("iref"));
  if (references == nullptr) return {};
  open_box(*references, 4);
  const size_t bytes = get_number(references->body, 0, 1) == 0 ? 2 : 4;
  Parts parts;
  for (const Box& each : references->children) {
    if (each.type != box_type("dimg")) continue;
    std::vector<uint32_t>& to = parts[static_cast<uint32_t>(get_number(each.body, 0, bytes))];
    const uint64_t count = get_number(each.body, bytes, 2);
    for (uint64_t i = 0; i < count; i++) {
      to.push_back(static_cast<uint32_t>(get_number(each.body, bytes + 2 + i * bytes, bytes)));
    }
  }
  return parts;
}

// A few hundred bytes can request billions of tiles, or a grid of itself, which decoders would follow.
static void count_parts(const Parts& parts, uint32_t item, int depth, int& count) {
  constexpr int kDeepest = 4, kMax = 1 << 18;
  if (depth > kDeepest) throw MalformedFile("its pictures are made of each other, again and again");
  if (++count > kMax) throw MalformedFile("its pictures are made of too many others");
  const auto found = parts.find(item);
  if (found == parts.end()) return;
  for (const uint32_t part : found->second) count_parts(parts, part, depth + 1, count);
}

static void check_parts(Box& meta) {
  const Parts parts = read_parts(meta);
  int count = 0;
  for (const auto& [item, of] : parts) count_parts(parts, item, 0, count);
}

// The indices of an item's properties, from 1.
static std::vector<size_t> properties_of(const Box& associations, uint32_t item) {
  const std::string& body = associations.body;
  const uint64_t version = get_number(body, 0, 1), flags = get_number(body, 1, 3), count = get_number(body, 4, 4);
  const size_t id_bytes = version == 0 ? 2 : 4, bytes = (flags & 1) != 0 ? 2 : 1;
  size_t at = 8;
  std::vector<size_t> numbers;
  for (uint64_t i = 0; i < count; i++) {
    const uint64_t id = get_number(body, at, id_bytes), own = get_number(body, at + id_bytes, 1);
    at += id_bytes + 1;
    for (uint64_t k = 0; k < own; k++, at += bytes) {
      const uint64_t number = get_number(body, at, bytes) & (bytes == 2 ? 0x7fff : 0x7f);  // other bit: essential
      if (id == item) numbers.push_back(number);
    }
  }
  return numbers;
}

static void read_color(const Box& property, HeifItems& items) {
  const std::string kind = property.body.substr(0, 4);
  if (kind == "prof" || kind == "rICC") items.icc = property.body.substr(4);
  if (kind == "nclx") {
    const auto word = [&](size_t at) { return static_cast<uint16_t>(get_number(property.body, at, 2)); };
    items.color = {word(4), word(6)};
  }
}

// The focal length is relative to the picture's width.
static void read_camera(std::string_view body, HeifItems& items) {
  const uint64_t flags = get_number(body, 1, 3);
  const double unit = std::exp2(static_cast<double>(flags >> 8 & 0x1f));
  const auto focal = static_cast<int32_t>(static_cast<uint32_t>(get_number(body, 4, 4)));
  const double widths = focal / unit;
  if (widths > 0.05 && widths < 100.0) {
    items.fov = static_cast<float>(2.0 * std::atan(0.5 / widths) * 180.0 / std::numbers::pi);
  }
}

static void read_property(const Box& property, HeifItems& items) {
  if (property.type == box_type("colr")) read_color(property, items);
  // visionOS 1 wrote the contents of `cmin` with a name of its own.
  constexpr std::string_view kCameraId = "\x22\xcc\x04\xc7\xd6\xd9\x4e\x07\x9d\x90\x4e\xb6\xec\xba\xf3\xa3";
  if (property.type == box_type("cmin")) read_camera(property.body, items);
  if (property.type == box_type("uuid") && property.body.starts_with(kCameraId))
    read_camera(std::string_view(property.body).substr(kCameraId.size()), items);
}

static void read_properties(Box& meta, HeifItems& items) {
  Box* found = find_child(meta, box_type("iprp"));
  if (found == nullptr) return;
  open_box(*found, 0);
  const Box& all = open_child(*found, box_type("ipco"));
  for (const Box& box : found->children) {
    if (box.type != box_type("ipma")) continue;
    for (const size_t number : properties_of(box, items.primary)) {
      if (number >= 1 && number <= all.children.size()) read_property(all.children[number - 1], items);
    }
  }
  if (!items.icc.empty() || items.color) return;
  for (const Box& property : all.children) {  // for a grid, some programs describe only the tiles
    if (property.type == box_type("colr")) return read_color(property, items);
  }
}

HeifItems read_heif_items(const FileInput& file) {
  const std::vector<FileBox> boxes = scan_boxes(file);
  const auto found =
      std::find_if(boxes.begin(), boxes.end(), [](const FileBox& box) { return box.type == box_type("meta"); });
  if (found == boxes.end()) throw MalformedFile("it has no list of pictures (meta)");
  Box meta = read_box(file, *found);
  open_box(meta, 4);
  HeifItems items;
  items.primary = read_primary(meta);
  items.pair = read_pair(meta);
  if (!items.pair.empty()) items.primary = items.pair[0];
  check_parts(meta);
  read_properties(meta, items);
  return items;
}

}  // namespace ods
