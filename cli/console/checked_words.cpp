// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/checked_words.h"

namespace {

struct WordsAreFine {};

bool checks = false;
std::vector<GivenWord> last_given;

}  // namespace

std::optional<std::vector<GivenWord>> checked_words(const std::function<void()>& command) {
  struct Checking {
    Checking() { checks = true; }
    ~Checking() { checks = false; }
  } checking;
  try {
    command();
    return std::nullopt;
  } catch (const WordsAreFine&) {
    return last_given;
  }
}

bool only_checks() {
  return checks;
}

void end_check() {
  throw WordsAreFine();
}

void keep_given(std::vector<GivenWord> given) {
  last_given = std::move(given);
}
