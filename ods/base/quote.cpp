// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/quote.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

namespace ods {

bool is_quotable(std::string_view text) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  if (std::ranges::any_of(text, is_control)) return false;
  try {
    nlohmann::json(std::string(text)).dump();  // throws if the text is not UTF-8
  } catch (const nlohmann::json::exception&) {
    return false;
  }
  return true;
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
  for (const char c : text) {
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

}  // namespace ods
