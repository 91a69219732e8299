// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The pixel filter by importance sampling: each sample's position is drawn from the filter, so every sample has the
// same weight and belongs to one pixel, and pixels can be rendered in any order.
// Source: Ernst, Stamminger and Greiner, "Filter Importance Sampling", 2006.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/camera/angles.h"
#include "ods/kernel/scene_view.h"
namespace ods {
#endif

const int kFilterBlackmanHarris = 0;  // radius 1.5 pixels
const int kFilterBox = 1;             // the pixel itself

// The filter at an offset from the pixel's centre, over its value there.
inline float filter_value(int shape, float offset) {
  if (shape == kFilterBox) return abs(offset) <= 0.5f ? 1.0f : 0.0f;
  if (abs(offset) >= 1.5f) return 0.0f;
  float c = cos_of(2.0943951f * offset);  // 2 pi / 3
  float c2 = 2.0f * c * c - 1.0f;         // the cosine of the double angle, and of the triple one
  float c3 = c * (2.0f * c2 - 1.0f);
  return 0.35875f + 0.48829f * c + 0.14128f * c2 + 0.01168f * c3;
}

#ifdef __cplusplus
struct FilterSampler : SceneView {
#endif

  // Offset from the pixel's centre along one axis, in pixels.
  inline float filter_offset(int shape, float u) {
    if (shape == kFilterBox) return u - 0.5f;
    float at = u * float(kFilterSize - 1);
    int i = min(int(at), kFilterSize - 2);
    return mix(scene_table(kFilterTable + i), scene_table(kFilterTable + i + 1), at - float(i));
  }

  // Image position of a sample of pixel (x, y). It may be outside 0..1: the camera is defined there too.
  inline vec2 filtered_position(int shape, int x, int y, int width, int height, vec2 u) {
    return vec2((float(x) + 0.5f + filter_offset(shape, u.x)) / float(width),
                (float(y) + 0.5f + filter_offset(shape, u.y)) / float(height));
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
