// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What Apple's players read of a video: `vexu` and `hfov` in a sample entry of mp4 or mov. Sources: Apple, "ISO Base
// Media File Format and Apple HEVC Stereo Video", and what its "Apple Projected Media Profile" added (proj, pack).
//
//   vexu { eyes { stri, hero, cams { blin } }, proj { prji }, pack { pkin } }    hfov
//
// stri: 1 there is a left eye, 2 a right one, 8 the right one comes first; hero: 1 left, 2 right; blin: the distance of
// the eyes in micrometres; prji: equi, hequ (the half in front), rect; pkin: side, over; hfov: thousandths of a degree.
//
// Only for who asks: FFmpeg from 7.1 on takes the layout from vexu where there is one, not from V2, and does not read
// `pack`. To it and what is made with it such a video is stereo of a layout that nobody knows.
#pragma once
#include "ods/video/container/spherical.h"

namespace ods {

// It knows mono, top-bottom and side-by-side, with the right eye first, too; of projections the whole sphere in
// lat-long and the half in front. It has no place for angles: players show such a video unturned.
bool fits_vexu(const SphericalMetadata& metadata);

// Preconditions: fits_vexu(). Without an ipd, or with one of kilometres, there is no blin.
Box vexu_box(const SphericalMetadata& metadata);
Box hfov_box(const SphericalMetadata& metadata);

// The vexu of another form, with what `old` says besides: the eye for flat displays, disparities. Preconditions as for
// vexu_box(). Throws MalformedFile.
Box updated_vexu(Box old, const SphericalMetadata& metadata);

// From the boxes of a sample entry; nothing where it has no vexu, or one that describes layers of the stream and no
// packing. Throws MalformedFile.
std::optional<SphericalMetadata> parse_vexu(const Box& sample_entry);

}  // namespace ods
