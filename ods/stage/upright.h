// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Which way is up. glTF says +Y, but some programs write +Z.
#pragma once
#include "ods/base/names.h"
#include "ods/scene/scene.h"

namespace ods {

enum class UpAxis { kAuto, kY, kZ };
inline constexpr NameRow<UpAxis> kUpAxisTable[] = {{UpAxis::kAuto, "auto"}, {UpAxis::kY, "y"}, {UpAxis::kZ, "z"}};
static_assert(has_every_member(kUpAxisTable));

// Whether the scene lies on its back, since the file's z axis points up: most of its instances, eight or more, stand at
// one height along z, on a floor that is level there, and next to none do so along y. At rest. Not of Blender's exports,
// which turn z up into y up: an upright board with samples on it is the same to that measure.
bool lies_on_its_back(const Scene& scene);

}  // namespace ods
