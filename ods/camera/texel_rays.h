// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture whose rays come from a table instead of a projection, such as a texture whose texels lie on surfaces.
#pragma once
#include <vector>

#include "ods/kernel/camera/texel_ray.h"

namespace ods {

struct TexelRays {
  int width = 0;
  int height = 0;
  std::vector<TexelRay> rays;  // row by row from the top
  // The surface that each texel lies on, -1 if it is empty. The denoiser does not mix the light of two, so two charts
  // that lie side by side in a texture need two numbers. Less than 2^24.
  std::vector<int> owners;
};

}  // namespace ods
