// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Suggestions for mistyped words.
#pragma once
#include <string>
#include <vector>

namespace ods {

// "; did you mean 'room'?", to append to a message; empty if no word is close.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& words);

}  // namespace ods
