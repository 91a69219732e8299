// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The JSON of a glTF file as one flat list of values: 32 bytes each, made in one pass over the text, destroyed without
// allocating (nlohmann's tree allocates in its destructor, which terminates the process when memory has run out).
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace ods {

inline const std::string kNoText;

// Lookup is linear; no valid glTF object has more members than this.
inline constexpr size_t kMaxMembers = 256;

// A value of a JsonDocument, valid as long as the document. Its contents follow it in the document's list, so a copy of
// a list or an object is useless.
struct JsonValue {
  enum class Kind : unsigned char { kNull, kFalse, kTrue, kNumber, kText, kList, kObject };

  struct Iterator {
    const JsonValue* at;
    const JsonValue& operator*() const { return *at; }
    Iterator& operator++() {
      at += at->length;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at != other.at; }
  };

  Kind kind = Kind::kNull;
  uint32_t length = 1;                // values up to the next sibling: itself and its contents
  const std::string* key = &kNoText;  // for members of objects
  const std::string* text = &kNoText;
  double number = 0.0;  // finite

  bool is_null() const { return kind == Kind::kNull; }
  bool is_number() const { return kind == Kind::kNumber; }
  bool is_text() const { return kind == Kind::kText; }
  bool is_list() const { return kind == Kind::kList; }
  bool is_object() const { return kind == Kind::kObject; }
  bool is_true() const { return kind == Kind::kTrue; }

  // Iterates over the elements of a list or the members of an object; empty for other values.
  Iterator begin() const { return {this + 1}; }
  Iterator end() const { return {this + length}; }
  size_t size() const;  // O(n)

  // The member with this name; kNoJson if there is none or this is not an object.
  const JsonValue& operator[](std::string_view name) const;
};

// Represents an absent value: null.
inline const JsonValue kNoJson;

struct JsonDocument {
  std::vector<JsonValue> values;
  std::unordered_set<std::string> keys;
  std::deque<std::string> texts;
  std::set<std::string> extensions;  // names of the extensions with objects in the document, at most kMaxMembers

  const JsonValue& root() const { return values.empty() ? kNoJson : values.front(); }
};

// Parses the text, skipping the parts that glTF readers ignore: extras, unknown root members, and extensions for which
// `knows` is false. Throws Error(kInput), naming the path, if the text is not JSON, nests more than 100 levels deep, or
// has an object with more than kMaxMembers members; Error(kMemory) if the values do not fit in memory.
JsonDocument parse_gltf_json(std::span<const unsigned char> text, const std::string& path,
                             const std::function<bool(std::string_view extension)>& knows);

}  // namespace ods
