// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Suggestions for mistyped words and for files that were passed to the wrong command.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace ods {

// "; did you mean 'room'?", to append to a message; empty if no word is close.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& words);

// "; it is a video: ods probe, lint, convert, comfort, inject, view and over take videos", to append to a message that
// rejects a file which begins with these bytes (64 are enough). Empty if they are not the start of a picture, video or
// scene.
std::string taken_by(std::string_view start);

}  // namespace ods
