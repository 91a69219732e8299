// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The curve of the pole merges, for the studio: pixel x has the remaining fraction at x - 90 degrees of elevation, in
// red, and the part lost by 8 bits in green.
precision highp float;
precision highp int;
#define inline
#include "ods/kernel/camera/angles.h"
#include "ods/kernel/camera/merge.h"

uniform PoleMerge merges[2];  // top, bottom
out vec4 color;

void main() {
  float elevation = radians(gl_FragCoord.x - 90.5);
  float left = elevation < 0.0 ? merge_factor(merges[1], -elevation) : merge_factor(merges[0], elevation);
  float bits = clamp(left, 0.0, 1.0) * 255.0;
  color = vec4(floor(bits) / 255.0, fract(bits), 0.0, 1.0);
}
