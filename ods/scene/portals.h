// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Portals: the window panes through which a room sees its sky. Most rays aimed at the whole sky hit walls.
#pragma once
#include <functional>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// The flat, nearly rectangular panes of clear thin glass, the largest first, at most kMaxPortals. Panes may be single
// sheets or thin boxes, and many may be one mesh.
inline constexpr size_t kMaxPortals = 8;
std::vector<Portal> find_portals(const Scene& scene);

// Returns whether the viewer sees little sky, and nearly all of it through the portals. escapes: whether a ray from the
// viewer leaves the scene, not counting clear glass.
bool show_the_sky(const std::vector<Portal>& portals, vec3 viewer, const std::function<bool(vec3 direction)>& escapes);

}  // namespace ods
