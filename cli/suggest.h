// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Did you mean?
#pragma once
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

// The number of letters to insert, delete or replace (Levenshtein).
inline size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// "; did you mean 'render'?", or nothing when no word is near.
inline std::string did_you_mean(const std::string& typed, const std::vector<std::string>& words) {
  auto nearer = [&](const std::string& a, const std::string& b) {
    return edit_distance(typed, a) < edit_distance(typed, b);
  };
  auto nearest = std::min_element(words.begin(), words.end(), nearer);
  if (nearest == words.end() || edit_distance(typed, *nearest) > 1 + nearest->size() / 4) return "";
  return "; did you mean '" + *nearest + "'?";
}
