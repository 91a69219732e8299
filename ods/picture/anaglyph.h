// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Two eyes in one picture for red-cyan glasses, red for the left eye. Anaglyphs are display-referred: they are computed
// from linear light 0..1, after the tone curve and before the sRGB curve, so only png, jpg, tif and webp support them.
//
// kAnaglyph        red of the left eye, green and blue of the right one: full colour, strong retinal rivalry.
// kAnaglyphHalf    like kAnaglyph, but red is the luminance of the left eye (Rec. 709): less rivalry, pale reds.
// kAnaglyphDubois  a least-squares match of both eyes' colours through real filters, with the least ghosting. Matrices
//                  of E. Dubois, "Conversion of a Stereo Pair to Anaglyph with the Least-Squares Projection Method",
//                  2009, after his "A projection method to generate anaglyph stereo images", ICASSP 2001: projected in
//                  CIE XYZ, hence linear light; for sRGB displays.
// All three show two equal grey eyes as that grey (to 0.001).
#pragma once
#include "ods/camera/layout.h"
#include "ods/kernel/math.h"

namespace ods {

// Linear light 0..1 in and out. Precondition: is_anaglyph(layout).
vec3 anaglyph_color(Layout layout, vec3 left, vec3 right);

}  // namespace ods
