// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a renderer returns: every eye an image of its own, so that nothing ever bleeds from one into the other.
#pragma once
#include <vector>

#include "ods/image/image.h"

namespace ods {

// How the values of a layer may be put together where a picture is reduced or enlarged.
enum class LayerRule {
  kLight,    // colour: averaged in linear light, alpha multiplied in
  kMean,     // numbers that may be averaged as they are: normals, albedo
  kNearest,  // never averaged: depth, ids, cryptomatte, variance
};

// Depth of a ray that met nothing.
inline constexpr float kFarDepth = 1e10f;

struct EyeImage {
  int eye = 0;     // kLeft, kRight or kMono (ods/kernel/camera/camera.h)
  Image radiance;  // 3 channels, Rec. 709 primaries
  Image depth;     // 1 channel: metres along the pixel centre's ray from its own origin; kFarDepth where it met nothing
  Image normal;    // 3 channels: world space, first hit, averaged over the pixel; 0 where nothing was met
  Image albedo;    // 3 channels: first hit, averaged over the pixel
  Image alpha{};  // 1 channel: the share of the pixel that met something; radiance is multiplied by it. Empty: all is 1
};

// One eye, or two in the order left, right. All of one size; depth, normal and albedo are empty where nobody asked for
// them (RenderOptions::layers), alpha likewise (RenderOptions::transparent).
struct Picture {
  std::vector<EyeImage> eyes;
};

}  // namespace ods
