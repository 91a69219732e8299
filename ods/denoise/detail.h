// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a pass of the denoiser takes away from a picture is detail of one size, and noise. The detail comes back as far
// as it is more than noise, by the Wiener filter: windows of a pass's own stride tell how much there is of both.
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
