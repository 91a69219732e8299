// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Text from files and command lines.
#pragma once
#include <string>
#include <string_view>

namespace ods {

// A-Z become a-z; other bytes are unchanged.
std::string small_letters(std::string text);

// Replaces control characters by spaces and trims trailing spaces: a file name may hold line
// breaks or terminal escapes.
std::string one_line(std::string text);

// For a terminal: each control character other than a line break or a tab, and each byte that is not part of a
// character in UTF-8, becomes '?'. A control character may also be one of two bytes, U+0080 to U+009F.
std::string terminal_text(std::string_view text);

// Each byte that is not part of a character in UTF-8 becomes U+FFFD. For text of unknown origin that others will parse.
std::string valid_utf8(std::string_view text);

// A library's error message in one line, valid UTF-8. Some libraries turn every exception into text: if the text ends
// with std::bad_alloc, bracketed or not, throws std::bad_alloc.
std::string library_words(const std::string& text);

}  // namespace ods
