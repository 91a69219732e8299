// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/box_offsets.h"

#include <algorithm>

namespace ods {

uint64_t Move::operator()(uint64_t offset) const {
  if (offset > file_size) throw MalformedFile("it is truncated: its samples extend past its end");
  if (offset <= begin) return offset;
  if (offset < end) throw MalformedFile("its offsets point into its own header");
  return offset + static_cast<uint64_t>(growth);
}

// --- tables of a track -----------------------------------------------------------------------------------------------

namespace {

// Entries that follow their count and fill the rest of the box.
struct OffsetTable {
  size_t first;  // byte
  size_t width;
  size_t count;
};

}  // namespace

static OffsetTable table_of(const Box& box) {
  OffsetTable table{8, box.type == box_type("co64") ? size_t{8} : size_t{4}, 0};
  if (box.type == box_type("saio")) {
    table.width = get_number(box.body, 0, 1) == 0 ? 4 : 8;
    if ((get_number(box.body, 3, 1) & 1) != 0) table.first += 8;  // type of the auxiliary information
  }
  table.count = get_number(box.body, table.first - 4, 4);
  if (table.count > (box.body.size() - table.first) / table.width)
    throw MalformedFile("a table of its offsets is cut short");
  return table;
}

static bool is_table(const Box& box) {
  return box.type == box_type("stco") || box.type == box_type("co64") || box.type == box_type("saio");
}

static uint64_t largest(const Box& box, const Move& move) {
  const OffsetTable table = table_of(box);
  uint64_t result = 0;
  for (size_t i = 0; i < table.count; i++) {
    result = std::max(result, move(get_number(box.body, table.first + i * table.width, table.width)));
  }
  return result;
}

static void widen(Box& box) {
  const OffsetTable table = table_of(box);
  std::string body = box.body.substr(0, table.first);
  for (size_t i = 0; i < table.count; i++) append_number(body, get_number(box.body, table.first + 4 * i, 4), 8);
  box.type = box_type("co64");
  box.body = std::move(body);
}

bool widen_offsets(Box& sample_table, const Move& move) {
  bool widened = false;
  for (Box& box : sample_table.children) {
    if (box.type != box_type("stco") || largest(box, move) <= 0xffffffff) continue;
    widen(box);
    widened = true;
  }
  return widened;
}

void move_offsets(Box& sample_table, const Move& move) {
  for (Box& box : sample_table.children) {
    if (!is_table(box)) continue;
    const OffsetTable table = table_of(box);
    for (size_t i = 0; i < table.count; i++) {
      const size_t at = table.first + i * table.width;
      set_number(box.body, at, move(get_number(box.body, at, table.width)), table.width);
    }
  }
}

// --- fragments -------------------------------------------------------------------------------------------------------

// Moves tfhd if it has a base offset; without one, offsets count from the fragment, which moves as a whole.
static void move_fragment(Box& moof, const Move& move) {
  open_box(moof, 0);
  for (Box& track : moof.children) {
    if (track.type != box_type("traf")) continue;
    open_box(track, 0);
    Box* header = find_child(track, box_type("tfhd"));
    if (header == nullptr) throw MalformedFile("one of its fragments has no header");
    const bool has_base = (get_number(header->body, 3, 1) & 1) != 0;
    if (has_base) set_number(header->body, 8, move(get_number(header->body, 8, 8)), 8);
  }
}

// Updates an index of sizes of consecutive pieces, counted from the end of the box plus an offset.
static void move_index(Box& sidx, const FileBox& place, const Move& move) {
  const size_t width = get_number(sidx.body, 0, 1) == 0 ? 4 : 8;
  const size_t first = 12 + width;
  const size_t count = get_number(sidx.body, first + width + 2, 2);
  uint64_t at = place.end();
  const uint64_t skipped = get_number(sidx.body, first, width);
  if (skipped > move.file_size) throw MalformedFile("its index points past its end");
  set_number(sidx.body, first, move(at + skipped) - move(at), width);
  at += skipped;
  for (size_t i = 0; i < count; i++) {
    const size_t entry = first + width + 4 + 12 * i;
    const uint64_t word = get_number(sidx.body, entry, 4);
    const uint64_t size = word & 0x7fffffff;
    const uint64_t moved = move(at + size) - move(at);
    if (moved > 0x7fffffff) throw MalformedFile("a piece in its index would become too large for its field");
    set_number(sidx.body, entry, (word & 0x80000000) | moved, 4);
    at += size;
  }
}

static void move_random_access(Box& mfra, const Move& move) {
  open_box(mfra, 0);
  for (Box& table : mfra.children) {
    if (table.type != box_type("tfra")) continue;
    const size_t width = get_number(table.body, 0, 1) == 0 ? 4 : 8;
    const uint64_t lengths = get_number(table.body, 8, 4);
    const size_t entry = 2 * width + (lengths >> 4 & 3) + (lengths >> 2 & 3) + (lengths & 3) + 3;
    const size_t count = get_number(table.body, 12, 4);
    if (count > (table.body.size() - 16) / entry) throw MalformedFile("a table of its offsets is cut short");
    for (size_t i = 0; i < count; i++) {
      const size_t at = 16 + i * entry + width;
      set_number(table.body, at, move(get_number(table.body, at, width)), width);
    }
  }
}

// --- items -----------------------------------------------------------------------------------------------------------

namespace {

// One item of iloc. If its extents have a common base, only the base is changed.
class ItemLocations {
 public:
  ItemLocations(std::string& body, const Move& move) : body_(body), move_(move) {
    version_ = take(1);
    at_ = 4;
    const uint64_t sizes = take(2);
    offset_width_ = sizes >> 12, length_width_ = sizes >> 8 & 15, base_width_ = sizes >> 4 & 15;
    index_width_ = version_ == 0 ? 0 : sizes & 15;
    for (size_t width : {offset_width_, length_width_, base_width_, index_width_}) {
      if (width != 0 && width != 4 && width != 8) throw MalformedFile("its list of items is invalid");
    }
    const uint64_t count = take(version_ < 2 ? 2 : 4);
    for (uint64_t i = 0; i < count; i++) move_item();
  }

 private:
  uint64_t take(size_t width) {
    at_ += width;
    return get_number(body_, at_ - width, width);
  }

  void move_item() {
    take(version_ < 2 ? 2 : 4);                                // its item number
    const uint64_t method = version_ == 0 ? 0 : take(2) & 15;  // 0: in the file
    const bool in_this_file = take(2) == 0 && method == 0;     // without a data reference
    const size_t base_at = at_;
    const uint64_t base = take(base_width_);
    const uint64_t extents = take(2);
    int64_t all = 0;
    for (uint64_t i = 0; i < extents; i++) {
      take(index_width_);
      const size_t offset_at = at_;
      const uint64_t offset = base + take(offset_width_);
      take(length_width_);
      if (!in_this_file || base_width_ + offset_width_ == 0) continue;
      const int64_t moved = static_cast<int64_t>(move_(offset) - offset);
      if (base_width_ == 0) set_number(body_, offset_at, offset + static_cast<uint64_t>(moved), offset_width_);
      if (base_width_ != 0 && i > 0 && moved != all) throw MalformedFile("an item in it would be split");
      all = moved;
    }
    if (base_width_ != 0) set_number(body_, base_at, base + static_cast<uint64_t>(all), base_width_);
  }

  std::string& body_;
  const Move& move_;
  size_t at_ = 0;
  uint64_t version_ = 0;
  size_t offset_width_ = 0, length_width_ = 0, base_width_ = 0, index_width_ = 0;
};

}  // namespace

void move_item_offsets(Box& meta, const Move& move) {
  // QuickTime's meta has no version before its boxes.
  const bool is_quicktime = meta.body.size() >= 8 && get_number(meta.body, 4, 4) == box_type("hdlr");
  open_box(meta, is_quicktime ? 0 : 4);
  if (Box* items = find_child(meta, box_type("iloc"))) ItemLocations(items->body, move);
}

// --- boxes of the file -----------------------------------------------------------------------------------------------

bool may_have_offsets(BoxType type) {
  return type == box_type("moof") || type == box_type("sidx") || type == box_type("mfra") || type == box_type("meta");
}

void move_offsets(Box& box, const FileBox& place, const Move& move) {
  if (box.type == box_type("moof")) move_fragment(box, move);
  if (box.type == box_type("sidx")) move_index(box, place, move);
  if (box.type == box_type("mfra")) move_random_access(box, move);
  if (box.type == box_type("meta")) move_item_offsets(box, move);
}

}  // namespace ods
