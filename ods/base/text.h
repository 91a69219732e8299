// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Text from files and command lines.
#pragma once
#include <string>
#include <string_view>

namespace ods {

// Converts A-Z to a-z; other bytes are unchanged.
std::string small_letters(std::string text);

// Replaces control characters by spaces and trims trailing spaces: a file name may contain line breaks or terminal
// escapes.
std::string one_line(std::string text);

// Makes text safe for a terminal: replaces control characters other than line breaks and tabs, also U+0080 to U+009F,
// and bytes that are not UTF-8 by '?'.
std::string terminal_text(std::string_view text);

// Replaces each byte that is not part of a UTF-8 character by U+FFFD. For text of unknown origin that other programs
// will parse.
std::string valid_utf8(std::string_view text);

// A library's error message in one line, as valid UTF-8. Some libraries turn every exception into text: if the text
// ends with std::bad_alloc, bracketed or not, throws std::bad_alloc.
std::string library_message(const std::string& text);

}  // namespace ods
