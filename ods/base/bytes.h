// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers in the bytes of a file, the high byte first.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ods {

// The bytes of a file make no sense: what() says why, for whoever knows the file's name to pass on.
struct MalformedFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The number in bytes at .. at + count. Throws MalformedFile where there are not so many.
uint64_t get_number(std::string_view bytes, size_t at, size_t count);

void append_number(std::string& bytes, uint64_t value, size_t count);

// Throws MalformedFile where the number does not fit, or there is no such place.
void set_number(std::string& bytes, size_t at, uint64_t value, size_t count);

}  // namespace ods
