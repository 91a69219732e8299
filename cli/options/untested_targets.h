// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a help text that lists the targets which were never tried in their own programs.
#pragma once
#include <string>

// "untested in their programs: usd, unity". Row has `name` and `tested`.
template <class Row, size_t kCount>
std::string untested_targets(const Row (&table)[kCount]) {
  std::string names;
  for (const Row& row : table) {
    if (!row.tested) names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  return "untested in their programs: " + names;
}
