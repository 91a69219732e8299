// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds faces that a file contains twice in one place, once for each side, as programs without double-sided materials
// write them. A ray meets both at one distance, so without this it is chance which of them it sees.
#pragma once
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// For each mesh, which of its triangles are doubled: their material is single-sided, and another triangle of a
// single-sided material that has an edge in common with them covers them and faces the other way. Corners are compared
// exactly, where the first visible instance of each mesh places them; the two sides of a face may be divided into
// triangles along different diagonals. Empty for a mesh without such triangles.
std::vector<std::vector<char>> find_doubled_faces(const Scene& scene);

}  // namespace ods
