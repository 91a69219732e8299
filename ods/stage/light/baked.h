// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Detects scenes whose colours include their lighting: baked rooms, scans, painted models. Lighting them again looks
// wrong.
#pragma once
#include <string>

#include "ods/scene/scene.h"

namespace ods {

enum class Paint {
  kLit,      // its colours need light
  kUnlit,    // most of its surface is KHR_materials_unlit, and always rendered as painted
  kGlowing,  // most of its surface emits its painted colour, through a texture
  kNamed,    // most of its surface has a texture and a material whose name contains "baked" or "lightmap"
  kUnique,   // nearly all of its surface has a base colour texture and no other, of at least 100 triangles that share
             // no texel: a scan, or an unwrapping made for baking
};

// kLit unless one of the other descriptions fits. "Most" is half of the visible surface, "nearly all" four fifths.
// kUnique needs a place around the viewer (is_place): an object on its own looks good in new light, too.
Paint paint_of(const Scene& scene, bool is_place);

// The reason as text for a sentence about the scene: "its materials are unlit". Precondition: not kLit.
std::string paint_reason(Paint paint);

// Makes every material show its painted colour and emit no light: the emission if the base colour is black or has the
// same texture, else the base colour.
void show_paint(Scene& scene);

}  // namespace ods
