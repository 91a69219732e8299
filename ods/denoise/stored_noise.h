// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finished pictures with statistics, of our renderer or another: what to denoise, and how to save the result.
#pragma once
#include <cstdint>
#include <string>

#include "ods/picture/picture.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// Names of layers, in upper or lower case: `halfA` for channels halfA.R, halfA.G, halfA.B. A name without a point also
// finds a layer whose name ends in it: ViewLayer.halfA.
struct NoiseLayers {
  std::string variance{};  // of the pixel's mean; empty: `variance`, as ods render writes it
  std::string half_a{};    // pictures of half of the samples each; empty, and there is no variance: halfA and halfB, or
  std::string half_b{};    // other usual names
  bool needed = true;      // false: a picture without any of these is fine (ods/denoise/oidn.h)
};

struct StoredNoise {
  Picture picture;            // as denoise() needs it
  int64_t unusable = 0;       // pixels whose radiance or variance is NaN, infinite, negative or of one sample
  bool has_features = false;  // albedo or normals
};

// Reads a picture's radiance (of the layer `raw`, if it has been denoised before), variance and what else helps:
// samples, Z, normals (N or a layer called normal), albedo. Throws Error(kInput): no variance, or none that is usable,
// display-encoded; Error(kUsage): a named layer that the picture does not contain; Error(kMemory). `path`: for
// messages.
StoredNoise read_noise(const StoredPicture& stored, const NoiseLayers& layers, const std::string& path);

// The stored picture with the denoised radiance as its colour. The noisy colour is in the layer `raw`. Both must
// outlive the rows.
PictureRows denoised_rows(const StoredPicture& stored, const Picture& denoised);

}  // namespace ods
