// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures that circulate and that are none of the readings of identify.h. Each mark is from 0, no sign of it, to 1.
#pragma once
#include "ods/identify/thumbnail.h"

namespace ods {

// Two eyes in the colours of one picture: what one of the parts shows stands aside in another.
double anaglyph_mark(const StoredPicture& whole, Extent size);

// How much better a strip of six faces stands if it is px nx py ny pz nz of a world whose Y is up, as OpenGL's and
// Direct3D's cube maps are, than as our cube, whose order is the same with Z up. Light and detail change with the
// height more than around; from -1, it is ours, to 1; 0: they do not tell. `eye`: as a display shows it.
double y_up_mark(const Image& eye, const ProjectionSetting& cube);

}  // namespace ods
