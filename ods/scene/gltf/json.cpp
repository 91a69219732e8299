// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/json.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/base/memory.h"

namespace ods {

size_t JsonValue::size() const {
  size_t count = 0;
  for (const JsonValue& value : *this) {
    static_cast<void>(value);
    count++;
  }
  return count;
}

const JsonValue& JsonValue::operator[](std::string_view name) const {
  const JsonValue* found = &kNoJson;  // the last of several equal names counts
  if (!is_object()) return *found;
  for (const JsonValue& member : *this) {
    if (*member.key == name) found = &member;
  }
  return *found;
}

static constexpr std::array<std::string_view, 18> kRootMembers = {
    "accessors", "animations", "asset",  "bufferViews", "buffers",  "cameras", "extensions", "extensionsRequired",
    "images",    "materials",  "meshes", "nodes",       "samplers", "scene",   "scenes",     "extensionsUsed",
    "skins",     "textures"};

namespace {

// Receives parser events and appends values, unless they are inside a skipped value.
class JsonBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonBuilder(JsonDocument& document, const std::string& path, const std::function<bool(std::string_view)>& knows)
      : document_(document), path_(path), knows_(knows) {}

  bool null() override { return add(JsonValue::Kind::kNull); }
  bool boolean(bool value) override { return add(value ? JsonValue::Kind::kTrue : JsonValue::Kind::kFalse); }
  bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
  bool binary(binary_t&) override { return false; }  // not in JSON
  bool string(string_t& value) override;
  bool start_object(std::size_t) override { return open(JsonValue::Kind::kObject); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::kList); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override;
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) override;

 private:
  struct Open {
    size_t index;
    size_t members = 0;
    bool holds_extensions = false;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::kInput, fmt::format("{}: {}", path_, what));
  }
  bool is_kept(const std::string& name) const;
  bool add(JsonValue::Kind kind);
  bool add_number(double number);
  bool open(JsonValue::Kind kind);
  bool close();
  // Returns whether the next value is skipped.
  bool skips() {
    const bool skip = skip_next_ || skipped_ > 0;
    skip_next_ = false;
    return skip;
  }

  JsonDocument& document_;
  const std::string& path_;
  const std::function<bool(std::string_view)>& knows_;
  std::vector<Open> open_;
  const std::string* key_ = &kNoText;  // key of the next member
  bool skip_next_ = false;
  int skipped_ = 0;  // current depth inside a skipped value
};

}  // namespace

bool JsonBuilder::is_kept(const std::string& name) const {
  if (name == "extras") return false;
  if (open_.back().holds_extensions) return knows_(name);
  return open_.size() > 1 || std::find(kRootMembers.begin(), kRootMembers.end(), name) != kRootMembers.end();
}

bool JsonBuilder::key(string_t& name) {
  if (skipped_ > 0) return true;
  if (open_.back().holds_extensions && document_.extensions.size() < kMaxMembers) document_.extensions.insert(name);
  if (!is_kept(name)) {
    skip_next_ = true;
    return true;
  }
  if (++open_.back().members > kMaxMembers) fail(fmt::format("has an object with more than {} members", kMaxMembers));
  key_ = &*document_.keys.insert(std::move(name)).first;
  return true;
}

bool JsonBuilder::add(JsonValue::Kind kind) {
  if (skips()) return true;
  std::vector<JsonValue>& values = document_.values;
  if (values.size() == values.capacity()) {
    const size_t room = std::max<size_t>(64, 2 * values.capacity());
    check_memory(room * sizeof(JsonValue), path_ + ": its JSON", "use a machine with more");
    values.reserve(room);
  }
  JsonValue& value = values.emplace_back();
  value.kind = kind;
  value.key = key_;
  key_ = &kNoText;
  return true;
}

bool JsonBuilder::add_number(double number) {
  const bool skip = skip_next_ || skipped_ > 0;
  add(JsonValue::Kind::kNumber);
  if (!skip) document_.values.back().number = number;
  return true;
}

bool JsonBuilder::string(string_t& text) {
  const bool skip = skip_next_ || skipped_ > 0;
  add(JsonValue::Kind::kText);
  if (!skip) document_.values.back().text = &document_.texts.emplace_back(std::move(text));
  return true;
}

bool JsonBuilder::open(JsonValue::Kind kind) {
  constexpr size_t kDeepest = 100;  // levels; glTF needs ten, extras a few more
  if (open_.size() + static_cast<size_t>(skipped_) >= kDeepest)
    fail("nests its JSON too deeply; it is not a glTF file");
  if (skips()) {
    skipped_++;
    return true;
  }
  const bool holds_extensions = *key_ == "extensions";
  const size_t index = document_.values.size();
  add(kind);
  open_.push_back({index, 0, holds_extensions});
  return true;
}

bool JsonBuilder::close() {
  if (skipped_ > 0) {
    skipped_--;
    return true;
  }
  const size_t index = open_.back().index, length = document_.values.size() - index;
  if (length > UINT32_MAX) fail("has more than four billion values of JSON");
  document_.values[index].length = static_cast<uint32_t>(length);
  open_.pop_back();
  return true;
}

bool JsonBuilder::parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) {
  if (dynamic_cast<const nlohmann::json::parse_error*>(&error) == nullptr) {
    fail("is not a glTF file, or a damaged one: its JSON holds a number that is too large");
  }
  fail(fmt::format("is not a glTF file, or a damaged one: its JSON is broken at byte {}", position));
}

JsonDocument parse_gltf_json(std::span<const unsigned char> text, const std::string& path,
                             const std::function<bool(std::string_view)>& knows) {
  JsonDocument document;
  JsonBuilder builder(document, path, knows);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  return document;
}

}  // namespace ods
