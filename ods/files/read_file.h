// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads a file's bytes. Unless stated otherwise, throws Error(kInput): no such file, a folder, a device,
// or no permission.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ods/base/error.h"

namespace ods {

// The Error(kInput) for a file that cannot be read. `why` may quote the file: valid_utf8() makes text of it.
Error cannot_read(const std::string& path, const std::string& why);

size_t file_size(const std::string& path);

// Returns size and modification time, "517 bytes, of 1700000000123"; they change with the contents.
// Empty if there is no such file.
std::string file_identity(const std::string& path);

// Returns the whole file. Throws Error(kInput) before reading if it has more than `maximum` bytes, Error(kMemory) if it
// does not fit in memory.
std::vector<unsigned char> read_file(const std::string& path, size_t maximum);

// Returns the whole file as text. Throws as read_file().
std::string read_text(const std::string& path, size_t maximum);

// Returns the first `count` bytes, or the whole file if it is shorter. Throws as read_file().
std::vector<unsigned char> read_start(const std::string& path, size_t count);

// Copies `size` bytes at an offset of a file, or of a source like one; false if it is too short.
using ByteReader = std::function<bool(size_t offset, void* to, size_t size)>;

}  // namespace ods
