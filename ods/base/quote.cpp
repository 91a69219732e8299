// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/quote.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "ods/base/text.h"

namespace ods {

bool is_quotable(std::string_view text) {
  return text.find_first_of("\n\t") == std::string_view::npos && terminal_text(text) == text;
}

std::string shell_word(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("-_.,/:=+%@").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted;
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + quoted + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

std::string xml_text(const std::string& text) {
  std::string quoted;
  for (const char c : terminal_text(text)) {
    const std::string_view special = c == '&'   ? "&amp;"
                                     : c == '<' ? "&lt;"
                                     : c == '>' ? "&gt;"
                                     : c == '"' ? "&quot;"
                                                : "";
    quoted += special.empty() ? std::string(1, c) : std::string(special);
  }
  return quoted;
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true);
}

std::string json_document(const nlohmann::ordered_json& json, int indent) {
  const std::string text = json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string escaped;
  for (size_t at = 0; at < text.size(); at++) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const unsigned next = at + 1 < text.size() ? static_cast<unsigned char>(text[at + 1]) : 0u;
    const bool is_second_set = byte == 0xc2 && next < 0xa0;
    if (byte == 0x7f || is_second_set) {
      escaped += fmt::format("\\u{:04x}", is_second_set ? next : byte);
      at += is_second_set;
    } else {
      escaped += text[at];
    }
  }
  return escaped;
}

}  // namespace ods
