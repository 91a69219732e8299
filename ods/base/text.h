// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Words of files and command lines.
#pragma once
#include <string>

namespace ods {

// A to Z become a to z; all else stays.
std::string small_letters(std::string text);

}  // namespace ods
