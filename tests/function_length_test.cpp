// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// No function is longer than a reader can keep in mind.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/sources.h"

namespace {

namespace fs = std::filesystem;
using ods::all_sources, ods::read_lines, ods::Source, ods::source_folder;

size_t indent_of(const std::string& line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

// The lengths of the functions in a source in C++, GLSL or JavaScript, by the line at which they start, from 1. A
// function starts at a line that ends with { and is not a type, a namespace or a statement, and ends at the next } with
// the same indentation. Functions within functions count as a part of these.
std::map<size_t, size_t> function_lengths(const std::vector<std::string>& lines, bool is_script) {
  static const std::regex other(
      "(namespace|struct|class|enum|union|extern|if|for|while|switch|else|do|try|return|case|\\}|//).*");
  static const std::regex function(".*\\)( const)?( noexcept)?( override)? \\{"), script(".*(\\)|=>) \\{");
  std::map<size_t, size_t> lengths;
  for (size_t i = 0; i < lines.size(); i++) {
    const size_t indent = indent_of(lines[i]);
    const std::string text = lines[i].substr(indent);
    if (indent > 2 || !text.ends_with("{") || std::regex_match(text, other)) continue;
    if (!std::regex_match(text, is_script ? script : function)) continue;
    size_t end = i + 1;
    while (end < lines.size() && !(indent_of(lines[end]) == indent && lines[end][indent] == '}')) end++;
    lengths[i + 1] = end + 1 - i;
    i = end;
  }
  return lengths;
}

TEST(FunctionLength, IncludesMethodsAndScripts) {
  const std::vector<std::string> method = {"struct A {", "  inline void f(int x) {", "    x++;", "  }", "};"};
  EXPECT_EQ(function_lengths(method, false), (std::map<size_t, size_t>{{2, 3}}));
  const std::vector<std::string> script = {"export function f(a) {", "  if (a) {", "    g();", "  }", "}"};
  EXPECT_EQ(function_lengths(script, true), (std::map<size_t, size_t>{{1, 5}}));
}

TEST(FunctionLength, IsLimited) {
  for (const Source& source : all_sources()) {
    for (const auto& [line, length] : function_lengths(source.lines, false)) {
      EXPECT_LE(length, 62u) << source.path << ":" << line;
    }
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(source_folder()) / "web")) {
    const bool is_shader = entry.path().extension() == ".glsl";
    if (!is_shader && entry.path().extension() != ".js") continue;
    // A function in a script also holds its state, as a class does.
    for (const auto& [line, length] : function_lengths(read_lines(entry.path()), !is_shader)) {
      EXPECT_LE(length, is_shader ? 62u : 92u) << entry.path() << ":" << line;
    }
  }
}

TEST(FunctionLength, IsLimitedInPython) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(source_folder()) / "blender")) {
    if (entry.path().extension() != ".py") continue;
    const std::vector<std::string> lines = read_lines(entry.path());
    for (size_t i = 0; i < lines.size(); i++) {
      const size_t indent = indent_of(lines[i]);
      if (!std::string_view(lines[i]).substr(indent).starts_with("def ")) continue;
      size_t last = i;
      for (size_t at = i + 1;
           at < lines.size() && (lines[at].empty() || indent_of(lines[at]) > indent || lines[at][indent] == ')');
           at++) {
        if (!lines[at].empty()) last = at;
      }
      EXPECT_LE(last + 1 - i, 60u) << entry.path() << ":" << i + 1;
    }
  }
}

}  // namespace
