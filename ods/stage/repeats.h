// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that lie exactly on others. A ray tests each of them, so a small file that lists one primitive a hundred
// thousand times makes each ray a hundred thousand times as slow, and shows nothing more.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// For each instance, whether an earlier one that is visible has the same triangles at the same place. Of materials that
// rays pass, by alpha or as glass, only instances of the same one count. At rest.
std::vector<char> find_repeats(const Scene& scene);

}  // namespace ods
