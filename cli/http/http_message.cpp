// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/http/http_message.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "ods/base/text.h"

namespace {

// Removes the part before the mark, and the mark, from the text, and returns the part.
std::optional<std::string_view> take_until(std::string_view& text, std::string_view mark) {
  const size_t at = text.find(mark);
  if (at == std::string_view::npos) return {};
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at + mark.size());
  return taken;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool is_visible(char c) {
  return c > ' ' && c < '\x7f';
}

// Field names and methods.
bool is_token(std::string_view text) {
  constexpr std::string_view kNone = "\"(),/:;<=>?@[\\]{}";
  return !text.empty() &&
         std::ranges::all_of(text, [&](char c) { return is_visible(c) && kNone.find(c) == std::string_view::npos; });
}

std::string decoded(std::string_view text, bool is_query) {
  std::string bytes;
  for (size_t i = 0; i < text.size(); i++) {
    unsigned char byte = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      bytes += static_cast<char>(byte);
      i += 2;
    } else {
      bytes += is_query && text[i] == '+' ? ' ' : text[i];
    }
  }
  return bytes;
}

bool read_target(std::string_view target, RequestHead& head) {
  if (!target.starts_with('/') || !std::ranges::all_of(target, is_visible)) return false;
  const size_t mark = target.find('?');
  head.path = decoded(target.substr(0, mark), false);
  std::string_view query = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  while (!query.empty()) {
    std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(pair.size() + 1, query.size()));
    const auto name = take_until(pair, "=");
    head.query[decoded(name ? *name : pair, true)] = name ? decoded(pair, true) : "";
  }
  return true;
}

bool read_fields(std::string_view text, RequestHead& head) {
  while (text != "\r\n") {
    auto line = take_until(text, "\r\n");
    const auto name = line ? take_until(*line, ":") : std::nullopt;
    if (!name || !is_token(*name)) return false;
    const std::string_view value = trimmed(*line);
    if (std::ranges::any_of(value, [](unsigned char c) { return (c < ' ' && c != '\t') || c == 0x7f; })) return false;
    const std::string small = ods::small_letters(std::string(*name));
    // Browsers send several of these, and we do not need them.
    if (!head.fields.emplace(small, value).second && small != "cookie" && !small.starts_with("accept")) return false;
  }
  return true;
}

std::optional<uint64_t> number_of(std::string_view digits) {
  uint64_t number = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (end != digits.data() + digits.size() || end == digits.data()) return {};
  return fault == std::errc() ? number : std::numeric_limits<uint64_t>::max();  // above all sizes
}

}  // namespace

std::string RequestHead::field(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? "" : found->second;
}

std::optional<RequestHead> read_request_head(std::string_view text) {
  RequestHead head;
  const auto line = take_until(text, "\r\n");
  if (!line) return {};
  std::string_view version = *line;
  const auto method = take_until(version, " "), target = take_until(version, " ");
  if (!method || !target || !is_token(*method) || !read_target(*target, head) || !read_fields(text, head)) return {};
  if (version != "HTTP/1.1" && version != "HTTP/1.0") return {};
  head.method = *method;
  head.stays = version == "HTTP/1.1" && ods::small_letters(head.field("connection")) != "close";
  return head;
}

FilePart part_of_file(std::string_view asked, uint64_t size) {
  const FilePart whole{200, 0, size}, none{416, 0, 0};
  constexpr std::string_view kUnit = "bytes=";
  if (!asked.starts_with(kUnit)) return whole;
  std::string_view last = asked.substr(kUnit.size());
  const auto first = take_until(last, "-");
  if (!first) return whole;
  const std::optional<uint64_t> from = number_of(*first), to = number_of(last);
  if (first->empty()) {  // the last bytes
    if (!to) return whole;
    const uint64_t count = std::min(*to, size);
    return count == 0 ? none : FilePart{206, size - count, count};
  }
  if (!from || (!to && !last.empty()) || (to && *to < *from)) return whole;
  if (*from >= size) return none;
  return {206, *from, (to ? std::min(*to, size - 1) : size - 1) - *from + 1};
}

const char* reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 204:
      return "No Content";
    case 206:
      return "Partial Content";
    case 303:
      return "See Other";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 411:
      return "Length Required";
    case 429:
      return "Too Many Requests";
    case 413:
      return "Content Too Large";
    case 416:
      return "Range Not Satisfiable";
    case 431:
      return "Request Header Fields Too Large";
    case 503:
      return "Service Unavailable";
    default:
      return "Internal Server Error";
  }
}
