// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/decimal.h"

#include <fmt/format.h>

#include <charconv>
#include <string>

namespace ods {

double decimal(float value) {
  double result = 0.0;
  const std::string text = fmt::format("{}", value);
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

}  // namespace ods
