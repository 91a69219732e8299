// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/head_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"

namespace ods {

void check_head_room(float free_half, vec3 size, std::string_view remedy) {
  const float half = 0.5f * std::max({size.x, size.y, size.z});
  const float largest = std::floor(200.0f * (free_half - kEyeRoom)) / 100.0f;
  if (free_half >= half + kEyeRoom) return;
  if (largest <= 0.0f) {
    throw Error(
        ErrorKind::kUsage,
        fmt::format("the head box has no room: a surface is {:.2f} m from its middle, and the eyes need {:.1f} m "
                    "in front of them{}",
                    free_half, kEyeRoom, remedy.empty() ? "" : "; choose another `position`"));
  }
  throw Error(
      ErrorKind::kUsage,
      fmt::format("the head box is too large: a surface is {:.2f} m from its middle, and the eyes need {:.1f} m "
                  "in front of them; choose a `box` of at most {:.2f}{}",
                  free_half, kEyeRoom, largest, remedy));
}

}  // namespace ods
