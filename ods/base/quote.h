// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Quotes text for other languages. Texts are bytes; a file name can be written in all of these languages only if it is
// UTF-8 without control characters, see is_quotable().
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace ods {

// Returns whether every language below can represent the text: UTF-8, without line breaks and other control characters.
bool is_quotable(std::string_view text);

// A word for a POSIX shell, quoted if necessary.
std::string shell_word(const std::string& word);
// Words as one line for a shell.
std::string shell_line(const std::vector<std::string>& words);

// Escapes the text of an element or of an attribute in double quotes.
std::string xml_text(const std::string& text);

// A string of JSON, YAML and JavaScript, with its double quotes. Precondition: is_quotable().
std::string json_text(const std::string& text);

}  // namespace ods
