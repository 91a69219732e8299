// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Outlines of toon shading: a dark copy of an object, a little larger and turned inside out, of which one sees only
// the rim around the object because the backs of its faces are culled. For light it must not exist, or the object
// would stand in a closed black box.
#pragma once
#include <cstddef>

#include "ods/scene/scene.h"

namespace ods {

// Gives instances that are outlines the role kOutline, and returns their number. An outline is a mesh of a
// single-sided opaque material that is inside out, and whose fronts nearly everywhere face the front of another object
// within a few hundredths of its size. At rest.
size_t mark_outlines(Scene& scene);

}  // namespace ods
