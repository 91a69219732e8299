// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/base/suggest.h"

namespace ods {

Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json parse_json(std::string_view text, const std::string& name, const std::string& noun) {
  constexpr int kDeepest = 16;  // levels of brackets; our own files have four
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest)
      throw Error(ErrorKind::kInput, fmt::format("'{}' is not a valid {}: too many brackets", name, noun));
    return true;
  };
  try {
    return Json::parse(text, shallow);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is not JSON (byte {} of {})", name, error.byte, text.size()));
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' is not a valid {}: it contains a number that is too large", name, noun));
  }
}

JsonReader::JsonReader(const Json& json, std::string file, std::string noun, std::string place,
                       std::vector<std::string>& warnings)
    : json_(json), file_(std::move(file)), noun_(std::move(noun)), place_(std::move(place)), warnings_(warnings) {
  if (!json_.is_object()) fail("", "must be an object {...}");
}

void JsonReader::fail(const std::string& key, const std::string& wanted) const {
  const std::string name = place_ + (place_.empty() || key.empty() ? "" : ".") + key;
  const bool is_null = json_.is_object() && json_.contains(key) && json_.at(key).is_null();
  throw Error(ErrorKind::kInput, fmt::format("'{}' is not a valid {}: {} {}{}", file_, noun_,
                                             name.empty() ? "the file" : name, wanted, is_null ? ", not null" : ""));
}

void JsonReader::version(const std::string& mark, int newest) {
  int version = 0;
  integer(mark, version, 1, 1 << 30);
  if (version == 0) fail("", fmt::format("lacks \"{}\": 1", mark));
  if (version <= newest) return;
  throw Error(ErrorKind::kInput,
              fmt::format("'{}' was written by a newer ods ({} version {}, this one reads {}); update ods", file_,
                          noun_, version, newest));
}

const Json* JsonReader::find(const std::string& key) {
  known_.push_back(key);
  const auto found = json_.find(key);
  return found == json_.end() ? nullptr : &*found;
}

bool JsonReader::is_null(const std::string& key) {
  const Json* json = find(key);
  return json && json->is_null();
}

float JsonReader::checked(const Json& json, const std::string& key, float low, float high) const {
  // Compares as float: the limit is the float nearest to 0.001, which may lie above 0.001.
  const float value = json.is_number() ? static_cast<float>(json.get<double>()) : NAN;
  if (!(value >= low && value <= high)) fail(key, fmt::format("must be a number from {:g} to {:g}", low, high));
  return value;
}

void JsonReader::number(const std::string& key, float& value, float low, float high) {
  if (const Json* json = find(key)) value = checked(*json, key, low, high);
}

void JsonReader::integer(const std::string& key, int& value, int low, int high) {
  const Json* json = find(key);
  if (!json) return;
  const bool legal = json->is_number_integer() && *json >= low && *json <= high;
  if (!legal) fail(key, fmt::format("must be a whole number from {} to {}", low, high));
  value = json->get<int>();
}

void JsonReader::flag(const std::string& key, bool& value) {
  const Json* json = find(key);
  if (json && !json->is_boolean()) fail(key, "must be true or false");
  if (json) value = json->get<bool>();
}

bool JsonReader::numbers(const std::string& key, std::vector<float>& values, size_t count, float low, float high) {
  const Json* json = find(key);
  if (!json) return false;
  if (!json->is_array() || json->size() != count) fail(key, fmt::format("must be a list of {} numbers", count));
  values.clear();
  for (const Json& value : *json) values.push_back(checked(value, key, low, high));
  return true;
}

bool JsonReader::vector(const std::string& key, glm::vec2& value, float low, float high) {
  std::vector<float> found;
  if (!numbers(key, found, 2, low, high)) return false;
  value = {found[0], found[1]};
  return true;
}

std::string JsonReader::word(const std::string& key) {
  const Json* json = find(key);
  if (json && (!json->is_string() || *json == "")) fail(key, "must be a string");
  return json ? json->get<std::string>().substr(0, 64) : "";
}

// Keys can be any text, so they are shown shortened.
void JsonReader::finish() {
  for (const auto& [key, value] : json_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    if (warnings_.size() == 16) break;
    warnings_.push_back(fmt::format("'{}': unknown key '{}{}{}'{}", file_, place_, place_.empty() ? "" : ".",
                                    key.substr(0, 64), did_you_mean(key.substr(0, 64), known_)));
  }
}

}  // namespace ods
