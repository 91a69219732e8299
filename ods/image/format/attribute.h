// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A named value in an image file's header: text or numbers.
#pragma once
#include <string>
#include <variant>
#include <vector>

namespace ods {

struct Attribute {
  std::string name;
  std::variant<int, float, std::string, std::vector<float>, std::vector<std::string>> value;
};

}  // namespace ods
