// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The settings that a picture, a video or an unfinished one was made with, so that only work with the same settings is
// resumed.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

struct Setting {
  std::string name;   // chosen by the caller: "samples", "scene"
  std::string value;  // for a file, the MD5 of its contents
  std::string path;   // for a file, its path; otherwise empty
};
using Settings = std::vector<Setting>;

// Writes a line for each setting, with tabs between its fields, and a last line with the CRC-32 of these lines; parses
// such lines. Names, values and paths are one line each.
std::string settings_text(const Settings& settings);

// Returns nullopt if the text differs from what settings_text() wrote: truncated or changed.
std::optional<Settings> parse_settings(const std::string& text);

// The differences between `then` and `now`, for messages: "samples was 64, now 128; scene 'a.glb' has changed". At most
// three. Empty if there are none.
std::string settings_difference(const Settings& then, const Settings& now);

inline constexpr std::string_view kRestartRemedy = "`restart` discards it and starts over";

// Throws Error(kUsage) if the settings differ: "'PATH' was made with other options: samples was 64, now 128; REMEDY".
void expect_same_settings(const std::string& path, const Settings& then, const Settings& now,
                          std::string_view remedy = kRestartRemedy);

}  // namespace ods
