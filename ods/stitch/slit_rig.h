// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Rotating slits: an omni-directional stereo picture put together from perspective ones, for renderers that know no
// other camera. Each eye walks its circle in steps, and at every step looks along the circle's tangent: what it sees
// straight ahead, a narrow upright slit, is its part of the picture. Source: Google, "Rendering Omni-directional Stereo
// Content", the rotating slit approach.
//
// A slit is the columns around one longitude, seen from the one place that is right for the middle of them. So many
// perspective views, one above another, reach from the bottom of the picture to its top. Where the poles are merged,
// each of them stands where the merge has the middle of its own elevations.
//
// A place on the circle serves both eyes, but in opposite directions: the left eye of heading H stands where the right
// eye of heading H + 180 degrees does. No perspective view sees both, so none is shared.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"

namespace ods {

// How far away a view's depth is.
enum class ViewDepth {
  kNone,
  kRay,    // metres from the view's own place, as our pictures have it
  kPlane,  // metres along the view's axis, as depth buffers have it
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
  int slits = 360;     // of each eye, evenly over the picture's longitudes
  int pitches = 2;     // views above each other; 2 look 45 degrees up and down
  bool caps = false;   // the first pitch looks straight up, the last straight down; they show half as much as others
  float blend = 0.5f;  // 0..1: the part of a slit over which it fades into its neighbours
  int padding = 4;     // pixels of a view on every side beyond what is used, for filters and effects after the render
  float scale = 1.0f;  // a view's pixels over the picture's, in the middle of the view where they are largest
  ViewDepth depth = ViewDepth::kNone;
};

struct SlitRig {
  StereoCamera camera;  // of the picture that is put together: lat-long, whole or a part
  Extent eye;           // of one of its eyes
  std::vector<int> eyes{kLeft, kRight};
  SlitOptions options;
  Extent view;  // pixels of every view
  // One perspective picture each, without ipd; where it looks is its pose. Eye by eye; of each, slit by slit from the
  // left; of each, from the top.
  std::vector<StereoCamera> views;
  // Of a rig that was read from a file: each view's matrix as it stands there, 16 numbers, row by row. `views` are the
  // same places and directions, but angles round them.
  std::vector<std::vector<float>> matrices;
  Layout layout = default_layout(camera.projection);  // how the eyes of the picture share a file
};

size_t view_index(const SlitRig& rig, size_t eye, int slit, int pitch);

// Why there is no such rig, in words for a message; empty: there is one.
std::string slit_fault(const StereoCamera& camera, Extent eye, const SlitOptions& options);

// The views are wide enough for the slit, its blend and the padding, and all of one size.
// Precondition: no slit_fault().
SlitRig make_slit_rig(const StereoCamera& camera, Extent eye, const std::vector<int>& eyes, const SlitOptions& options);

// Radians. The longitude in the middle of a slit, and how wide it is; the latitude between a pitch and the one below it
// (pitch -1: the top edge).
float slit_longitude(const SlitRig& rig, int slit);
float slit_width(const SlitRig& rig);
float pitch_border(const SlitRig& rig, int pitch);

// Where a pitch looks, and how much of the picture it shows; a cap shows half of that, on one side of where it looks.
float pitch_latitude(const SlitRig& rig, int pitch);
float pitch_height(const SlitRig& rig);

// Over so many radians on either side of their border pitches fade into each other.
float pitch_fade(const SlitRig& rig);

// The lowest and the highest latitude that a pitch shows, with what of it fades.
vec2 pitch_reach(const SlitRig& rig, int pitch);

// The slits go round: the last one's neighbour is the first.
bool goes_round(const SlitRig& rig);

// The picture's ray, of a longitude and a latitude of the picture, as an eye sees it.
Ray ray_at(const Camera& camera, int eye, float longitude, float latitude);

}  // namespace ods
