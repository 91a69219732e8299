// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light that a pass of the denoiser removes from a picture is detail of one size, plus noise. The detail that
// exceeds the noise is restored by the Wiener filter, with the amounts of both measured in windows of the pass's
// stride.
//
// Sources: Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", 2010;
// Mihcak et al., "Low-complexity image denoising based on statistical modeling of wavelet coefficients", 1999.
#pragma once
#include "ods/denoise/filter.h"

namespace ods {

// Adds the detail between two levels to an eye's light, three numbers per pixel.
void add_detail(const NoisyPicture& noisy, const std::vector<Level>& before, const std::vector<Level>& after,
                const FilterPass& pass, std::vector<float>& light, Block& block);

}  // namespace ods
