// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/text.h"

#include <algorithm>
#include <new>

#include "ods/base/quote.h"

namespace ods {

std::string small_letters(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string one_line(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < ' ' || c == 0x7f ? ' ' : c;
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string library_words(const std::string& text) {
  std::string words = one_line(text);
  // What the exception said stands at the end; before it libraries quote names, which files choose.
  if (words.ends_with("std::bad_alloc") || words.ends_with("(std::bad_alloc)")) throw std::bad_alloc();
  if (!is_quotable(words))
    std::ranges::replace_if(
        words, [](unsigned char c) { return c >= 0x80; }, '?');
  return words;
}

}  // namespace ods
