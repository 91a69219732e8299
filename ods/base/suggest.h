// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Did you mean?
#pragma once
#include <string>
#include <vector>

namespace ods {

// "; did you mean 'room'?", ready to stand at the end of a message; empty when no word is near.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& words);

}  // namespace ods
