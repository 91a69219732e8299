// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Puts a scene as an object into another one.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// The matrix of an object whose own origin is put at a place and that is turned about +Y, in degrees, counter-clockwise
// as seen from above.
glm::dmat4 place_of_object(vec3 at, float turn);

// Appends everything that an object contains but its view points, its environment and its notes to users: meshes,
// materials, textures, instances, names, lights and clips. Indices of what the scene had before stay the same. The
// clips of both may play together. Throws Error(kInput) if both together have more texels than a scene can hold.
// Preconditions: both scenes are at rest and as the loader returned them; the matrix is finite, and moves and turns
// only.
void join(Scene& scene, const Scene& object, const glm::dmat4& place);

}  // namespace ods
