// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The JSON of a glTF file. One flat list of values: 32 bytes each, made in one pass over the text, destroyed without
// allocating (a tree of nlohmann's allocates in its destructor, which ends the process when memory has run out).
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace ods {

inline const std::string kNoText;

// A value of a JsonDocument, valid as long as that is. What it contains follows it in the document's list: a copy of a
// list or an object is worth nothing.
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
  uint32_t length = 1;                // values up to its next neighbour: itself and what it contains
  const std::string* key = &kNoText;  // of an object's member
  const std::string* text = &kNoText;
  double number = 0.0;  // finite

  bool is_null() const { return kind == Kind::kNull; }
  bool is_number() const { return kind == Kind::kNumber; }
  bool is_text() const { return kind == Kind::kText; }
  bool is_list() const { return kind == Kind::kList; }
  bool is_object() const { return kind == Kind::kObject; }
  bool is_true() const { return kind == Kind::kTrue; }

  // Elements of a list, members of an object; of everything else none.
  Iterator begin() const { return {this + 1}; }
  Iterator end() const { return {this + length}; }
  size_t size() const;  // counts them

  // The member of that name; kNoJson where there is none, or where this is no object.
  const JsonValue& operator[](std::string_view name) const;
};

// What stands for a value that is absent: null.
inline const JsonValue kNoJson;

struct JsonDocument {
  std::vector<JsonValue> values;
  std::unordered_set<std::string> keys;
  std::deque<std::string> texts;

  const JsonValue& root() const { return values.empty() ? kNoJson : values.front(); }
};

// Objects with more members than this are not glTF; finding a member looks at all of them.
inline constexpr size_t kMaxMembers = 256;

// Parses the text, without what glTF readers skip: extras, root members that glTF does not have, and extensions that
// `knows` does not name. Throws Error(kInput), naming the path, where the text is not JSON, nests more than 100 levels
// deep, or has an object with more than kMaxMembers members; Error(kMemory) where the values do not fit in memory.
JsonDocument parse_gltf_json(std::span<const unsigned char> text, const std::string& path,
                             const std::function<bool(std::string_view extension)>& knows);

}  // namespace ods
