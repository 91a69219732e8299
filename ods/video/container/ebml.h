// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements, of which mkv and webm files consist: an id, a size, a body, which may hold elements again. Source: RFC 8794
// (EBML). As with boxes.h: no size is believed, who knows what is in an element opens it, and all is written back byte
// for byte.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/bytes.h"
#include "ods/files/file_input.h"

namespace ods {

struct Element {
  uint32_t id = 0;        // with the bits that say its length
  size_t size_width = 1;  // bytes of its size; more where they do not hold it
  std::string body;
  std::vector<Element> children;  // once opened; then there is no body
};

// Throws MalformedFile.
void open_element(Element& element);

// The first child of that id; null where there is none.
Element* find_child(Element& element, uint32_t id);
const Element* find_child(const Element& element, uint32_t id);

// The number, text or float that an element is. Throws MalformedFile.
uint64_t number_of(const Element& element);
std::string text_of(const Element& element);
double float_of(const Element& element);

Element number_element(uint32_t id, uint64_t value);
Element float_element(uint32_t id, double value);
// In as many bytes as it has, or more where it takes more.
void set_number(Element& element, uint64_t value);

uint64_t element_size(const Element& element);
void write_element(const Element& element, std::string& bytes);

// Makes the CRC-32 elements true again, of this opened element and of all in it.
void update_crc(Element& element);

// The size as it stands in a file, in `width` bytes or more.
void append_size(std::string& bytes, uint64_t size, size_t width);

// An element of the file itself, which stays there.
struct FileElement {
  uint32_t id = 0;
  uint32_t header = 0;
  uint64_t offset = 0;
  uint64_t size = 0;        // with its header
  bool is_endless = false;  // it says no size, and is taken to reach as far as what holds it
  size_t size_width = 1;
  uint64_t end() const { return offset + size; }
  uint64_t body() const { return offset + header; }
};

// The element that starts at `offset` and ends by `end`. Throws MalformedFile.
FileElement scan_element(const FileInput& file, uint64_t offset, uint64_t end);

// An element of the file, in memory. Throws MalformedFile where it has more than 256 MiB.
Element read_element(const FileInput& file, const FileElement& element);

}  // namespace ods
