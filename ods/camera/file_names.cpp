// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/file_names.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "ods/base/text.h"
#include "ods/camera/layout.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

static std::vector<std::string> split_at_bars(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (c == '|') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

std::optional<int> eye_of_words(std::string_view name) {
  std::optional<int> eye;
  std::string word;
  for (size_t i = 0; i <= name.size(); i++) {
    if (i < name.size() && std::isalpha(static_cast<unsigned char>(name[i])) != 0) {
      word += name[i];
      continue;
    }
    word = small_letters(std::move(word));
    for (const EyeWords& eyes : kEyeWordsTable) {
      if (word != eyes.left && word != eyes.right) continue;
      const int found = word == eyes.left ? kLeft : kRight;
      if (eye && *eye != found) return std::nullopt;
      eye = found;
    }
    word.clear();
  }
  return eye;
}

std::optional<WordsInBraces> words_in_braces(const std::string& path, size_t count) {
  for (size_t begin = path.find('{'); begin != std::string::npos; begin = path.find('{', begin + 1)) {
    const size_t close = path.find_first_of("{}", begin + 1);
    if (close == std::string::npos || path[close] != '}') continue;
    WordsInBraces found{begin, close + 1, split_at_bars(path.substr(begin + 1, close - begin - 1))};
    if (found.words.size() == count) return found;
  }
  return std::nullopt;
}

bool names_faces(const std::string& path) {
  return words_in_braces(path, kFaceCount).has_value();
}

bool names_files(const std::string& path) {
  return names_eye(path) || names_faces(path);
}

static void add_faces(const std::string& path, std::vector<std::string>& files) {
  const std::optional<WordsInBraces> faces = words_in_braces(path, kFaceCount);
  if (!faces) return files.push_back(path);
  for (const std::string& word : faces->words) {
    files.push_back(path.substr(0, faces->begin) + word + path.substr(faces->end));
  }
}

std::vector<std::string> files_of(const std::string& path) {
  std::vector<std::string> files;
  if (!names_eye(path)) {
    add_faces(path, files);
    return files;
  }
  for (int eye : {kLeft, kRight}) add_faces(path_for_eye(path, eye), files);
  return files;
}

static bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

std::optional<std::string> joined_name(const std::vector<std::string>& files) {
  const std::string& first = files.front();
  size_t before = first.size(), after = first.size();
  for (const std::string& file : files) {
    const bool has_own = file.find_first_of("{|}") != std::string::npos;
    if (has_own && !names_faces(file)) return std::nullopt;
    before = std::min(before, static_cast<size_t>(std::ranges::mismatch(first, file).in1 - first.begin()));
    const auto backwards = std::mismatch(first.rbegin(), first.rend(), file.rbegin(), file.rend());
    after = std::min(after, static_cast<size_t>(backwards.first - first.rbegin()));
  }
  while (before > 0 && is_of_word(first[before - 1])) before--;
  const auto shortest = std::ranges::min(files, {}, &std::string::size).size();
  after = std::min(after, shortest - before);
  while (after > 0 && is_of_word(first[first.size() - after])) after--;
  std::string words;
  for (const std::string& file : files) {
    words += (&file == &first ? "" : "|") + file.substr(before, file.size() - before - after);
  }
  return first.substr(0, before) + "{" + words + "}" + first.substr(first.size() - after);
}

// Removes [begin, end) and one of the separators around it; with the slash if it is a whole folder.
static void remove_word(std::string& path, size_t begin, size_t end) {
  constexpr std::string_view kSeparators = "_-. ";
  const auto separates = [&](size_t at) {
    return at < path.size() && kSeparators.find(path[at]) != std::string_view::npos;
  };
  const bool starts_folder = begin == 0 || path[begin - 1] == '/';
  if (starts_folder && (separates(end) || (end < path.size() && path[end] == '/'))) end++;
  if (!starts_folder && separates(begin - 1)) begin--;
  path.erase(begin, end - begin);
}

std::string without_words(const std::string& path) {
  std::string result = path;
  for (const size_t count : {size_t{2}, kFaceCount}) {
    while (const auto found = words_in_braces(result, count)) remove_word(result, found->begin, found->end);
  }
  for (const std::string_view word : {"%V", "%v"}) {
    for (size_t at = result.find(word); at != std::string::npos; at = result.find(word)) {
      remove_word(result, at, at + word.size());
    }
  }
  return result;
}

}  // namespace ods
