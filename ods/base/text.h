// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Words of files and command lines.
#pragma once
#include <string>

namespace ods {

// A to Z become a to z; all else stays.
std::string small_letters(std::string text);

// Every control character becomes a space: a file's name may hold line breaks and what a terminal would obey.
// Spaces at the end go.
std::string one_line(std::string text);

// What a library says went wrong, in one line. Some put every exception into words: one of memory is thrown as
// std::bad_alloc again.
std::string library_words(const std::string& text);

}  // namespace ods
