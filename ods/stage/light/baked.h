// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes whose colours hold their light already: baked rooms, scans, painted models. Lighting them again looks wrong.
#pragma once
#include <string>

#include "ods/scene/scene.h"

namespace ods {

enum class Paint {
  kLit,      // its colours await light
  kUnlit,    // most of its surface is KHR_materials_unlit: it is rendered as it is painted in any case
  kGlowing,  // most of its surface emits what it is painted with, through a texture
  kNamed,    // most of its surface has a texture and a material whose name says "baked" or "lightmap"
  kUnique,   // nearly all of its surface has a base colour texture and no other, of at least 100 triangles that share
             // no texel: a scan, or an unwrapping made for baking
};

// kLit unless one of the other descriptions fits. "Most" is half of the visible surface, "nearly all" four fifths.
// kUnique needs a place around the viewer (is_place): an object on its own looks as well in new light.
Paint paint_of(const Scene& scene, bool is_place);

// In words, for a sentence about the scene: "its materials are unlit". Precondition: not kLit.
std::string paint_reason(Paint paint);

// Makes every material show its colour as it is painted and light nothing: the emission where the base colour is black
// or has the same texture, else the base colour.
void show_paint(Scene& scene);

}  // namespace ods
