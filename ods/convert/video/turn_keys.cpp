// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/video/turn_keys.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "ods/base/error.h"
#include "ods/files/read_file.h"

namespace ods {

// Parses a plain decimal number. Returns nullopt for other texts.
static std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> parse_time(std::string_view text) {
  double seconds = 0.0;
  for (int parts = 1; parts <= 3; parts++) {
    const size_t colon = text.find(':');
    const std::optional<double> part = parse_number(text.substr(0, colon));
    if (!part || *part < 0.0 || (parts > 1 && *part >= 60.0)) return std::nullopt;
    seconds = 60.0 * seconds + *part;
    if (colon == std::string_view::npos) return seconds;
    if (*part != std::floor(*part)) return std::nullopt;
    text.remove_prefix(colon + 1);
  }
  return std::nullopt;
}

static std::optional<TurnKey> parse_key(const std::vector<std::string>& words) {
  if (words.size() != 2 && words.size() != 4) return std::nullopt;
  const std::optional<double> time = parse_time(words[0]);
  std::vector<float> angles;
  for (size_t i = 1; i < words.size(); i++) {
    const std::optional<double> angle = parse_number(words[i]);
    if (!angle || std::abs(*angle) > 360.0) return std::nullopt;
    angles.push_back(static_cast<float>(*angle));
  }
  if (!time) return std::nullopt;
  if (angles.size() == 1) return TurnKey{*time, {0.0f, 0.0f, angles[0]}};
  return TurnKey{*time, {angles[0], angles[1], angles[2]}};
}

constexpr size_t kMaxBytes = 16 << 20;

std::vector<TurnKey> read_turn_keys(const std::string& path) {
  std::istringstream lines(read_text(path, kMaxBytes));
  std::vector<TurnKey> keys;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    number++;
    std::istringstream fields_of_line(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; fields_of_line >> word;) words.push_back(word);
    if (words.empty()) continue;
    const std::optional<TurnKey> key = parse_key(words);
    if (!key || (!keys.empty() && key->seconds <= keys.back().seconds)) {
      throw Error(
          ErrorKind::kInput,
          fmt::format("'{}', line {}: a keyframe is TIME ROLL or TIME YAW PITCH ROLL, such as '0:10.5 -2.5', and "
                      "times ascend",
                      path, number));
    }
    keys.push_back(*key);
  }
  if (keys.empty()) throw Error(ErrorKind::kInput, fmt::format("'{}' has no keyframe", path));
  return keys;
}

ViewAngles turned_at(const std::vector<TurnKey>& keys, double seconds) {
  size_t next = 0;
  while (next < keys.size() && keys[next].seconds <= seconds) next++;
  if (next == 0) return keys.front().turned;
  if (next == keys.size()) return keys.back().turned;
  const TurnKey &a = keys[next - 1], &b = keys[next];
  const float share = static_cast<float>((seconds - a.seconds) / (b.seconds - a.seconds));
  const auto between = [&](float ViewAngles::*angle) {
    return a.turned.*angle + (b.turned.*angle - a.turned.*angle) * share;
  };
  return {between(&ViewAngles::yaw), between(&ViewAngles::pitch), between(&ViewAngles::roll)};
}

}  // namespace ods
