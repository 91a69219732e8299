// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The filled cells of a light cache (ods/kernel/light_cache.h).
#pragma once
#include <vector>

#include "ods/kernel/scene_data.h"

namespace ods {

struct LightCells {
  vec3 viewer{0.0f};             // cells become larger with the distance from here
  std::vector<CacheCell> table;  // its size is a power of two, or 0
};

}  // namespace ods
