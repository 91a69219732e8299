// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Integers in the bytes of a file, big-endian by default.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ods {

// Malformed bytes. what() gives the reason; a caller that knows the file name turns it into an Error.
struct MalformedFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The integer in bytes [at, at + count). Throws MalformedFile if the range is out of bounds.
uint64_t get_number(std::string_view bytes, size_t at, size_t count, std::endian order = std::endian::big);

void append_number(std::string& bytes, uint64_t value, size_t count);

// Overwrites an integer. Throws MalformedFile if the value does not fit or the range is out of bounds.
void set_number(std::string& bytes, size_t at, uint64_t value, size_t count, std::endian order = std::endian::big);

}  // namespace ods
