// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measures how the right eye's picture is turned, raised and magnified against the left one's.
//
// In omni-directional stereo a point has the same elevation in both eyes. A difference of elevations depends on the
// heading theta and the elevation phi in a way that reveals its cause: a raise is the same everywhere, a pitch is
// proportional to cos(theta), a roll to sin(theta), a magnification to phi. Parallax changes only the heading and is
// not used.
// The differences of matching tiles are fitted with as few of these terms as explain them, by least squares with the
// weights of a Cauchy distribution against mismatches; then the right view is corrected and matched again, at finer
// scales, until only noise is left. A turn to the side (yaw) cannot be distinguished from parallax.
#pragma once
#include <array>
#include <vector>

#include "ods/camera/eye_correction.h"
#include "ods/disparity/match.h"

namespace ods {

enum AlignmentTerm { kRaiseTerm, kPitchTerm, kRollTerm, kZoomTerm, kAlignmentTerms };

struct Alignment {
  struct Term {
    double value = 0.0;  // correction of the right eye's picture: degrees as in EyeCorrection; zoom: minus 1
    double error = 0.0;  // standard error; for terms that explain nothing, as if all of them were fitted
  };
  std::array<Term, kAlignmentTerms> terms;
  int matches = 0;           // at the finest scale
  double headings = 0.0;     // number of sectors of the horizon with matches, out of 16
  double unexplained = 0.0;  // median of the remaining differences of elevation, degrees
};

EyeCorrection correction_of(const Alignment& alignment);

// `scales`: the views of both eyes, coarse to fine, of the widths 256, 512, 1024 as far as the eyes' resolution allows.
// two_cameras: the eyes do not turn with the heading (VR180 cameras); then close points above and below the horizon
// have different elevations, which are proportional to sin(theta) times powers of phi and are fitted as well.
Alignment find_alignment(const std::vector<std::vector<GrayView>>& scales, bool two_cameras);

// A view of the corrected picture. NaN where the picture ends.
GrayView corrected_view(const GrayView& view, const EyeCorrection& correction);

}  // namespace ods
