// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/render_options.h"

#include <fmt/format.h>

#include <cstdio>

#include "ods/kernel/camera/camera.h"

namespace ods {

std::vector<int> eye_list(Eyes eyes) {
  switch (eyes) {
    case Eyes::kBothEyes:
      return {kLeft, kRight};
    case Eyes::kLeftEye:
      return {kLeft};
    case Eyes::kRightEye:
      return {kRight};
    case Eyes::kMonoEye:
      return {kMono};
  }
  return {};
}

std::optional<Part> parse_part(const std::string& text) {
  Part part;
  char end = 0;
  const bool is_part = std::sscanf(text.c_str(), "%d/%d%c", &part.number, &part.count, &end) == 2 && part.number >= 1 &&
                       part.number <= part.count && part.count <= kMaxSamples;
  return is_part ? std::optional(part) : std::nullopt;
}

std::string part_text(const Part& part) {
  return fmt::format("{}/{}", part.number, part.count);
}

SampleRange samples_of_part(const RenderOptions& options) {
  const auto border = [&](int64_t part) { return static_cast<int>(options.samples * part / options.part.count); };
  return {border(options.part.number - 1), border(options.part.number)};
}

}  // namespace ods
