// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Assimp's command, which converts the geometry, plain materials and pictures of a scene; not its lights, cameras and
// world.
#pragma once
#include <string>

bool has_assimp();

// Leaves scene.glb, pictures included, and bridge.json in the folder. A picture that is missing or cannot be read is a
// warning there. Throws Error(kInput): Assimp cannot read the scene, or takes longer than these seconds.
void run_assimp(const std::string& scene, const std::string& folder, float seconds);
