// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes, of which mp4 and mov files consist: a size, a type of four letters, a body, which may hold boxes again.
// Source: ISO/IEC 14496-12 (ISO base media file format), 4.2; Apple, "QuickTime File Format" for how lists end there.
//
// A size in a file is believed only as far as what holds the box reaches. Boxes are opened one by one by who knows what
// is in them, so that no file decides how deep anything nests. Everything is written back byte for byte.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/bytes.h"
#include "ods/files/file_input.h"

namespace ods {

using BoxType = uint32_t;

constexpr BoxType box_type(const char (&letters)[5]) {
  BoxType type = 0;
  for (int i = 0; i < 4; i++) type = type << 8 | static_cast<unsigned char>(letters[i]);
  return type;
}

// "avc1"; what cannot be printed becomes a point.
std::string type_text(BoxType type);

struct Box {
  BoxType type = 0;
  std::string body;           // what stands behind the header; once opened, what stands before the first child
  std::vector<Box> children;  // once opened
  std::string tail;           // fewer than 8 bytes behind them
  bool is_large = false;      // its size has 64 bits, as few have
};

// The boxes that follow each other in these bytes; fewer than 8 that are left go into `tail`. Throws MalformedFile.
std::vector<Box> parse_boxes(std::string_view bytes, std::string& tail);

// Turns the body behind its first `prefix` bytes into children. Nothing happens where it is opened already. Throws
// MalformedFile.
void open_box(Box& box, size_t prefix);

// The first child of that type; null where there is none.
Box* find_child(Box& box, BoxType type);
const Box* find_child(const Box& box, BoxType type);

// The child, opened; MalformedFile where there is none.
Box& open_child(Box& box, BoxType type, size_t prefix = 0);

// The bytes that write_box() appends, to others or to a file.
uint64_t box_size(const Box& box);
void write_box(const Box& box, std::string& bytes);
void write_box(const Box& box, AtomicFile& file);

// A box of the file itself, which stays there.
struct FileBox {
  BoxType type = 0;
  uint32_t header = 8;
  uint64_t offset = 0;
  uint64_t size = 0;  // with its header
  uint64_t end() const { return offset + size; }
};

// All of them, from the first byte to the last. Throws MalformedFile, where one is longer than the file and where there
// are more than a million; Error(kInput).
std::vector<FileBox> scan_boxes(const FileInput& file);

// A box of the file, in memory. `opened`: its type, then that of children which are opened, then that of theirs, and so
// on: what is in them is in memory once, however large. Throws MalformedFile, where it has more than 256 MiB, too.
Box read_box(const FileInput& file, const FileBox& box, std::span<const BoxType> opened = {});

}  // namespace ods
