// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the direction that is up. glTF specifies +Y, but some programs write +Z.
#pragma once
#include <string>

#include "ods/base/names.h"
#include "ods/scene/scene.h"

namespace ods {

enum class UpAxis { kAuto, kY, kZ };
inline constexpr NameRow<UpAxis> kUpAxisTable[] = {{UpAxis::kAuto, "auto"}, {UpAxis::kY, "y"}, {UpAxis::kZ, "z"}};
static_assert(has_every_member(kUpAxisTable));

// Returns the sign by which the scene lies on its back, because the file's z axis points up, as part of a message;
// empty if it does not, or if it is uncertain: either one of ods/stage/gravity.h, or most of its instances, eight or
// more, stand at one height along z, on a floor that is level there, a third of them taller than flat, and hardly any
// do so along y. At rest. Empty for files that Blender's own exporter wrote, which converts z up to y up: an upright
// board with samples on it would look the same to this test.
std::string why_on_its_back(const Scene& scene);

}  // namespace ods
