// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene made in code, written in the way of a user's program.
#pragma once
#include "tests/support/gltf_builder.h"

namespace ods {

// The scene as a .glb: meshes, instances, lamps, and materials of metallic-roughness with emission, transmission and
// volume. Each mesh has the texture coordinates of its base colour. Its environment and its view points are left out,
// as by most programs.
Binary glb_of(const Scene& scene);

}  // namespace ods
