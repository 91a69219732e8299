// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes, the building blocks of mp4 and mov files: a size, a four-letter type and a body, which may contain boxes.
// Sources: ISO/IEC 14496-12 (ISO base media file format), 4.2; Apple, "QuickTime File Format" for the end of lists
// there.
//
// A box's size is checked against its parent's. Callers open a box only if they know its type, so the file does not
// control the nesting depth. Unchanged boxes are written back byte for byte.
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

// "avc1"; unprintable characters become dots.
std::string type_text(BoxType type);

struct Box {
  BoxType type = 0;
  std::string body;           // everything after the header; once opened, the bytes before the first child
  std::vector<Box> children;  // once opened
  std::string tail;           // fewer than 8 bytes after the last child
  bool is_large = false;      // rare: a 64-bit size field
};

// Parses consecutive boxes; fewer than 8 bytes left over go into `tail`. Throws MalformedFile.
std::vector<Box> parse_boxes(std::string_view bytes, std::string& tail);

// Parses the body after its first `prefix` bytes into children. Does nothing if the box is
// open already. Throws MalformedFile.
void open_box(Box& box, size_t prefix);

// The first child of this type, or null.
Box* find_child(Box& box, BoxType type);
const Box* find_child(const Box& box, BoxType type);

// Opens the child of this type. Throws MalformedFile if there is none.
Box& open_child(Box& box, BoxType type, size_t prefix = 0);

// The size and the bytes of a box, including its children.
uint64_t box_size(const Box& box);
void write_box(const Box& box, std::string& bytes);
void write_box(const Box& box, AtomicFile& file);

// A top-level box that stays in the file.
struct FileBox {
  BoxType type = 0;
  uint32_t header = 8;
  uint64_t offset = 0;
  uint64_t size = 0;  // including its header
  uint64_t end() const { return offset + size; }
};

// Returns all top-level boxes in order. After the header and the media of a video or a picture, bytes that are not a
// box of ISO/IEC 14496-12 (a camera's own trailer) count as one box of type 0 without a header. Throws MalformedFile if
// a box is longer than the file or there are more than a million; Error(kInput).
std::vector<FileBox> scan_boxes(const FileInput& file);

// Reads a box into memory. `opened` is the chain of types to open, from the box down; the contents of these are kept in
// memory only once, however large. Throws MalformedFile, also for more than 256 MiB.
Box read_box(const FileInput& file, const FileBox& box, std::span<const BoxType> opened = {});

}  // namespace ods
