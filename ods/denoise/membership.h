// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Similarity weights of two pixels, 0..1. The constants were chosen by the error of the result against many samples:
// bench/denoise_bench.cpp.
#pragma once
#include <algorithm>

namespace ods {

inline float taper(float t) {
  const float u = std::max(1.0f - t, 0.0f);
  return u * u;
}

// The weight for the squared distances of the normals and of the albedos.
inline float feature_weight(float normals, float albedos) {
  constexpr float kNormal = 0.5f, kAlbedo = 0.2f;  // distances at which pixels have nothing in common
  return taper(normals * (1.0f / (kNormal * kNormal)) + albedos * (1.0f / (kAlbedo * kAlbedo)));
}

// Welch's test: the weight for the squared distance of the means, summed over the channels, and the sum of the two
// variances. It is nearly 1 up to a standard deviation, so that an outlier gives its neighbours as much as they give
// each other; otherwise its light would be lost.
inline float light_weight(float distance, float variance) {
  constexpr float kSigmas = 2.5f;
  const float t = std::min(distance / (3.0f * kSigmas * kSigmas * variance + 1e-30f), 1.0f);
  return taper(t * t);
}

}  // namespace ods
