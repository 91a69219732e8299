// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/waiting.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "ods/files/frames.h"

ods::OnWaiting note_waiting(const std::string& noun) {
  return [noun](const std::vector<int>& numbers, const std::string& holder) {
    const bool one = numbers.size() == 1;
    note(fmt::format("waiting for {}{} {}, which {} made by {}{}", noun, one ? "" : "s", ods::frames_text(numbers),
                     one ? "is being" : "are being", holder, one ? "" : " and others"));
  };
}

std::function<void(size_t missing)> note_late(const std::string& noun, float seconds) {
  return [noun, seconds](size_t missing) {
    note(fmt::format("waiting up to {:g} s for {} missing {}s", seconds, missing, noun));
  };
}
