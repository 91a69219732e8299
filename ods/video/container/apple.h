// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stereo and projection metadata for Apple's players: `vexu` and `hfov` in a sample entry of mp4 or mov. Sources:
// Apple, "ISO Base Media File Format and Apple HEVC Stereo Video", and the additions of its "Apple Projected Media
// Profile" (proj, pack).
//
//   vexu { eyes { stri, hero, cams { blin } }, proj { prji }, pack { pkin } }    hfov
// stri: bits for 1 has a left eye, 2 has a right eye, 8 the right eye comes first; hero: 1 left, 2 right; blin: eye
// distance in micrometres; prji: equi, hequ (the front half), rect; pkin: side, over; hfov: thousandths of a degree.
//
// New HEVC videos have vexu, others only on request: FFmpeg 7.1 and later prefers vexu to V2 but does not read `pack`,
// so FFmpeg and programs based on it report such a video as stereo of unknown layout. hfov is updated, never added.
#pragma once
#include "ods/video/container/spherical.h"

namespace ods {

// vexu supports mono, top-bottom and side-by-side, also with the right eye first; whole-sphere lat-long and its front
// half. It has no angles: players show such a video without rotation.
bool fits_vexu(const SphericalMetadata& metadata);

// Precondition: fits_vexu(). Without an ipd, or with one too large for the field, the box has no blin.
Box vexu_box(const SphericalMetadata& metadata);
Box hfov_box(const SphericalMetadata& metadata);

// The vexu for this metadata, keeping everything else in `old`, for example the eye for flat displays and disparities.
// Precondition: fits_vexu(). Throws MalformedFile.
Box updated_vexu(Box old, const SphericalMetadata& metadata);

// Parses the boxes of a sample entry. Returns nullopt if there is no vexu, or one that describes layers of the stream
// instead of packing. Throws MalformedFile.
std::optional<SphericalMetadata> parse_vexu(const Box& sample_entry);

// The eyes of a stream that stores each as a layer (MV-HEVC).
struct EyeLayers {
  // The metadata of frames that have these eyes side by side.
  SphericalMetadata beside = {.stereo = VideoStereo::kSideBySide, .projection = VideoProjection::kFlat};
  bool right_first = false;  // the first layer, which every decoder shows, is the right eye
  std::optional<float> fov;  // horizontal field of view of a flat picture, degrees
};
// Parses the boxes of a sample entry. Returns nullopt if it has no lhvC, which contains the layers' parameters. Throws
// MalformedFile.
std::optional<EyeLayers> parse_layers(const Box& sample_entry);

}  // namespace ods
