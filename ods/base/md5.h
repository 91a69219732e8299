// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// MD5, by which XMP names its extensions. RFC 1321. No protection against anybody.
#pragma once
#include <string>
#include <string_view>

namespace ods {

// 32 hexadecimal digits, in capitals.
std::string md5(std::string_view bytes);

}  // namespace ods
