// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the results of ods compare.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ods/image/compare.h"
#include "ods/picture/load_eyes.h"

struct CompareReport {
  std::array<std::string, 2> paths;
  std::array<ods::LoadedEyes, 2> files;
  bool in_code_values = false;  // else in linear light
  ods::Comparison comparison;
  std::optional<ods::ZTest> z;        // if both files have variance
  std::vector<std::string> exceeded;  // a line for each limit
};

void print_text(const CompareReport& report);
void print_json(const CompareReport& report);
