// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rotating slits: stitches an omni-directional stereo picture from perspective views, for renderers without an ODS
// camera. Each eye moves along its circle in steps and looks along the tangent; a narrow vertical slit straight ahead
// is its part of the picture. Source: Google, "Rendering Omni-directional Stereo Content", the rotating slit approach.
//
// A slit is the columns around one longitude, seen from the position that is exact for its centre. `pitches`
// perspective views, one above another, cover it from the bottom of the picture to the top. With a pole merge, each
// view is at the position that the merge gives for the middle of its elevations.
//
// A point on the circle serves both eyes, but in opposite directions: the left eye at heading H has the position of the
// right eye at heading H + 180 degrees. No perspective view covers both, so eyes share no views.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

// The kind of depth in a view.
enum class ViewDepth {
  kNone,
  kRay,    // metres from the view's own position, as in our pictures
  kPlane,  // metres along the view's axis, as in depth buffers
};
inline constexpr NameRow<ViewDepth> kViewDepthTable[] = {
    {ViewDepth::kNone, "none"},
    {ViewDepth::kRay, "ray"},
    {ViewDepth::kPlane, "plane"},
};
static_assert(has_every_member(kViewDepthTable));
inline constexpr auto kViewDepths = members_of(kViewDepthTable);
constexpr std::string_view view_depth_name(ViewDepth depth) {
  return name_in(kViewDepthTable, depth);
}

struct SlitOptions {
  int slits = 360;     // per eye, evenly over the picture's longitudes
  int pitches = 2;     // views above each other; 2 look 45 degrees up and down
  bool caps = false;   // the first pitch looks straight up, the last straight down; each covers half as much height
  float blend = 0.5f;  // 0..1: the fraction of a slit over which it fades into its neighbours
  int padding = 4;     // extra view pixels on every side, for filters and effects after rendering
  float scale = 1.0f;  // view pixels per picture pixel, at the view's centre, where they are largest
  ViewDepth depth = ViewDepth::kNone;
};

struct SlitRig {
  StereoCamera camera;  // camera of the stitched picture: lat-long, whole or a part
  Extent eye;           // size of one eye of it
  std::vector<int> eyes{kLeft, kRight};
  SlitOptions options;
  Extent view;  // pixels of each view
  // One perspective camera per view, without ipd; its pose gives the direction. Ordered by eye, then slit from the
  // left, then pitch from the top.
  std::vector<StereoCamera> views;
  // For a rig read from a file: each view's matrix as in the file, 16 numbers, row by row. `views` has the same
  // positions and directions, with rounded angles.
  std::vector<std::vector<float>> matrices;
  Layout layout = default_layout(camera.projection);  // layout of the eyes in the picture's file
};

size_t view_index(const SlitRig& rig, size_t eye, int slit, int pitch);

// The reason why no such rig is possible, for messages. Empty if one is.
std::string slit_fault(const StereoCamera& camera, Extent eye, const SlitOptions& options);

// Makes the rig. Views cover the slit, its blend and the padding, and all have one size. Precondition: no slit_fault().
SlitRig make_slit_rig(const StereoCamera& camera, Extent eye, const std::vector<int>& eyes, const SlitOptions& options);

// Radians. The longitude of a slit's centre, and a slit's width; the latitude of the border between a pitch and the one
// below it (pitch -1: the top edge).
float slit_longitude(const SlitRig& rig, int slit);
float slit_width(const SlitRig& rig);
float pitch_border(const SlitRig& rig, int pitch);

// The direction of a pitch, and the height it covers; a cap covers half of that, on one side of its direction.
float pitch_latitude(const SlitRig& rig, int pitch);
float pitch_height(const SlitRig& rig);

// Adjacent pitches fade into each other over this many radians on either side of their border.
float pitch_fade(const SlitRig& rig);

// The lowest and the highest latitude that a pitch contributes to, including its fades.
vec2 pitch_reach(const SlitRig& rig, int pitch);

// Returns whether the slits wrap around, so that the first slit follows the last one.
bool goes_round(const SlitRig& rig);

// The picture's ray for an eye at this longitude and latitude.
Ray ray_at(const Camera& camera, int eye, float longitude, float latitude);

}  // namespace ods
