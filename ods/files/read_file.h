// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A file's bytes. What does not say otherwise throws Error(kInput): there is no such file, it is a folder or a device,
// or it may not be read.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ods/base/error.h"

namespace ods {

// The Error(kInput) of a file that cannot be read.
Error cannot_read(const std::string& path, const std::string& why);

size_t file_size(const std::string& path);

// What would have to change with a file's contents, "517 bytes, of 1700000000123"; empty: there is no such file.
std::string file_identity(const std::string& path);

// The whole file. One with more than `most` bytes is an Error before it is read; one that does not fit in memory is an
// Error(kMemory).
std::vector<unsigned char> read_file(const std::string& path, size_t most);

// Its first `count` bytes, or all where it has fewer; likewise.
std::vector<unsigned char> read_start(const std::string& path, size_t count);

// Copies `size` bytes of a file, or of what stands for one, from an offset on; false: it has not so many.
using ByteReader = std::function<bool(size_t offset, void* to, size_t size)>;

}  // namespace ods
