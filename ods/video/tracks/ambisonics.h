// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Turns ambisonic sound: real spherical harmonics in ACN order with SN3D normalization (AmbiX; Nachbar et al., "AmbiX -
// A Suggested Ambisonics Format", 2011). X points to the front, Y to the left, Z up.
#pragma once
#include <glm/mat3x3.hpp>
#include <vector>

namespace ods {

// The order of a sound field with this number of channels, (order + 1)^2; 0 if there is no such order.
int ambisonic_order(int channels);

// The square matrix, row by row, that computes the channels of a turned field from the old ones: a source in direction
// d is in direction turn * d afterwards. Directions are a camera's: x right, y up, z back. Precondition: an
// orthogonal matrix.
std::vector<double> ambisonic_turn(int order, const glm::dmat3& turn);

}  // namespace ods
