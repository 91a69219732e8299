// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads JSON that people may have edited. Every value is checked as it is read; an invalid one is an Error that names
// the file, the key's path and the expected value. Unknown keys produce a warning.
#pragma once
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

using Json = nlohmann::ordered_json;

// Returns null for infinity and NaN, which JSON cannot express.
Json json_number(double value);

// Throws Error(kInput) if the text is not JSON or nests deeper than 16 levels. `name` stands for the text in messages;
// `noun` is the expected content, such as "camera".
Json parse_json(std::string_view text, const std::string& name, const std::string& noun);

// One object of a file, and its path: "merge_top". All functions throw Error(kInput). A missing key leaves its variable
// unchanged; null counts as a value of the wrong type.
class JsonReader {
 public:
  JsonReader(const Json& json, std::string file, std::string noun, std::string place,
             std::vector<std::string>& warnings);
  JsonReader(const JsonReader&) = delete;
  JsonReader& operator=(const JsonReader&) = delete;

  // Throws an Error that names the file, the path of the key and the expected value.
  [[noreturn]] void fail(const std::string& key, const std::string& wanted) const;

  // Checks the file's format key and version: "omnistereo_camera": 1. Rejects versions above `newest`.
  void version(const std::string& mark, int newest);

  // The value of a key; nullptr if it is missing.
  const Json* find(const std::string& key);

  // Returns whether a key is null, for keys that allow null.
  bool is_null(const std::string& key);

  void number(const std::string& key, float& value, float low, float high);
  void integer(const std::string& key, int& value, int low, int high);
  void flag(const std::string& key, bool& value);
  bool vector(const std::string& key, glm::vec2& value, float low, float high);  // returns whether the key is present
  bool numbers(const std::string& key, std::vector<float>& values, size_t count, float low, float high);

  // Reads a string of at most 64 characters, short enough for a message. Empty if the key is missing.
  std::string word(const std::string& key);

  // If the key is present, calls `read(reader)` with its object.
  template <class Read>
  void part(const std::string& key, const Read& read) {
    const Json* found = find(key);
    if (!found) return;
    JsonReader reader(*found, file_, noun_, place_.empty() ? key : place_ + "." + key, warnings_);
    read(reader);
    reader.finish();
  }

  // Warns about every key that was not read.
  void finish();

 private:
  float checked(const Json& json, const std::string& key, float low, float high) const;

  const Json& json_;
  std::string file_;
  std::string noun_;
  std::string place_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> known_;
};

}  // namespace ods
