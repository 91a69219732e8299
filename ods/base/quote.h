// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Text inside other languages, one function for each. Texts are bytes; of file names only those that are UTF-8 without
// control characters can be written in all of them: is_quotable().
#pragma once
#include <nlohmann/json_fwd.hpp>
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

// The text of an element or, between double quotes, of an attribute, in XML and HTML. What these cannot hold becomes
// '?', as in terminal_text().
std::string xml_text(const std::string& text);

// A string of JSON, YAML and JavaScript, with its double quotes. Precondition: is_quotable().
std::string json_text(const std::string& text);

// JSON of any content as text; indent: spaces per level, -1: one line. Invalid UTF-8 becomes U+FFFD, and control
// characters are escaped, also those that JSON allows as they are: people read it in terminals.
std::string json_document(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace ods
