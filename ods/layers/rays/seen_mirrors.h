// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The flat mirrors that are worth a second world behind them.
#pragma once
#include <vector>

#include "ods/layers/rays/first_hits.h"

namespace ods {

inline constexpr size_t kMostMirrors = 8;

// Returns the mirrors that an eye in the middle of a box sees under 0.1 square degrees or more, turned to it;
// the largest come first, and there are at most kMostMirrors. Only those whose surroundings hide what lies behind their
// plane, for eyes anywhere in the box: as on a wall, but not of a mirror that stands free, beside which the world behind
// it would be seen. size: of the box, metres. Precondition: `hits` has no mirrors yet.
std::vector<FlatMirror> seen_mirrors(const FirstHits& hits, vec3 middle, vec3 size);

}  // namespace ods
