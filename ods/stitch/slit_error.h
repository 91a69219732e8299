// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a stitched picture is from the exact one, known before anything is rendered.
//
// A pixel's ray starts at o; the view that shows it stands at o'. What the ray meets at distance t therefore lies
// beside its place, by the angle under which the part of o - o' that is square to the ray is seen: atan(|o - o'| / t).
// On a circle of radius r, a slit off its middle by e: sideways r (1 - cos e) / t, the same on both sides of a border,
// so nothing tears sideways; up or down r sin(e) sin(elevation) / t, and twice that from one slit to the next.
#pragma once
#include "ods/stitch/slit_rig.h"

namespace ods {

// Angles on the sphere, radians.
struct SlitError {
  float across = 0.0f;  // sideways, from where it should be
  float along = 0.0f;   // up or down
  float whole = 0.0f;   // both together
  float step = 0.0f;    // from a view to its neighbour where they meet: as far do fading edges stand apart
};

// The largest that a surface at this distance (metres, along its ray) can have at this latitude of the picture
// (radians). Of surfaces that have a depth, this is where they hide another: those themselves are put right.
SlitError slit_error(const SlitRig& rig, float latitude, float distance);

// The largest at any latitude.
SlitError largest_slit_error(const SlitRig& rig, float distance);

// How much of the picture one pixel of a view covers at a latitude (radians): a view's pixels have about the same size
// on the sphere everywhere, but the picture's columns narrow towards the poles, as the cosine of the latitude. Where
// `across` is well above 1, neighbouring columns show much the same, and a picture rendered directly has more detail
// sideways. More slits do not change it; SlitOptions::scale does.
struct ViewDetail {
  float across = 0.0f;  // columns of the picture
  float along = 0.0f;   // rows
  float angle = 0.0f;   // radians: as wide is the pixel on the sphere
};
ViewDetail view_detail(const SlitRig& rig, float latitude);

// Pixels of the picture as wide as an angle, and the angle in minutes of arc.
float picture_pixels(const SlitRig& rig, float angle);
float arc_minutes(float angle);

// The fewest slits with which no surface beyond `nearest` metres is off by more than `pixels`, nor stepped. With views
// that have depth, a tenth of that: their surfaces are put where they belong, and ten times as much may be seen only
// where one hides another.
// Throws Error(kUsage): no number of slits does it, and what does.
int slits_for(const StereoCamera& camera, Extent eye, const SlitOptions& options, float nearest, float pixels);

}  // namespace ods
