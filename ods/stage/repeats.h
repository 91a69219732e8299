// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds surfaces that coincide with others. A ray tests each of them, so a small file that lists one primitive a
// hundred thousand times makes each ray a hundred thousand times slower, without a visible difference.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// Flags each instance that has the same triangles and place as an earlier visible one. If rays may pass through
// the material, by alpha or as glass, it must be the same, too. At rest.
std::vector<char> find_repeats(const Scene& scene);

}  // namespace ods
