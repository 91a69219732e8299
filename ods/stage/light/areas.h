// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures the surface area of a scene.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// The area of every instance's surface in the world; 0 if it is hidden. For a stretched instance, the mean of its scale
// is used.
std::vector<double> instance_areas(const Scene& scene);

}  // namespace ods
