// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A light cache that is filled (ods/kernel/light_cache.h).
#pragma once
#include <vector>

#include "ods/kernel/scene_data.h"

namespace ods {

struct LightCells {
  vec3 viewer{0.0f};             // from here on, the farther the larger they are
  std::vector<CacheCell> table;  // a power of two of slots, or none
};

}  // namespace ods
