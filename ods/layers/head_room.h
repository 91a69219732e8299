// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include "ods/kernel/math.h"

namespace ods {

inline constexpr float kEyeRoom = 0.1f;  // metres: the smallest distance between the head box and a surface

// Throws Error(kUsage) if surfaces are in a head box or too near. free_half: half the side of the largest cube around
// the middle without a surface in it, metres. remedy: what else the user may change, after the largest box in the
// message.
void check_head_room(float free_half, vec3 size, std::string_view remedy);

}  // namespace ods
