// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Base64 encoding and decoding (RFC 4648).
#pragma once
#include <string>
#include <string_view>

namespace ods {

std::string encode_base64(std::string_view bytes);

// Decodes Base64. Skips white space, which surrounds it in XML. Stops at the first other character outside the
// alphabet.
std::string decode_base64(std::string_view text);

}  // namespace ods
