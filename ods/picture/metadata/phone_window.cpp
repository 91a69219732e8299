// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/phone_window.h"

#include <fmt/format.h>

#include <algorithm>

namespace ods {

ProjectionSetting phone_window(std::optional<float> fov, Extent eye, std::vector<std::string>& guesses) {
  constexpr float kUsualFov = 63.4f;
  ProjectionSetting window = find_projection("perspective")->setting;
  window.fov = fov.value_or(kUsualFov);
  window.aspect = static_cast<float>(eye.width) / static_cast<float>(std::max(eye.height, 1));
  if (!fov) guesses.push_back(fmt::format("{} degrees across: its field of view is not recorded", kUsualFov));
  return window;
}

}  // namespace ods
