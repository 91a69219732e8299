// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The GLSL vocabulary for C++. Only C++ reads this file: a shader has these words built in.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace ods {
using glm::abs, glm::acos, glm::all, glm::any, glm::asin, glm::atan, glm::bitfieldReverse, glm::clamp, glm::cos,
    glm::cross, glm::dot, glm::exp, glm::floatBitsToInt, glm::floatBitsToUint, glm::floor, glm::fract,
    glm::intBitsToFloat, glm::isinf, glm::isnan, glm::length, glm::log, glm::max, glm::min, glm::mix, glm::normalize,
    glm::pow, glm::reflect, glm::sign, glm::sin, glm::smoothstep, glm::sqrt, glm::tan;
using glm::ivec2, glm::uint, glm::uvec2, glm::uvec3, glm::vec2, glm::vec3, glm::vec4;
}  // namespace ods
#endif
