// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The functions that make the built-in scenes, one per scene.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

Scene make_axis();
Scene make_mirrors();
Scene make_wineglass();
Scene make_fractal();
Scene make_room();
Scene make_toys();
Scene make_furnace();
Scene make_marker_spheres();
Scene make_lamp();
Scene make_slab();

}  // namespace ods
