// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/text.h"

#include <algorithm>
#include <new>

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

// The length of the character at the start of the text; 0 if it is not valid UTF-8.
static size_t character_length(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const size_t length = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  for (size_t i = 1; i < length; i++) {
    if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
  }
  // Overlong, a surrogate, or beyond the last code point.
  const bool is_wrong = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                        (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return is_wrong ? 0 : length;
}

// Calls `change` with each character, empty for a byte that is part of none, and puts together what it returns.
template <class Change>
static std::string changed(std::string_view text, const Change& change) {
  std::string result;
  while (!text.empty()) {
    const size_t length = character_length(text);
    result += change(text.substr(0, length));
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return result;
}

std::string valid_utf8(std::string_view text) {
  return changed(text, [](std::string_view character) { return character.empty() ? "\uFFFD" : character; });
}

static bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  const bool is_second_set = first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
  return first < ' ' || first == 0x7f || is_second_set;
}

std::string terminal_text(std::string_view text) {
  return changed(text, [](std::string_view character) {
    if (character == "\n" || character == "\t") return character;
    return character.empty() || is_control(character) ? "?" : character;
  });
}

std::string library_message(const std::string& text) {
  std::string words = valid_utf8(one_line(text));
  // The text of the exception is at the end; libraries put names, which come from files, before it.
  if (words.ends_with("std::bad_alloc") || words.ends_with("(std::bad_alloc)")) throw std::bad_alloc();
  return words;
}

}  // namespace ods
