// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads finished pictures with statistics, from our renderer or another, for denoising, and saves the result.
#pragma once
#include <cstdint>
#include <string>

#include "ods/picture/picture.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// Names of layers, in upper or lower case: `halfA` for channels halfA.R, halfA.G, halfA.B. A name without a dot also
// finds a layer whose last component it is: ViewLayer.halfA.
struct NoiseLayers {
  std::string variance{};  // variance of the pixel's mean; if empty, `variance`, as written by ods render
  std::string half_a{};    // pictures of half of the samples each; if empty and without variance: halfA and halfB, or
  std::string half_b{};    // other common names
  bool needed = true;      // if false, none of these layers is required (ods/denoise/oidn.h)
};

struct StoredNoise {
  Picture picture;            // input for denoise()
  int64_t unusable = 0;       // pixels whose radiance or variance is NaN, infinite, negative or from one sample
  bool has_features = false;  // albedo or normals
};

// Reads a picture's radiance (from the layer `raw`, if it was denoised before), variance and other useful layers:
// samples, Z, normals (N or a layer called normal), albedo. Throws Error(kInput) if it has no usable variance or is
// display-encoded; Error(kUsage) if it lacks a named layer; Error(kMemory). `path`: for messages.
StoredNoise read_noise(const StoredPicture& stored, const NoiseLayers& layers, const std::string& path);

// The stored picture with the denoised radiance as its colour, and the noisy colour in the layer `raw`. Both must
// outlive the rows.
PictureRows denoised_rows(const StoredPicture& stored, const Picture& denoised);

}  // namespace ods
