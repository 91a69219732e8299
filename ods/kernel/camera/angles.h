// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Angles and their functions, with the same values on every device. Vulkan allows a driver's sine an error of 5e-4, and
// Mesa's arc sine has one of 4e-4: half a pixel of a picture 8192 pixels wide. The C library's functions are accurate,
// but slower.
//
// Each is a polynomial on a small interval, fitted to the least maximum error, and the symmetries that lead there.
// tests/kernel/camera/angles_test.cpp compares them with double precision; the errors below are those that it allows.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/math.h"
namespace ods {
#endif

const float kPi = 3.14159265358979f;

// Cosine (x) and sine (y) of an angle. Error: at most 1e-7 for angles up to 1000, in either direction.
inline vec2 cos_sin(float angle) {
  // The angle less the nearest multiple of pi/2. The multiple's three parts are subtracted one by one, the longest
  // first; the product with each of the first two is exact.
  int quarter = int(angle * (2.0f / kPi) + (angle < 0.0f ? -0.5f : 0.5f));
  float turns = float(quarter);
  float r = ((angle - turns * 1.5703125f) - turns * 4.83751297e-4f) - turns * 7.54979013e-8f;
  float z = r * r;
  float s = r + r * z * (-0.166666552f + z * (0.00833217707f + z * -1.95171699e-4f));
  float c = 1.0f - 0.5f * z + z * z * (0.0416666456f + z * (-0.00138873665f + z * 2.44383064e-5f));
  bool odd = (quarter & 1) == 1;
  vec2 result = vec2(odd ? s : c, odd ? c : s);
  if (((quarter + 1) & 2) == 2) result.x = -result.x;
  if ((quarter & 2) == 2) result.y = -result.y;
  return result;
}

inline float cos_of(float angle) {
  return cos_sin(angle).x;
}

inline float sin_of(float angle) {
  return cos_sin(angle).y;
}

inline float tan_of(float angle) {
  vec2 both = cos_sin(angle);
  return both.y / both.x;
}

// The angle of the point (x, y) from the x axis, -pi..pi; 0 for (0, 0). Relative error: at most 2e-7.
inline float atan_of(float y, float x) {
  float across = abs(x);
  float up = abs(y);
  float high = max(across, up);
  float low = min(across, up);
  bool steep = up > across;
  // The angle is a multiple of pi/4, and up to pi/8 more or less.
  bool diagonal = low > 0.41421356f * high;
  float t = diagonal ? (low - high) / (low + high) : high > 0.0f ? low / high : 0.0f;
  float z = t * t;
  float more = t + t * z * (-0.333329558f + z * (0.199779257f + z * (-0.138798505f + z * 0.0806030855f)));
  float eighths = diagonal ? 1.0f : 0.0f;
  if (steep) {
    eighths = 2.0f - eighths;
    more = -more;
  }
  if (x < 0.0f) {
    eighths = 4.0f - eighths;
    more = -more;
  }
  float angle = eighths * 0.785398185f + (more - eighths * 2.18556951e-8f);  // pi/4 in two parts
  return y < 0.0f ? -angle : angle;
}

// The angle, -pi/2..pi/2, that has this sine. -1 <= x <= 1. Relative error: at most 3e-7.
inline float asin_of(float x) {
  return atan_of(x, sqrt((1.0f - x) * (1.0f + x)));
}

#ifdef __cplusplus
}  // namespace ods
#endif
