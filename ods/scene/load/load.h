// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Loads everything that users can specify as a scene.
#pragma once
#include <string>

#include "ods/scene/gltf/gltf.h"
#include "ods/scene/scene.h"

namespace ods {

// A built-in scene's name (ods/scene/builtin/builtin.h), or the path of a glTF file; ./room is always a path. Throws
// Error(kInput); if nothing of that name exists, the message suggests a built-in scene with a similar name. Throws
// Error(kUsage) if the file has no scene with that index, or no variant of that name.
Scene load_scene(const std::string& name_or_path, const SceneOptions& options = {});

}  // namespace ods
