// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
// stand-in
#pragma once
#include <string>

#include "ods/scene/scene.h"
namespace ods {
struct SceneOptions {
  int scene = -1;
};
Scene load_scene(const std::string& path, const SceneOptions& options = {});
}  // namespace ods
