// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How much surface a scene has.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// The area of every instance's surface in the world; 0 if it is hidden. An instance that is stretched counts by the
// mean of its scale.
std::vector<double> instance_areas(const Scene& scene);

}  // namespace ods
