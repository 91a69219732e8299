// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// GLSL's types and functions for C++. Only C++ reads this file; shaders have these names built in.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace ods {
using glm::abs, glm::all, glm::asin, glm::atan, glm::bitfieldReverse, glm::clamp, glm::cos, glm::cross, glm::dot,
    glm::exp, glm::floatBitsToInt, glm::floor, glm::fract, glm::intBitsToFloat, glm::length, glm::log, glm::max,
    glm::min, glm::mix, glm::normalize, glm::pow, glm::sign, glm::sin, glm::smoothstep, glm::sqrt, glm::tan;
using glm::uint, glm::uvec3, glm::vec2, glm::vec3, glm::vec4;
}  // namespace ods
#endif
