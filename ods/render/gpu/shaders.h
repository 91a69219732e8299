// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The compiled shaders of ods/render/gpu/shaders, made by the build.
#pragma once
#include <cstdint>
#include <span>

namespace ods {

std::span<const uint32_t> trace_shader();
std::span<const uint32_t> begin_shader();
std::span<const uint32_t> shade_shader();

}  // namespace ods
