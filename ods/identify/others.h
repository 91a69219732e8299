// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Known formats that none of the readings of identify.h covers. Each mark is from 0, no evidence, to 1.
#pragma once
#include "ods/identify/thumbnail.h"

namespace ods {

// Evidence of two eyes in the colours of one picture: one colour part shows the content of another, shifted sideways.
double anaglyph_mark(const StoredPicture& whole, Extent size);

// Evidence that a strip of six faces is px nx py ny pz nz in a world whose Y is up, as in OpenGL's and Direct3D's cube
// maps, rather than our cube, which has the same order with Z up. Light and detail vary with height more than around.
// Returns -1 for ours to 1; 0 if undecided. `eye`: as a display shows it.
double y_up_mark(const Image& eye, const ProjectionSetting& cube);

}  // namespace ods
