// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/ebml.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "ods/base/checksum.h"

namespace ods {

constexpr uint32_t kCrc32 = 0xbf;
constexpr size_t kMaxChildren = 1000000;

namespace {

struct ElementHeader {
  uint32_t id = 0;
  size_t size_width = 0;
  uint32_t length = 0;  // length of id and size together
  uint64_t body = 0;
  bool is_endless = false;
};

}  // namespace

// The length of a number, from its first byte. Throws MalformedFile if that is 0.
static size_t length_of(uint64_t first) {
  if (first == 0) throw MalformedFile("a size in it is invalid");
  return static_cast<size_t>(std::countl_zero(static_cast<uint8_t>(first))) + 1;
}

static ElementHeader parse_header(std::string_view bytes) {
  const size_t id_length = length_of(get_number(bytes, 0, 1));
  if (id_length > 4) throw MalformedFile("an element of it has no id");
  ElementHeader header;
  header.id = static_cast<uint32_t>(get_number(bytes, 0, id_length));
  header.size_width = length_of(get_number(bytes, id_length, 1));
  const uint64_t mask = (uint64_t{1} << (7 * header.size_width)) - 1;
  header.body = get_number(bytes, id_length, header.size_width) & mask;
  header.is_endless = header.body == mask;
  header.length = static_cast<uint32_t>(id_length + header.size_width);
  return header;
}

void open_element(Element& element) {
  std::string_view bytes = element.body;
  while (!bytes.empty()) {
    const ElementHeader header = parse_header(bytes);
    bytes.remove_prefix(header.length);
    if (header.is_endless || header.body > bytes.size()) {
      throw MalformedFile(fmt::format("its element {:X} extends past the end of its parent", header.id));
    }
    if (element.children.size() == kMaxChildren)
      throw MalformedFile("one of its elements contains more than a million others");
    element.children.push_back({header.id, header.size_width, std::string(bytes.substr(0, header.body)), {}});
    bytes.remove_prefix(header.body);
  }
  element.body.clear();
}

const Element* find_child(const Element& element, uint32_t id) {
  const std::vector<Element>& all = element.children;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Element& e) { return e.id == id; });
  return found == all.end() ? nullptr : &*found;
}

Element* find_child(Element& element, uint32_t id) {
  return const_cast<Element*>(find_child(static_cast<const Element&>(element), id));
}

uint64_t number_of(const Element& element) {
  if (element.body.size() > 8) throw MalformedFile("a number in it is too long");
  return get_number(element.body, 0, element.body.size());
}

std::string text_of(const Element& element) {
  return element.body.substr(0, element.body.find('\0'));
}

double float_of(const Element& element) {
  const uint64_t bits = number_of(element);
  if (element.body.size() == 4) return static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(bits)));
  return element.body.size() == 8 ? std::bit_cast<double>(bits) : 0.0;
}

void set_number(Element& element, uint64_t value) {
  size_t width = std::max<size_t>(element.body.size(), 1);
  while (width < 8 && value >> (8 * width) != 0) width++;
  element.body.clear();
  append_number(element.body, value, width);
}

Element number_element(uint32_t id, uint64_t value) {
  Element element;
  element.id = id;
  set_number(element, value);
  return element;
}

Element float_element(uint32_t id, double value) {
  Element element;
  element.id = id;
  append_number(element.body, std::bit_cast<uint64_t>(value), 8);
  return element;
}

// --- writing ---------------------------------------------------------------------------------------------------------

static size_t id_length(uint32_t id) {
  return id > 0xffffff ? 4 : id > 0xffff ? 3 : id > 0xff ? 2 : 1;
}

// A size with all bits set means unknown.
static size_t size_length(uint64_t size, size_t width) {
  while (size >= (uint64_t{1} << (7 * width)) - 1) width++;
  return width;
}

void append_size(std::string& bytes, uint64_t size, size_t width) {
  const size_t length = size_length(size, width);
  append_number(bytes, size | uint64_t{1} << (7 * length), length);
}

static uint64_t body_size(const Element& element) {
  uint64_t size = element.body.size();
  for (const Element& child : element.children) size += element_size(child);
  return size;
}

uint64_t element_size(const Element& element) {
  const uint64_t body = body_size(element);
  return id_length(element.id) + size_length(body, element.size_width) + body;
}

void write_element(const Element& element, std::string& bytes) {
  append_number(bytes, element.id, id_length(element.id));
  append_size(bytes, body_size(element), element.size_width);
  bytes += element.body;
  for (const Element& child : element.children) write_element(child, bytes);
}

// A CRC covers everything after it in its parent, and is little endian.
void update_crc(Element& element) {
  for (Element& child : element.children) update_crc(child);
  if (element.children.empty() || element.children[0].id != kCrc32) return;
  std::string rest;
  for (size_t i = 1; i < element.children.size(); i++) write_element(element.children[i], rest);
  const uint32_t crc = crc32(rest);
  std::string& body = element.children[0].body;
  body.clear();
  for (int shift = 0; shift < 32; shift += 8) body.push_back(static_cast<char>(crc >> shift & 0xff));
}

// --- in the file -----------------------------------------------------------------------------------------------------

FileElement scan_element(const FileInput& file, uint64_t offset, uint64_t end) {
  const ElementHeader header = parse_header(file.read(offset, std::min<uint64_t>(end - offset, 12)));
  FileElement element{header.id, header.length, offset, end - offset, header.is_endless, header.size_width};
  const uint64_t left = end - element.body();
  if (header.is_endless) return element;
  if (header.body > left) {
    throw MalformedFile(fmt::format("it is cut short: its element {:X} should have {} bytes, but {} are left",
                                    header.id, header.body, left));
  }
  element.size = header.length + header.body;
  return element;
}

Element read_element(const FileInput& file, const FileElement& element) {
  constexpr uint64_t kMax = uint64_t{256} << 20;
  if (element.size > kMax) throw MalformedFile(fmt::format("its element {:X} has more than 256 MiB", element.id));
  return {element.id, element.size_width, file.read(element.body(), element.size - element.header), {}};
}

}  // namespace ods
