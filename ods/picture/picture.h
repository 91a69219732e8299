// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A renderer's result: each eye is a separate image, so that no pixel mixes the two.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "ods/image/image.h"

namespace ods {

// The method of combining a layer's values when a picture is resized.
enum class LayerRule {
  kLight,    // colour: averaged in linear light, premultiplied by alpha
  kMean,     // values that may be averaged: normals, albedo
  kNearest,  // never averaged: depth, ids, cryptomatte, variance
};

// Depth of a ray that hit nothing.
inline constexpr float kFarDepth = 1e10f;

// Returns whether a depth belongs to a surface: neither a ray that hit nothing, nor invalid (NaN, 0 or less).
inline bool is_surface(float depth) {
  return depth > 0.0f && depth < 0.1f * kFarDepth;
}

// 1 / metres: nearly linear over the picture of a plane, and 0 where there is no surface.
inline float inverse_depth(float depth) {
  return is_surface(depth) ? 1.0f / depth : 0.0f;
}

// Returns whether adjacent pixels are on one surface, instead of on an object and its background. Both as 1 / metres, 0
// where there is no surface.
inline bool is_one_surface(float a, float b) {
  return std::abs(a - b) <= 0.1f * std::max(a, b);
}

struct EyeImage {
  int eye = 0;     // kLeft, kRight or kMono (ods/kernel/camera/camera.h)
  Image radiance;  // 3 channels, Rec. 709 primaries
  Image depth;     // 1 channel: metres along the pixel centre's ray from its own origin; kFarDepth for no hit
  Image normal;    // 3 channels: world space, first hit, averaged over the pixel; 0 for no hit
  Image albedo;    // 3 channels: first hit, averaged over the pixel
  Image alpha{};   // 1 channel: coverage; radiance is premultiplied by it. If empty, 1 everywhere

  // The noise of the radiance, for denoising.
  Image variance{};  // 3 channels: of the pixel's mean, as if its samples were independent
  Image samples{};   // 1 channel: number of samples of the pixel
  Image raw{};       // 3 channels: the radiance before it was denoised
};

// One eye, or left then right, of equal size. Depth, normal and albedo are empty unless requested
// (RenderOptions::layers), and so are alpha (RenderOptions::transparent), variance and samples
// (RenderOptions::statistics).
struct Picture {
  std::vector<EyeImage> eyes;
  double samples_taken = 0.0;  // total number of samples of all pixels taken by the renderer
};

}  // namespace ods
