// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures whether slit borders are visible in a stitched picture.
#pragma once
#include "ods/picture/picture.h"
#include "ods/picture/save.h"
#include "ods/stitch/slit_rig.h"

namespace ods {

struct SeamReport {
  // The mean absolute second difference of brightness between adjacent columns at slit borders, divided by the mean
  // elsewhere. At 1, borders are no more visible than other columns.
  double ratio = 1.0;
  Picture picture;  // the second difference, times eight; borders are tinted red
};

// Reads all rows. Precondition: they are a picture of this rig.
SeamReport measure_seams(const SlitRig& rig, const PictureRows& rows);

}  // namespace ods
