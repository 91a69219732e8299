// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether the borders of slits show in a stitched picture.
#pragma once
#include "ods/picture/picture.h"
#include "ods/picture/save.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

struct SeamReport {
  // By how much brightness bends from pixel to pixel sideways (the second difference), on the borders of slits, over
  // the same elsewhere; each the mean. 1: borders show no more than anything else.
  double ratio = 1.0;
  Picture picture;  // of that, eight times as bright; borders are tinted red
};

// Reads all rows. Precondition: they are the rig's picture.
SeamReport measure_seams(const SlitRig& rig, const PictureRows& rows);

}  // namespace ods
