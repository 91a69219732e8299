// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangles with fewer corners, by meshoptimizer.
#pragma once
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// Numbers the different positions in the order of their first ones, and returns the number of each.
std::vector<uint> first_equal(const std::vector<vec3>& positions);

enum class Borders { kMove, kStay };

// Triangles of some of the same positions, whose surface is nowhere farther than `error` from that of the given ones.
// kStay: edges that only one triangle has remain.
std::vector<uvec3> simplified(const std::vector<vec3>& positions, const std::vector<uvec3>& triangles, float error,
                              Borders borders = Borders::kMove);

// Leaves out the positions that no triangle uses. Returns the index of the old position of each new one.
std::vector<uint> leave_out_unused(std::vector<vec3>& positions, std::vector<uvec3>& triangles);

}  // namespace ods
