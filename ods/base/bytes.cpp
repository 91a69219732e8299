// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/bytes.h"

namespace ods {

static void check_place(std::string_view bytes, size_t at, size_t count) {
  if (at > bytes.size() || count > bytes.size() - at) throw MalformedFile("a table in it ends too early");
}

// The position of a number's byte; i: 0 for the highest one.
static size_t byte_at(size_t at, size_t count, size_t i, std::endian order) {
  return at + (order == std::endian::little ? count - 1 - i : i);
}

uint64_t get_number(std::string_view bytes, size_t at, size_t count, std::endian order) {
  check_place(bytes, at, count);
  uint64_t value = 0;
  for (size_t i = 0; i < count; i++) {
    value = value << 8 | static_cast<unsigned char>(bytes[byte_at(at, count, i, order)]);
  }
  return value;
}

static char byte_of(uint64_t value, size_t place) {
  return static_cast<char>(static_cast<unsigned char>(value >> (8 * place)));
}

void append_number(std::string& bytes, uint64_t value, size_t count) {
  for (size_t i = count; i-- > 0;) bytes.push_back(byte_of(value, i));
}

void set_number(std::string& bytes, size_t at, uint64_t value, size_t count, std::endian order) {
  check_place(bytes, at, count);
  if (count < 8 && value >> (8 * count) != 0) throw MalformedFile("an offset in it no longer fits its field");
  for (size_t i = 0; i < count; i++) bytes[byte_at(at, count, i, order)] = byte_of(value, count - 1 - i);
}

}  // namespace ods
