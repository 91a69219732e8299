// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shadow catchers: objects that represent real objects in the footage, above all the ground. Only the shadows that
// other objects cast on them are visible, as black with an alpha of
//
//   1 - E / E0
//
// where E is the luminance of the irradiance that arrives directly from lights, emissive surfaces and the sky, and E0
// the luminance with only the catchers and the emitters in the scene; alpha is 0 where no light would arrive anyway. So
// compositing dims the background by the fraction of its light that the objects block. Light reflected by other objects
// does not count, and glass casts an opaque shadow. A catcher hides everything behind it. Mirrors and indirect light
// see its own material, so it reflects its colour onto objects standing on it.
// Pictures of such scenes need RenderOptions::transparent.
#pragma once
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// Makes all instances with this object or material name catchers. Returns false if there are none.
bool make_catchers(Scene& scene, const std::string& name);

// Returns whether the scene has catchers.
bool has_catchers(const Scene& scene);

// All names of objects and of used materials, without duplicates, in scene order; objects first.
std::vector<std::string> object_names(const Scene& scene);

}  // namespace ods
