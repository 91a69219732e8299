// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Text from files and command lines.
#pragma once
#include <string>

namespace ods {

// A-Z become a-z; other bytes are unchanged.
std::string small_letters(std::string text);

// Replaces control characters by spaces and trims trailing spaces: a file name may hold line
// breaks or terminal escapes.
std::string one_line(std::string text);

// A library's error message in one line; bytes are '?' if it is not UTF-8, as where it quotes a damaged file. Some
// libraries turn every exception into text: if the text ends with std::bad_alloc, bracketed or not, throws
// std::bad_alloc.
std::string library_words(const std::string& text);

}  // namespace ods
