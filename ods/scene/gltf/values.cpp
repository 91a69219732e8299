// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ods/scene/gltf/parts.h"

namespace ods {

// The integer in a value.
static double whole(const GltfFile& file, const JsonValue& value) {
  if (!value.is_number() || value.number != std::floor(value.number)) {
    fail(file, fmt::format("has a value of {} that is not a whole number; the file is damaged", printable(*value.key)));
  }
  return value.number;
}

static int whole_int(const GltfFile& file, const JsonValue& value) {
  constexpr double kLow = std::numeric_limits<int>::min(), kHigh = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(whole(file, value), kLow, kHigh));
}

int integer(const GltfFile& file, const JsonValue& object, const char* key, int fallback) {
  const JsonValue& value = object[key];
  return value.is_null() ? fallback : whole_int(file, value);
}

int index_in(const GltfFile& file, const JsonValue& object, const char* key) {
  return std::max(-1, integer(file, object, key, -1));
}

size_t size_in(const GltfFile& file, const JsonValue& object, const char* key) {
  const JsonValue& value = object[key];
  if (value.is_null()) return 0;
  const double number = whole(file, value);
  if (number < 0.0) fail(file, fmt::format("has a negative value of {}; the file is damaged", key));
  return static_cast<size_t>(std::min(number, 0x1p60));  // too large for any file
}

double number(const JsonValue& object, const char* key, double fallback) {
  const JsonValue& value = object[key];
  return value.is_number() ? value.number : fallback;
}

std::vector<double> numbers(const JsonValue& object, const char* key, const std::vector<double>& fallback) {
  const JsonValue& list = object[key];
  if (!list.is_list() || list.size() != fallback.size()) return fallback;
  std::vector<double> values;
  for (const JsonValue& value : list) values.push_back(value.is_number() ? value.number : fallback[values.size()]);
  return values;
}

std::vector<int> indices(const GltfFile& file, const JsonValue& object, const char* key) {
  const JsonValue& list = object[key];
  if (!list.is_null() && !list.is_list())
    fail(file, fmt::format("has {} that are not a list; the file is damaged", key));
  std::vector<int> values;
  for (const JsonValue& value : list) values.push_back(whole_int(file, value));
  return values;
}

const JsonValue& extension(const JsonValue& object, const char* name) {
  const JsonValue& found = object["extensions"][name];
  return found.is_object() ? found : kNoJson;
}

}  // namespace ods
