// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Which way a viewer faces in a place. Other rooms call place_viewer().
#pragma once
#include "ods/stage/scene_rays.h"

namespace ods {

// The yaw of the best view, degrees in (-180, 180]. A view is 90 degrees wide and its middle counts most. What counts:
//  - for it, things: surfaces that stand out at least 15 percent of the way from the backdrop, which is the farthest
//    surface in their vertical line, or the open sky; and instances that fill less than 3 percent of the directions,
//    such as pictures. Floors, ceilings and other level surfaces are not things, and a bare wall is none either;
//  - for it, depth: how much farther its middle reaches than the average. A room's corner is not deep enough to
//    count; a street is, along its length;
//  - against it, a wall: how much nearer than the average its middle ends;
//  - against it, things that its sides or its upper edge cut;
//  - against it, an obstacle in its middle: something narrow, less than half as far as the backdrop, that rises from
//    eye level through the upper edge, such as a column.
// Of equal views, the first to the right of -Z.
float best_yaw(const SceneRays& rays, vec3 eye);

}  // namespace ods
