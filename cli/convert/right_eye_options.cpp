// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/right_eye_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/console/console.h"

static ods::vec3 parse_gain(const std::string& text) {
  const std::vector<float> gain = parse_numbers(text);
  const auto is_gain = [](float value) { return std::isfinite(value) && value > 0.0f && value <= 1000.0f; };
  if (gain.size() == 1 && is_gain(gain[0])) return ods::vec3(gain[0]);
  if (gain.size() == 3 && std::all_of(gain.begin(), gain.end(), is_gain)) return {gain[0], gain[1], gain[2]};
  throw UsageError(
      fmt::format("--right-gain is RED,GREEN,BLUE or one number, above 0 and at most 1000, not '{}'", text));
}

void add_right_eye_options(Options& options, ods::EyeCorrection& right) {
  options.group("Right eye, if it does not match the left one (ods lint measures it)");
  options.number("--right-yaw", right.yaw, -180.0f, 180.0f, "turn it to the right, degrees");
  options.number("--right-pitch", right.pitch, -90.0f, 90.0f, "tilt it up, degrees: what it shows moves down");
  options.number("--right-roll", right.roll, -180.0f, 180.0f, "roll it clockwise, degrees");
  options.number("--right-raise", right.raise, -90.0f, 90.0f,
                 "move its picture up, degrees, by the same angle in all directions");
  options.number("--right-zoom", right.zoom, 0.1f, 10.0f, "enlarge its picture about the middle by this factor");
  options.custom(
      "--right-gain", "R,G,B", "1", [&](const std::string& text) { right.gain = parse_gain(text); },
      "multiply its linear light by these factors");
  options.number("--right-gamma", right.gamma, 0.1f, 10.0f, "raise its linear light to this power, before the gain");
}
