// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of a request that graphics cards cannot render yet. The shaders rely on it: they leave out what it names.
#pragma once
#include <cstddef>
#include <string>

#include "ods/render/render_options.h"
#include "ods/scene/scene.h"

namespace ods {

// Maximum number of triangles of all visible instances: the tree has a copy for each, 80 bytes.
inline constexpr size_t kMaxCardTriangles = 20'000'000;

// Returns what a picture has that cards cannot render yet, with the remedy; empty if they can render it. is_blurred:
// something moves while the shutter is open.
std::string gpu_lacks(const Scene& scene, const RenderOptions& options, bool is_blurred);

}  // namespace ods
