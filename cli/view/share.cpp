// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/share.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"

namespace {

constexpr std::chrono::seconds kMessagePatience{5};  // for the next message
// After such a silence a page counts as closed; pages send a message every two seconds.
constexpr std::chrono::seconds kSilence{10};
constexpr size_t kMaxBytes = size_t{16} << 10;
constexpr size_t kMaxPages = 8;
constexpr size_t kMaxListeners = 4;  // that wait and have not sent a message
constexpr double kLargest = 1e6;     // of a number
constexpr uint64_t kClocks = uint64_t{1} << 32;

bool is_id(const std::string& id) {
  const bool is_word = std::ranges::all_of(id, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); });
  return !id.empty() && id.size() <= 16 && is_word;
}

void check_id(const std::string& id) {
  if (!is_id(id)) throw UsageError("id must be 1 to 16 of a-z and 0-9");
}

bool is_moderate(const ods::Json& value) {
  return value.is_number() && std::abs(value.get<double>()) <= kLargest;
}

// Numbers of moderate size and strings: a direction, or the point of a mouse.
bool is_place(const ods::Json& part) {
  return part.is_object() &&
         std::ranges::all_of(part, [](const ods::Json& value) { return is_moderate(value) || value.is_string(); });
}

// A value, the number of its change and the page that changed it.
bool is_change(const ods::Json& field) {
  if (!field.is_object() || !field.contains("value") || !field.contains("clock") || !field.contains("by")) return false;
  const ods::Json &clock = field["clock"], &by = field["by"];
  return clock.is_number_unsigned() && clock.get<uint64_t>() < kClocks && by.is_string() &&
         is_id(by.get_ref<const std::string&>());
}

// The parts of a message that web/share.js gives this form.
ods::Json well_formed(const ods::Json& message) {
  ods::Json kept = ods::Json::object();
  for (const auto& [name, part] : message.items()) {
    if ((name == "look" || name == "point") && is_place(part)) kept[name] = part;
    if (name == "time" && is_moderate(part)) kept[name] = part;
    if (name != "fields" || !part.is_object()) continue;
    kept[name] = ods::Json::object();
    for (const auto& [field, change] : part.items()) {
      if (is_change(change)) kept[name][field] = change;
    }
  }
  return kept;
}

const WebAnswer kTooMany{.status = 429, .body = "too many pages share already: close one\n"};

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
  if (body.size() > kMaxBytes) throw UsageError(fmt::format("a message has at most {} bytes", kMaxBytes));
  const ods::Json message = ods::parse_json(body, "message", "message");
  if (!message.is_object()) throw UsageError("a message is an object {...}");
  const std::string text = ods::json_document(well_formed(message));
  const std::lock_guard<std::mutex> lock(mutex_);
  forget_the_silent();
  if (latest_.size() >= kMaxPages && !latest_.contains(id)) return kTooMany;
  latest_[id] = {++number_, Clock::now(), text};
  came_.notify_all();
  return {.type = "application/json", .body = "{}"};
}

WebAnswer Share::wait(const std::string& id, uint64_t after) {
  std::unique_lock<std::mutex> lock(mutex_);
  forget_the_silent();
  const auto is_silent = [&](const auto& each) { return !latest_.contains(each.first); };
  const auto silent = static_cast<size_t>(std::ranges::count_if(waiting_, is_silent));
  if (!latest_.contains(id) && !waiting_.contains(id) && silent >= kMaxListeners) return kTooMany;
  const uint64_t own = ++gets_;
  waiting_[id] = own;  // ends the wait of an earlier GET
  came_.notify_all();
  const auto is_latest = [&] {
    const auto found = waiting_.find(id);
    return found != waiting_.end() && found->second == own;
  };
  std::string messages;
  const auto gather = [&] {
    for (const auto& [from, message] : latest_) {
      if (from == id || message.number <= after) continue;
      messages += fmt::format("{}\"{}\":{}", messages.empty() ? "" : ",", from, message.text);
    }
    return !messages.empty() || !is_latest();
  };
  came_.wait_for(lock, kMessagePatience, gather);
  if (is_latest()) waiting_.erase(id);
  return {.type = "application/json", .body = fmt::format("{{\"number\":{},\"messages\":{{{}}}}}", number_, messages)};
}
