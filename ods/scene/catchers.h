// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shadow catchers: objects that represent what is in the footage already, above all the ground. Only the shadows that
// other objects cast on them are visible, as black with an alpha of
//
//   1 - E / E0
//
// where E is the luminance of the irradiance that arrives directly from lights, emissive surfaces and the sky, and E0
// the same with only the catchers and the emitters in the scene; alpha is 0 where no light would arrive anyway. So
// compositing dims the background by what the objects block of its light. Light reflected by other objects does not
// count, and glass casts an opaque shadow. A catcher hides what is behind it. Mirrors and indirect light see its own
// material, so it reflects its colour onto objects standing on it.
// Pictures of such scenes need RenderOptions::transparent.
#pragma once
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// Makes all instances with this object or material name catchers. False if there are none.
bool make_catchers(Scene& scene, const std::string& name);

// Whether the scene has catchers.
bool has_catchers(const Scene& scene);

// Every name of an object and of a used material, without duplicates, in scene order; objects first.
std::vector<std::string> object_names(const Scene& scene);

}  // namespace ods
