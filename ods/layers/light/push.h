// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pushes the colours of a texture outwards, into the texels that have none, so that filters that read beyond the border
// of a surface find its own colour there, and reduced copies of the texture do not darken.
#pragma once
#include <vector>

#include "ods/image/image.h"

namespace ods {

// The rounds for baked light: texels without it that are so far from lit ones get the colour of their own surface.
inline constexpr int kPushedRings = 16;

// owners: the surface of each texel that has a colour; -1 for the others. claims: for texels without a colour, the
// surface that they belong to; -1 for none. Row by row from the top. In each of `rings` rounds, every texel that is
// claimed gets the mean of those of the 8 texels around it that have a colour of that surface, if there are any.
// Then every texel that is still without gets the colour of the nearest one that has any. A texture without colours
// stays as it is. The same arguments give the same bits. Precondition: owners and claims have the image's size.
void push_outwards(Image& image, const std::vector<int>& owners, const std::vector<int>& claims, int rings);

}  // namespace ods
