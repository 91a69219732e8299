// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The compiled shaders of ods/render/gpu/shaders, made by the build.
#pragma once
#include <cstdint>
#include <span>

namespace ods {

struct GpuShaders {
  std::span<const uint32_t> begin;
  std::span<const uint32_t> trace;
  std::span<const uint32_t> shade;
};

// whole: for scenes with layers of materials or shadow catchers. Drivers inline every function, and these are a third of
// the kernel.
GpuShaders gpu_shaders(bool whole);

}  // namespace ods
