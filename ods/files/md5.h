// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// MD5 (RFC 1321), which XMP uses to name its extensions, and which identifies a file's contents. Not secure against
// deliberate collisions.
#pragma once
#include <string>
#include <string_view>

namespace ods {

// 32 upper-case hexadecimal digits.
std::string md5(std::string_view bytes);

// The MD5 of a file of any size. Throws Error(kInput): it cannot be read.
std::string md5_of_file(const std::string& path);

}  // namespace ods
