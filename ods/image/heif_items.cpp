// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/heif_items.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "ods/image/format/boxes.h"
#include "ods/image/heif_boxes.h"

namespace ods {

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
  Parts parts;
  for (const HeifReference& each : heif_references(meta)) {
    if (each.type != box_type("dimg")) continue;
    std::vector<uint32_t>& to = parts[each.from];
    to.insert(to.end(), each.to.begin(), each.to.end());
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
  if (const auto camera = heif_property_body(property, box_type("cmin"), kAppleIntrinsics)) read_camera(*camera, items);
}

// Metres to the right of the coordinates' origin.
static double position_of(Box& meta, uint32_t item) {
  for (const HeifProperty& each : heif_properties(meta, item)) {
    const auto place = heif_property_body(*each.box, box_type("cmex"), kAppleExtrinsics);
    if (!place || (get_number(*place, 1, 3) & 1) == 0) continue;
    return static_cast<int32_t>(static_cast<uint32_t>(get_number(*place, 4, 4))) * 1e-6;
  }
  return 0.0;
}

// Pictures beside the eyes that readers do not show, except alpha.
static int count_others(Box& meta, const HeifItems& items) {
  constexpr int kMost = 16;  // each is a search
  int count = 0;
  for (const HeifReference& each : heif_references(meta)) {
    const bool is_ours = std::ranges::any_of(each.to, [&](uint32_t item) {
      return item == items.primary || std::ranges::find(items.pair, item) != items.pair.end();
    });
    if (each.type != box_type("auxl") || !is_ours) continue;
    const std::vector<HeifProperty> properties = heif_properties(meta, each.from);
    const bool is_alpha = std::ranges::any_of(properties, [](const HeifProperty& property) {
      const std::string& body = property.box->body;
      return property.box->type == box_type("auxC") &&
             (body.find("alpha") != std::string::npos || body.find("hevc:2015:auxid:1") != std::string::npos);
    });
    if (!is_alpha && ++count == kMost) break;
  }
  return count;
}

static double baseline_of(Box& meta, const std::vector<uint32_t>& pair) {
  const double distance = pair.size() == 2 ? position_of(meta, pair[1]) - position_of(meta, pair[0]) : 0.0;
  return distance > 1e-4 && distance < 100.0 ? distance : 0.0;
}

static void read_properties(Box& meta, HeifItems& items) {
  for (const HeifProperty& each : heif_properties(meta, items.primary)) read_property(*each.box, items);
  if (!items.icc.empty() || items.color) return;
  Box* found = find_child(meta, box_type("iprp"));
  if (found == nullptr) return;
  for (const Box& property : open_child(*found, box_type("ipco")).children) {
    // For a grid, some programs describe only the tiles.
    if (property.type == box_type("colr")) return read_color(property, items);
  }
}

static Box open_meta(const FileInput& file) {
  const std::vector<FileBox> boxes = scan_boxes(file);
  const auto found =
      std::find_if(boxes.begin(), boxes.end(), [](const FileBox& box) { return box.type == box_type("meta"); });
  if (found == boxes.end()) throw MalformedFile("it has no list of pictures (meta)");
  Box meta = read_box(file, *found);
  open_box(meta, 4);
  return meta;
}

HeifItems read_heif_items(const FileInput& file) {
  Box meta = open_meta(file);
  HeifItems items;
  items.primary = heif_primary(meta);
  items.pair = read_pair(meta);
  if (!items.pair.empty()) items.primary = items.pair[0];
  check_parts(meta);
  read_properties(meta, items);
  items.baseline = baseline_of(meta, items.pair);
  items.others = count_others(meta, items);
  return items;
}

// The TIFF directory begins so many bytes after this number: Apple writes the prefix of a JPEG's segment between.
std::string read_heif_exif(const FileInput& file, uint64_t most) {
  Box meta = open_meta(file);
  for (const HeifItemType& each : heif_item_types(meta)) {
    if (each.type != box_type("Exif")) continue;
    const ReadBytes read = [&](uint64_t offset, uint64_t count) { return file.read(offset, count); };
    const std::string bytes = heif_item_bytes(meta, each.item, read, most);
    const uint64_t start = 4 + get_number(bytes, 0, 4);
    return start < bytes.size() ? bytes.substr(start) : "";
  }
  return "";
}

}  // namespace ods
