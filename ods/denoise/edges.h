// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pixels that an edge crosses are unlike all others, so the passes leave them noisy. But an edge mixes the normals and
// the albedos of the adjacent surfaces in the same proportion as their light: light is a linear function of these
// features.
#pragma once
#include "ods/denoise/noisy_picture.h"

namespace ods {

// Fits that function to the 24 pixels around each pixel, by weighted least squares with a small ridge. The pixel
// becomes the mean of the fit's value and its own, weighted by the fit's residual and the pixel's own noise. from: the
// light after the passes, with each pixel's variance and share after the first pass. Sets the light of `to`. Source:
// Bitterli et al., "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings", 2016.
void fit_edges(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to);

}  // namespace ods
