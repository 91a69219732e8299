// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/format/boxes.h"

#include <fmt/format.h>

#include <algorithm>

namespace ods {

std::string type_text(BoxType type) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    const char letter = static_cast<char>(type >> shift & 0xff);
    text += letter >= ' ' && letter <= '~' ? letter : '.';
  }
  return text;
}

constexpr size_t kMaxChildren = 1000000;

namespace {

struct BoxHeader {
  BoxType type;
  uint32_t size;   // size of the header
  uint64_t whole;  // size of the box; 0 if it extends to the end of the file
};

}  // namespace

// Precondition: at least 8 bytes.
static BoxHeader parse_header(std::string_view bytes) {
  BoxHeader header{static_cast<BoxType>(get_number(bytes, 4, 4)), 8, get_number(bytes, 0, 4)};
  if (header.whole == 1) {
    if (bytes.size() < 16) throw MalformedFile(fmt::format("its box '{}' is cut short", type_text(header.type)));
    header.size = 16;
    header.whole = get_number(bytes, 8, 8);
  } else if (header.whole == 0) {
    return header;
  }
  if (header.whole < header.size) {
    throw MalformedFile(
        fmt::format("its box '{}' claims an impossible size of {} bytes", type_text(header.type), header.whole));
  }
  return header;
}

static MalformedFile too_long(BoxType type) {
  return MalformedFile(fmt::format("its box '{}' extends past the end of its parent", type_text(type)));
}

static MalformedFile too_many() {
  return MalformedFile("one of its boxes contains more than a million others");
}

std::vector<Box> parse_boxes(std::string_view bytes, std::string& tail) {
  std::vector<Box> boxes;
  while (bytes.size() >= 8) {
    const BoxHeader header = parse_header(bytes);
    // Only a top-level box may extend to the end of the file.
    if (header.whole == 0 || header.whole > bytes.size()) throw too_long(header.type);
    if (boxes.size() == kMaxChildren) throw too_many();
    Box box;
    box.type = header.type;
    box.is_large = header.size == 16;
    box.body = bytes.substr(header.size, header.whole - header.size);
    boxes.push_back(std::move(box));
    bytes.remove_prefix(header.whole);
  }
  tail = bytes;
  return boxes;
}

void open_box(Box& box, size_t prefix) {
  if (!box.children.empty()) return;
  if (box.body.size() < prefix) throw MalformedFile(fmt::format("its box '{}' is too short", type_text(box.type)));
  if (box.body.size() == prefix) return;
  box.children = parse_boxes(std::string_view(box.body).substr(prefix), box.tail);
  box.body.resize(prefix);
  box.body.shrink_to_fit();
}

const Box* find_child(const Box& box, BoxType type) {
  const auto found =
      std::find_if(box.children.begin(), box.children.end(), [&](const Box& b) { return b.type == type; });
  return found == box.children.end() ? nullptr : &*found;
}

Box* find_child(Box& box, BoxType type) {
  return const_cast<Box*>(find_child(static_cast<const Box&>(box), type));
}

Box& open_child(Box& box, BoxType type, size_t prefix) {
  Box* child = find_child(box, type);
  if (child == nullptr) {
    throw MalformedFile(fmt::format("its box '{}' has no '{}' in it", type_text(box.type), type_text(type)));
  }
  open_box(*child, prefix);
  return *child;
}

uint64_t box_size(const Box& box) {
  uint64_t size = 8 + box.body.size() + box.tail.size();
  for (const Box& child : box.children) size += box_size(child);
  return box.is_large || size > 0xffffffff ? size + 8 : size;
}

static void append_header(const Box& box, std::string& bytes) {
  const uint64_t size = box_size(box);
  const bool is_large = box.is_large || size > 0xffffffff;
  append_number(bytes, is_large ? 1 : size, 4);
  append_number(bytes, box.type, 4);
  if (is_large) append_number(bytes, size, 8);
}

void write_box(const Box& box, std::string& bytes) {
  append_header(box, bytes);
  bytes += box.body;
  for (const Box& child : box.children) write_box(child, bytes);
  bytes += box.tail;
}

void write_box(const Box& box, AtomicFile& file) {
  std::string header;
  append_header(box, header);
  append(file, header);
  append(file, box.body);
  for (const Box& child : box.children) write_box(child, file);
  append(file, box.tail);
}

// Precondition: at least 8 bytes are left.
static FileBox read_header(const FileInput& file, uint64_t at, uint64_t left) {
  const BoxHeader header = parse_header(file.read(at, std::min<uint64_t>(left, 16)));
  return {header.type, header.size, at, header.whole};
}

namespace {

// The parts of a video or a HEIF picture that were found so far.
struct FoundParts {
  bool header = false, media = false, fragments = false;

  void add(BoxType type) {
    header = header || type == box_type("moov") || type == box_type("meta");
    media = media || type == box_type("mdat");
    fragments = fragments || type == box_type("moof");
  }
};

}  // namespace

// Returns whether the bytes at this position cannot be a box: its size is less than its header's or leads beyond the
// end.
static bool cannot_be_box(const FileInput& file, uint64_t at) {
  const uint64_t left = file.size() - at;
  const std::string header = file.read(at, std::min<uint64_t>(left, 16));
  const uint64_t size = get_number(header, 0, 4);
  if (size == 1) return left < 16 || get_number(header, 8, 8) < 16 || get_number(header, 8, 8) > left;
  return size != 0 && (size < 8 || size > left);
}

// Returns whether the file is whole before this position, and what follows is not another part of it that was cut
// short.
static bool is_trailer(const FileInput& file, uint64_t at, const FoundParts& before) {
  constexpr BoxType kParts[] = {box_type("moov"), box_type("mdat"), box_type("moof"), box_type("mfra"),
                                box_type("free"), box_type("skip"), box_type("uuid"), box_type("meta"),
                                box_type("sidx"), box_type("styp"), box_type("emsg"), box_type("udta")};
  if (!before.header || !before.media) return false;
  if (file.size() - at < 8) return !before.fragments;
  const auto type = static_cast<BoxType>(get_number(file.read(at + 4, 4), 0, 4));
  return cannot_be_box(file, at) && std::ranges::find(kParts, type) == std::end(kParts);
}

std::vector<FileBox> scan_boxes(const FileInput& file) {
  constexpr size_t kMax = 1000000;
  std::vector<FileBox> boxes;
  FoundParts found;
  for (uint64_t at = 0; at < file.size();) {
    const uint64_t left = file.size() - at;
    if (is_trailer(file, at, found)) {
      boxes.push_back({0, 0, at, left});
      return boxes;
    }
    if (left < 8) throw MalformedFile("it is cut short");
    FileBox box = read_header(file, at, left);
    if (box.size > left) {
      throw MalformedFile(fmt::format("it is cut short: its box '{}' should have {} bytes, but {} are left",
                                      type_text(box.type), box.size, left));
    }
    if (box.size == 0) box.size = left;
    boxes.push_back(box);
    found.add(box.type);
    at = box.end();
    if (boxes.size() > kMax) throw MalformedFile("it contains more than a million boxes");
  }
  return boxes;
}

Box read_box(const FileInput& file, const FileBox& box, std::span<const BoxType> opened) {
  constexpr uint64_t kMax = uint64_t{256} << 20;
  if (box.size > kMax) throw MalformedFile(fmt::format("its box '{}' has more than 256 MiB", type_text(box.type)));
  Box result;
  result.type = box.type;
  result.is_large = box.header == 16;
  uint64_t at = box.offset + box.header;
  if (opened.empty() || opened.front() != box.type) {
    result.body = file.read(at, box.end() - at);
    return result;
  }
  while (box.end() - at >= 8) {
    const FileBox child = read_header(file, at, box.end() - at);
    if (child.size == 0 || child.size > box.end() - at) throw too_long(child.type);
    if (result.children.size() == kMaxChildren) throw too_many();
    result.children.push_back(read_box(file, child, opened.subspan(1)));
    at = child.end();
  }
  result.tail = file.read(at, box.end() - at);
  return result;
}

}  // namespace ods
