// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/share.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"

namespace {

constexpr std::chrono::seconds kMessagePatience{5};  // for the next message
constexpr std::chrono::seconds kSilence{10};         // then a page has gone: pages speak every two seconds
constexpr size_t kMostBytes = size_t{16} << 10;
constexpr size_t kMostPages = 8;

void check_id(const std::string& id) {
  const bool is_word = std::ranges::all_of(id, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); });
  if (id.empty() || id.size() > 16 || !is_word) throw UsageError("id must be 1 to 16 of a-z and 0-9");
}

}  // namespace

void Share::forget_the_silent() const {
  std::erase_if(latest_, [now = Clock::now()](const auto& each) { return now - each.second.came > kSilence; });
}

size_t Share::pages() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  forget_the_silent();
  return latest_.size();
}

WebAnswer Share::answer(const WebRequest& request) {
  const std::string id = value_of(request, "id"), after = value_of(request, "after");
  check_id(id);
  if (request.is_post) return take(id, request.body);
  uint64_t number = 0;
  std::from_chars(after.data(), after.data() + after.size(), number);
  return wait(id, number);
}

WebAnswer Share::take(const std::string& id, const std::string& body) {
  if (body.size() > kMostBytes) throw UsageError(fmt::format("a message has at most {} bytes", kMostBytes));
  const ods::Json message = ods::parse_json(body, "message", "message");
  if (!message.is_object()) throw UsageError("a message is an object {...}");
  const std::string text = ods::json_document(message);
  const std::lock_guard<std::mutex> lock(mutex_);
  forget_the_silent();
  if (latest_.size() >= kMostPages && !latest_.contains(id)) {
    latest_.erase(std::ranges::min_element(latest_, {}, [](const auto& each) { return each.second.number; }));
  }
  latest_[id] = {++number_, Clock::now(), text};
  came_.notify_all();
  return {.type = "application/json", .body = "{}"};
}

WebAnswer Share::wait(const std::string& id, uint64_t after) {
  std::unique_lock<std::mutex> lock(mutex_);
  std::string messages;
  const auto gather = [&] {
    for (const auto& [from, message] : latest_) {
      if (from == id || message.number <= after) continue;
      messages += fmt::format("{}\"{}\":{}", messages.empty() ? "" : ",", from, message.text);
    }
    return !messages.empty();
  };
  forget_the_silent();
  came_.wait_for(lock, kMessagePatience, gather);
  return {.type = "application/json", .body = fmt::format("{{\"number\":{},\"messages\":{{{}}}}}", number_, messages)};
}
