// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace ods {

// Compresses bytes to a gzip file (RFC 1952).
std::string gzip(std::string_view bytes);

}  // namespace ods
