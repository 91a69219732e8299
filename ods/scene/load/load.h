// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The one way in for everything that a user may name as a scene.
#pragma once
#include <string>

#include "ods/scene/gltf/gltf.h"
#include "ods/scene/scene.h"

namespace ods {

// A built-in scene's name (ods/scene/builtin/builtin.h), or the path of a glTF file; ./room is always a path. Throws
// Error(kInput); where nothing of that name exists it says which built-in scene may have been meant. Throws
// Error(kUsage): it has no scene of that number.
Scene load_scene(const std::string& name_or_path, const SceneOptions& options = {});

}  // namespace ods
