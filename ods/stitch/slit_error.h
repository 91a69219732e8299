// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The error of a stitched picture against the exact one, computed before rendering.
//
// A pixel's ray starts at o, but the view that shows it is at o'. A point at distance t along the ray therefore appears
// displaced by the angle of the component of o - o' perpendicular to the ray: atan(|o - o'| / t). On a circle of radius
// r, at an angle e from the slit's centre: horizontally r (1 - cos e) / t, equal on both sides of a border, so nothing
// tears horizontally; vertically r sin(e) sin(elevation) / t, and twice that from one slit to the next.
#pragma once
#include "ods/stitch/slit_rig.h"

namespace ods {

// Angles on the sphere, radians.
struct SlitError {
  float across = 0.0f;  // horizontal error
  float along = 0.0f;   // vertical error
  float whole = 0.0f;   // both combined
  float step = 0.0f;    // between two views where they meet: the offset of edges while one view fades into the other
};

// The largest error for surfaces at this distance (metres along the ray) and latitude in the picture (radians). With
// depth, it remains only at occlusion edges; the surfaces themselves are corrected.
SlitError slit_error(const SlitRig& rig, float latitude, float distance);

// The largest error at any latitude.
SlitError largest_slit_error(const SlitRig& rig, float distance);

// The part of the picture that one pixel of a view covers at a latitude (radians). A view's pixels have about the same
// angular size everywhere, but the picture's columns narrow towards the poles, as the cosine of the latitude. If
// `across` is well above 1, neighbouring columns look much the same, and a picture rendered directly has more
// horizontal detail. SlitOptions::scale changes that; more slits do not.
struct ViewDetail {
  float across = 0.0f;  // columns of the picture
  float along = 0.0f;   // rows
  float angle = 0.0f;   // radians: the pixel's angular width
};
ViewDetail view_detail(const SlitRig& rig, float latitude);

// An angle in pixels of the picture, and in arc minutes.
float picture_pixels(const SlitRig& rig, float angle);
float arc_minutes(float angle);

// The fewest slits that keep both the error and the step of any surface beyond `nearest` metres within `pixels`. Views
// with depth need a tenth of that number: their surfaces are corrected, and a tenfold error remains only at occlusion
// edges. Throws Error(kUsage) if no number of slits suffices, with advice.
int slits_for(const StereoCamera& camera, Extent eye, const SlitOptions& options, float nearest, float pixels);

}  // namespace ods
