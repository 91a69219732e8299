// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads JSON that people may have edited: every value is checked where it is read, and what is wrong is an Error that
// names the file, the place in it and what should stand there. Keys that nobody asks for are named in a warning.
#pragma once
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

using Json = nlohmann::ordered_json;

// Brackets may lie 16 deep. Throws Error(kInput): `name`, which stands for the text in messages, is not JSON. `noun`:
// what it should be, "camera".
Json parse_json(std::string_view text, const std::string& name, const std::string& noun);

// One object of a file, and where it lies in it: "merge_top". Everything throws Error(kInput). A key that is missing
// leaves its variable as it is; one that is null is a value of the wrong type.
class JsonReader {
 public:
  JsonReader(const Json& json, std::string file, std::string noun, std::string place,
             std::vector<std::string>& warnings);
  JsonReader(const JsonReader&) = delete;
  JsonReader& operator=(const JsonReader&) = delete;

  // "'file' is no noun: place.key wanted"; where the key is null: "place.key wanted, not null"
  [[noreturn]] void fail(const std::string& key, const std::string& wanted) const;

  // A file's mark and version, which stand first: "omnistereo_camera": 1. Refuses what is newer than `newest`.
  void version(const std::string& mark, int newest);

  // The value of a key; nullptr: it is missing.
  const Json* find(const std::string& key);

  // Whether a key is null: for keys to which null is a value.
  bool is_null(const std::string& key);

  void number(const std::string& key, float& value, float low, float high);
  void integer(const std::string& key, int& value, int low, int high);
  void flag(const std::string& key, bool& value);
  bool vector(const std::string& key, glm::vec2& value, float low, float high);  // whether it is there
  bool vector(const std::string& key, glm::vec3& value, float low, float high);
  bool numbers(const std::string& key, std::vector<float>& values, size_t count, float low, float high);

  // At most 64 letters: what stands in messages. Empty: there is none.
  std::string word(const std::string& key);

  // The object under a key, read by `read(reader)`, if it is there.
  template <class Read>
  void part(const std::string& key, const Read& read) {
    const Json* found = find(key);
    if (!found) return;
    JsonReader reader(*found, file_, noun_, place_.empty() ? key : place_ + "." + key, warnings_);
    read(reader);
    reader.finish();
  }

  // Names the keys that nobody asked for.
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
