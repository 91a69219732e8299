// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Capitals, digits and a few symbols as straight strokes: lettering for generated geometry.
#pragma once
#include <string_view>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

struct Stroke {
  vec2 from;
  vec2 to;
};

// One line of text centred at the origin, x to the right and y up. A letter is 6 high and 4 wide; letters are 6 apart.
// Supports A-Z, 0-9, space and + - . : /; any other character leaves a gap.
std::vector<Stroke> text_strokes(std::string_view text);

}  // namespace ods
