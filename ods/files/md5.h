// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// MD5, by which XMP names its extensions, and by which we know a file's contents again. RFC 1321. It does not protect
// against anybody who wants two files to have the same sum.
#pragma once
#include <string>
#include <string_view>

namespace ods {

// 32 hexadecimal digits, in capitals.
std::string md5(std::string_view bytes);

// The same of a file's contents, whatever its size. Throws Error(kInput): it cannot be read.
std::string md5_of_file(const std::string& path);

}  // namespace ods
