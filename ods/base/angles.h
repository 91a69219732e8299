// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Angles in radians.
#pragma once
#include <numbers>

namespace ods {

inline constexpr double kDegree = std::numbers::pi / 180.0;
inline constexpr double kArcMinute = kDegree / 60.0;

}  // namespace ods
