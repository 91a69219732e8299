// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Elements, the building blocks of mkv and webm files: an id, a size and a body, which may contain elements. Source:
// RFC 8794 (EBML). As in boxes.h, sizes are checked, callers open the elements that they know, and unchanged elements
// are written back byte for byte.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/bytes.h"
#include "ods/files/file_input.h"

namespace ods {

struct Element {
  uint32_t id = 0;        // including its length bits
  size_t size_width = 1;  // bytes of the size field; more are used if needed
  std::string body;
  std::vector<Element> children;  // once opened; the body is then empty
};

// Throws MalformedFile.
void open_element(Element& element);

// The first child with this id, or null.
Element* find_child(Element& element, uint32_t id);
const Element* find_child(const Element& element, uint32_t id);

// The element's value as a number, text or float. Throws MalformedFile.
uint64_t number_of(const Element& element);
std::string text_of(const Element& element);
double float_of(const Element& element);

Element number_element(uint32_t id, uint64_t value);
Element float_element(uint32_t id, double value);
// Sets a number. Keeps the element's width if the value fits, else widens it.
void set_number(Element& element, uint64_t value);

uint64_t element_size(const Element& element);
void write_element(const Element& element, std::string& bytes);

// Recomputes the CRC-32 elements in this opened element and its opened children.
void update_crc(Element& element);

// Appends an encoded size, in `width` bytes or more.
void append_size(std::string& bytes, uint64_t size, size_t width);

// An element that stays in the file.
struct FileElement {
  uint32_t id = 0;
  uint32_t header = 0;
  uint64_t offset = 0;
  uint64_t size = 0;        // including its header
  bool is_endless = false;  // has an unknown size and extends to the end of its parent
  size_t size_width = 1;
  uint64_t end() const { return offset + size; }
  uint64_t body() const { return offset + header; }
};

// Reads the header of the element at `offset`, which must end by `end`. Throws MalformedFile.
FileElement scan_element(const FileInput& file, uint64_t offset, uint64_t end);

// Reads an element into memory. Throws MalformedFile if it has more than 256 MiB.
Element read_element(const FileInput& file, const FileElement& element);

}  // namespace ods
