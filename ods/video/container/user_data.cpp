// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/user_data.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/base/error.h"
#include "ods/files/read_file.h"
#include "ods/video/container/mp4_file.h"

namespace ods {

static bool has_offsets(const Box& meta) {
  return meta.type == box_type("meta") && meta.body.find("iloc") != std::string::npos;
}

bool has_user_data(const std::string& path) {
  const std::vector<unsigned char> start = read_start(path, 16);
  return is_mp4({reinterpret_cast<const char*>(start.data()), start.size()});
}

// A udta that cannot be opened, as some cameras write it, is left out.
static void take(const std::vector<Box>& boxes, std::initializer_list<BoxType> types, std::vector<Box>& to) {
  for (const Box& box : boxes) {
    if (std::find(types.begin(), types.end(), box.type) == types.end() || has_offsets(box)) continue;
    Box copy = box;
    if (box.type == box_type("udta")) {
      try {
        open_box(copy, 0);
      } catch (const MalformedFile&) {
        continue;
      }
      std::erase_if(copy.children, [](const Box& each) { return each.type == box_type("chpl") || has_offsets(each); });
      copy.tail.clear();
      if (copy.children.empty()) continue;
    }
    to.push_back(std::move(copy));
  }
}

static UserData read_boxes(const FileInput& file, uint64_t track) {
  constexpr uint64_t kMax = uint64_t{16} << 20;
  constexpr BoxType kMovie[] = {box_type("moov")};
  UserData data;
  for (const FileBox& box : scan_boxes(file)) {
    const bool is_data = box.type == box_type("meta") || box.type == box_type("uuid");
    if (is_data && box.size <= kMax) {
      take({read_box(file, box)}, {box_type("meta"), box_type("uuid")}, data.file);
    }
    if (box.type != box_type("moov")) continue;
    Box movie = read_box(file, box, kMovie);
    take(movie.children, {box_type("udta"), box_type("meta"), box_type("uuid")}, data.movie);
    for (Box& each : movie.children) {
      if (each.type != box_type("trak")) continue;
      open_box(each, 0);
      if (track_id(each) == track) take(each.children, {box_type("udta"), box_type("meta")}, data.pictures);
    }
  }
  return data;
}

UserData read_user_data(const std::string& path, uint64_t track) {
  if (!has_user_data(path)) return {};
  const FileInput file(path);
  try {
    return read_boxes(file, track);
  } catch (const MalformedFile& broken) {
    throw Error(ErrorKind::kInput, fmt::format("cannot use '{}': {}", path, broken.what()));
  }
}

void add_user_data(const std::vector<Box>& boxes, Box& to) {
  std::vector<Box> old;
  std::swap(old, to.children);
  for (Box& box : old) {
    const bool is_replaced = box.type != box_type("uuid") && box.type != box_type("udta") &&
                             std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) { return b.type == box.type; });
    if (!is_replaced) to.children.push_back(std::move(box));
  }
  for (const Box& box : boxes) {
    Box* there = box.type == box_type("udta") ? find_child(to, box.type) : nullptr;
    if (there == nullptr) {
      to.children.push_back(box);
      continue;
    }
    open_box(*there, 0);
    add_user_data(box.children, *there);
    there->tail.clear();
  }
}

}  // namespace ods
