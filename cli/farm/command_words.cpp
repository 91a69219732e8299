// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/command_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cli/console/console.h"
#include "ods/files/frames.h"

namespace fs = std::filesystem;

namespace {

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_pattern(const std::string& path) {
  return path.find("%V") != std::string::npos || ods::frame_names(path).has_value() ||
         ods::frame_names(fs::path(path).parent_path().native()).has_value();
}

// The folder of the files that a pattern matches: the path before its first mark.
std::string folder_of_pattern(const std::string& path) {
  const size_t mark = std::min(path.find_first_of("#@%${"), path.size());
  return path.substr(0, path.rfind('/', mark));
}

}  // namespace

std::vector<ods::PlanPath> find_paths(std::vector<GivenWord>& given) {
  std::vector<ods::PlanPath> paths;
  for (GivenWord& word : given) {
    const PathUse use = word.kind.use_of(word.value);
    if (use == PathUse::kNone) continue;
    word.value = fs::absolute(word.value).lexically_normal().native();
    const bool pattern = is_pattern(word.value), is_folder = pattern || fs::is_directory(word.value);
    paths.push_back({pattern ? folder_of_pattern(word.value) : word.value, use == PathUse::kOutput, is_folder});
  }
  return paths;
}

void check_inputs(const std::vector<ods::PlanPath>& paths) {
  for (const ods::PlanPath& path : paths) {
    if (path.is_output) continue;
    std::error_code error;
    const bool is_there = path.is_folder ? fs::is_directory(path.path, error) : fs::is_regular_file(path.path, error);
    if (is_there && (path.is_folder || std::ifstream(path.path, std::ios::binary).good())) continue;
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("cannot read '{}': {}", path.path, is_there ? "no permission" : "no such file"));
  }
}

std::vector<GivenWord> without(const std::vector<GivenWord>& given, const std::vector<std::string>& names) {
  std::vector<GivenWord> rest;
  std::ranges::copy_if(given, std::back_inserter(rest), [&](const GivenWord& w) { return !is_in(names, w.name); });
  return rest;
}

std::vector<GivenWord> only(const std::vector<GivenWord>& given, const std::vector<std::string>& names) {
  std::vector<GivenWord> rest;
  std::ranges::copy_if(given, std::back_inserter(rest), [&](const GivenWord& w) { return is_in(names, w.name); });
  return rest;
}

void refuse(const std::vector<GivenWord>& given, const std::vector<std::string>& names, const std::string& why) {
  for (const GivenWord& word : given) {
    if (is_in(names, word.name)) throw UsageError(fmt::format("{}: {}", word.name, why));
  }
}

std::vector<std::string> command_words(const std::string& command, const std::vector<GivenWord>& given,
                                       const std::vector<std::string>& more) {
  std::vector<std::string> words = {command};
  for (const GivenWord& word : given) {
    const bool is_flag = word.value.empty(), looks_like_option = word.value.starts_with("-");
    if (word.name.empty()) {
      words.push_back(word.value);
    } else if (is_flag) {
      words.push_back(word.name);
    } else if (looks_like_option && word.name.starts_with("--")) {
      words.push_back(word.name + "=" + word.value);
    } else {
      words.insert(words.end(), {word.name, word.value});
    }
  }
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
