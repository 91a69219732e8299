// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes in HEIF files that phones write, but heif-enc does not.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "ods/base/bytes.h"
#include "ods/image/format/boxes.h"
#include "tests/support/made_videos.h"

namespace ods {

// Adds boxes to `meta`, and updates the positions of the pixels, which are absolute (iloc).
inline std::string with_meta(const std::string& file, const std::string& added, const std::string& property = "") {
  std::string tail, result = file;
  size_t at = 0;
  while (file.substr(at + 4, 4) != "meta") at += get_number(file, at, 4);
  Box meta = std::move(parse_boxes(std::string_view(file).substr(at, get_number(file, at, 4)), tail)[0]);
  open_box(meta, 4);
  size_t grown = added.size();
  if (!property.empty()) {
    Box& properties = open_child(meta, box_type("iprp"));
    Box& all = open_child(properties, box_type("ipco"));
    Box box;
    all.children.push_back(parse_boxes(property, tail)[0]);
    const size_t index = all.children.size();
    Box& associations = *find_child(properties, box_type("ipma"));
    std::string& body = associations.body;  // version 0 and small numbers, as written by heif-enc
    size_t entry = 8;
    for (uint64_t i = 0; i < get_number(body, 4, 4); i++) {
      const uint64_t count = get_number(body, entry + 2, 1);
      set_number(body, entry + 2, count + 1, 1);
      body.insert(entry + 3 + count, 1, static_cast<char>(index));
      entry += 4 + count;
      grown++;
    }
    grown += property.size();
  }
  Box* places = find_child(meta, box_type("iloc"));
  std::string& iloc = places->body;
  const uint64_t version = get_number(iloc, 0, 1);
  EXPECT_LE(version, 1u);
  const uint64_t sizes = get_number(iloc, 4, 2), offset_size = sizes >> 12, length_size = sizes >> 8 & 15,
                 base_size = sizes >> 4 & 15;
  size_t item = 8;
  for (uint64_t i = 0; i < get_number(iloc, 6, 2); i++) {
    item += version == 1 ? 4 : 2;
    item += 2;
    if (base_size > 0)
      set_number(iloc, item, get_number(iloc, item, base_size) + (get_number(iloc, item, base_size) > 0 ? grown : 0),
                 base_size);
    const bool has_base = base_size > 0 && get_number(iloc, item, base_size) > 0;
    item += base_size;
    const uint64_t extents = get_number(iloc, item, 2);
    item += 2;
    for (uint64_t k = 0; k < extents; k++) {
      if (!has_base) set_number(iloc, item, get_number(iloc, item, offset_size) + grown, offset_size);
      item += offset_size + length_size;
    }
  }
  std::string bytes;
  write_box(meta, bytes);
  bytes += added;
  set_number(bytes, 0, bytes.size(), 4);
  return result.replace(at, get_number(file, at, 4), bytes);
}

}  // namespace ods
