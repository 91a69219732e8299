// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/spatial_photo.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ods/image/heif_boxes.h"

namespace ods {

constexpr uint32_t kLeftItem = 1, kRightItem = 2, kExifItem = 3, kPairGroup = 4;

static std::string number(uint64_t value, size_t count) {
  std::string bytes;
  append_number(bytes, value, count);
  return bytes;
}

static std::string box(BoxType type, const std::string& body) {
  return number(8 + body.size(), 4) + number(type, 4) + body;
}

static std::string full_box(BoxType type, uint64_t version, uint64_t flags, const std::string& body) {
  return box(type, number(version, 1) + number(flags, 3) + body);
}

namespace {

struct StoredProperty {
  std::string bytes;
  bool is_essential = false;
  bool is_turn = false;  // moves pixels; such properties come last
};

// A picture of a file of one picture.
struct HevcPicture {
  std::vector<StoredProperty> properties;
  std::string stream;
};

// The properties of all items, equal ones once, and the numbers of those that each item has.
class PropertyList {
 public:
  void add(uint32_t item, const std::vector<StoredProperty>& properties) {
    std::string numbers;
    for (const StoredProperty& each : properties) {
      auto found = std::ranges::find(all_, each.bytes);
      if (found == all_.end()) found = all_.insert(found, each.bytes);
      numbers += number(static_cast<uint64_t>(found - all_.begin() + 1) | (each.is_essential ? 0x80u : 0u), 1);
    }
    associations_ += number(item, 2) + number(numbers.size(), 1) + numbers;
    items_++;
  }
  std::string box_of_all() const {
    std::string bytes;
    for (const std::string& each : all_) bytes += each;
    return box(box_type("iprp"),
               box(box_type("ipco"), bytes) + full_box(box_type("ipma"), 0, 0, number(items_, 4) + associations_));
  }

 private:
  std::vector<std::string> all_;
  std::string associations_;
  uint64_t items_ = 0;
};

}  // namespace

static bool is_turn(BoxType type) {
  return type == box_type("clap") || type == box_type("irot") || type == box_type("imir");
}

static HevcPicture read_picture(std::string_view file) {
  std::string tail;
  std::vector<Box> boxes = parse_boxes(file, tail);
  const auto meta = std::ranges::find(boxes, box_type("meta"), &Box::type);
  if (meta == boxes.end()) throw MalformedFile("it has no list of pictures (meta)");
  open_box(*meta, 4);
  const uint32_t item = heif_primary(*meta);
  const std::vector<HeifItemType> types = heif_item_types(*meta);
  const auto type = std::ranges::find(types, item, &HeifItemType::item);
  if (type == types.end() || type->type != box_type("hvc1")) throw MalformedFile("its picture is not in HEVC");
  HevcPicture picture;
  for (const HeifProperty& each : heif_properties(*meta, item)) {
    StoredProperty& property = picture.properties.emplace_back();
    write_box(*each.box, property.bytes);
    property.is_essential = each.is_essential, property.is_turn = is_turn(each.box->type);
  }
  const ReadBytes read = [&](uint64_t offset, uint64_t count) {
    if (offset > file.size() || count > file.size() - offset) throw MalformedFile("its picture is cut short");
    return std::string(file.substr(offset, count));
  };
  picture.stream = heif_item_bytes(*meta, item, read, file.size());
  return picture;
}

// Lengths are relative to the picture's width, in units of 2^-30 if the focal length permits.
static std::string intrinsics(double fov) {
  const double focal = 0.5 / std::tan(fov * std::numbers::pi / 360.0);
  int shift = 30;
  while (shift > 0 && std::round(std::ldexp(focal, shift)) > std::numeric_limits<int32_t>::max()) shift--;
  const uint64_t middle = uint64_t{1} << (shift - 1);
  return number(static_cast<uint64_t>(shift) << 8, 4) +
         number(static_cast<uint64_t>(std::llround(std::ldexp(focal, shift))), 4) + number(middle, 4) +
         number(middle, 4);
}

// Micrometres to the right of the left camera. The flag 0x10 is the size of the numbers of a rotation, which is not
// there: none.
static std::string extrinsics(double metres) {
  const auto micrometres = static_cast<uint64_t>(std::llround(metres * 1e6));
  return micrometres == 0 ? number(0x10, 4) : number(0x11, 4) + number(micrometres, 4);
}

static StoredProperty apples(std::string_view name, const std::string& contents) {
  return {box(box_type("uuid"), std::string(name) + contents)};
}

static std::string properties_of(const std::array<HevcPicture, 2>& eyes, const SpatialCameras& cameras) {
  const StoredProperty adjustment = apples(kAppleDisparity, number(0, 4));
  PropertyList list;
  for (const uint32_t item : {kLeftItem, kRightItem}) {
    std::vector<StoredProperty> own = eyes[item - kLeftItem].properties;
    own.push_back(apples(kAppleExtrinsics, extrinsics(item == kLeftItem ? 0.0 : cameras.baseline)));
    own.push_back(apples(kAppleIntrinsics, intrinsics(cameras.fov)));
    own.push_back(adjustment);
    std::stable_partition(own.begin(), own.end(), [](const StoredProperty& each) { return !each.is_turn; });
    list.add(item, own);
  }
  list.add(kPairGroup, {adjustment});
  return list.box_of_all();
}

static std::string item_entry(uint32_t item, BoxType type) {
  return full_box(box_type("infe"), 2, 0, number(item, 2) + number(0, 2) + number(type, 4) + number(0, 1));
}

static std::string items_of(bool has_exif) {
  std::string entries = item_entry(kLeftItem, box_type("hvc1")) + item_entry(kRightItem, box_type("hvc1"));
  if (has_exif) entries += item_entry(kExifItem, box_type("Exif"));
  return full_box(box_type("iinf"), 0, 0, number(has_exif ? 3 : 2, 2) + entries);
}

// One after the other from `start` on.
static std::string places_of(const std::vector<std::string>& items, uint64_t start) {
  std::string entries;
  for (size_t i = 0; i < items.size(); i++) {
    entries += number(kLeftItem + i, 2) + number(0, 2) + number(1, 2) + number(start, 4) + number(items[i].size(), 4);
    start += items[i].size();
  }
  return full_box(box_type("iloc"), 0, 0, number(0x4400, 2) + number(items.size(), 2) + entries);
}

std::string make_spatial_photo(std::string_view left, std::string_view right, const SpatialCameras& cameras,
                               std::string_view exif) {
  assert(cameras.fov > 0.0 && cameras.fov < 180.0 && cameras.baseline > 0.0);
  const std::array<HevcPicture, 2> eyes = {read_picture(left), read_picture(right)};
  std::vector<std::string> items = {eyes[0].stream, eyes[1].stream};
  // Apple's programs put the prefix of a JPEG's segment before the directory.
  if (!exif.empty()) items.push_back(number(6, 4) + std::string("Exif\0\0", 6) + std::string(exif));
  const std::string type = box(box_type("ftyp"), "heic" + number(0, 4) + "mif1" + "miaf" + "heic");
  const auto meta = [&](uint64_t start) {
    std::string body = full_box(box_type("hdlr"), 0, 0, number(0, 4) + "pict" + std::string(13, '\0')) +
                       full_box(box_type("pitm"), 0, 0, number(kLeftItem, 2)) + places_of(items, start) +
                       items_of(!exif.empty());
    if (!exif.empty()) {
      const std::string eyes_of_it = number(2, 2) + number(kLeftItem, 2) + number(kRightItem, 2);
      body += full_box(box_type("iref"), 0, 0, box(box_type("cdsc"), number(kExifItem, 2) + eyes_of_it));
    }
    const std::string pair = number(kPairGroup, 4) + number(2, 4) + number(kLeftItem, 4) + number(kRightItem, 4);
    body += properties_of(eyes, cameras) + box(box_type("grpl"), full_box(box_type("ster"), 0, 0, pair));
    return full_box(box_type("meta"), 0, 0, body);
  };
  std::string file = type + meta(type.size() + meta(0).size() + 8);
  std::string pixels;
  for (const std::string& each : items) pixels += each;
  return file + box(box_type("mdat"), pixels);
}

}  // namespace ods
