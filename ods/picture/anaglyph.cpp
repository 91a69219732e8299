// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/anaglyph.h"

#include <cassert>

namespace ods {

static vec3 dubois(vec3 left, vec3 right) {
  return vec3(
      0.437f * left.x + 0.449f * left.y + 0.164f * left.z - 0.011f * right.x - 0.032f * right.y - 0.007f * right.z,
      -0.062f * left.x - 0.062f * left.y - 0.024f * left.z + 0.377f * right.x + 0.761f * right.y + 0.009f * right.z,
      -0.048f * left.x - 0.050f * left.y - 0.017f * left.z - 0.026f * right.x - 0.093f * right.y + 1.234f * right.z);
}

vec3 anaglyph_color(Layout layout, vec3 left, vec3 right) {
  assert(is_anaglyph(layout));
  if (layout == Layout::kAnaglyphDubois) return clamp(dubois(left, right), 0.0f, 1.0f);
  const float luminance = 0.2126f * left.x + 0.7152f * left.y + 0.0722f * left.z;
  return vec3(layout == Layout::kAnaglyphHalf ? luminance : left.x, right.y, right.z);
}

}  // namespace ods
