// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shadow catchers: objects that stand for what is in the footage already, the ground above all. Of them only the
// shadows are seen which the others cast on them, black with an alpha of
//
//   1 - E / E0
//
// where E is the luminance of the irradiance that comes straight from lamps, glowing surfaces and the sky, and E0 the
// same were only the catchers and what glows there; 0 where no light would come anyway. So what is laid behind is
// dimmed by what the objects take from its light. Light that others throw back does not count, and glass casts the
// shadow of a board. A catcher hides what stands behind it, and is its own material to mirrors and to light: it throws
// its colour up at what stands on it. Pictures of such scenes are transparent ones (RenderOptions).
#pragma once
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

// Makes catchers of all instances whose object or material has this name. False: there is none.
bool make_catchers(Scene& scene, const std::string& name);

// Whether there are any.
bool has_catchers(const Scene& scene);

// Every name of an object and of a material that is worn, once, in the order of the scene; objects first.
std::vector<std::string> object_names(const Scene& scene);

}  // namespace ods
