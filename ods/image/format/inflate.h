// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compressed metadata of pictures (zlib, RFC 1950).
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ods {

// Returns nullopt if the bytes are damaged or become longer than this.
std::optional<std::string> inflated(std::string_view bytes, size_t longest);

}  // namespace ods
