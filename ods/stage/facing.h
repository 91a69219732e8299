// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses the direction that a viewer faces in a place. Other modules call place_viewer().
#pragma once
#include "ods/stage/scene_rays.h"

namespace ods {

// The yaw of the best view, degrees in (-180, 180]. A view is 90 degrees wide and its middle has the highest weight.
// Criteria:
// - for it, objects: surfaces that stand out by at least 15 percent of the distance to the backdrop, which is the
//   farthest surface in their vertical line, or the open sky; and instances that fill less than 3 percent of the
//   directions, such as pictures. Floors, ceilings, other level surfaces and bare walls do not count;
// - for it, depth: how much farther its middle reaches than the average. A room's corner is not deep enough to count; a
//   street is, along its length;
// - against it, a wall: how much closer than the average its middle ends;
// - against it, objects that are cut by its sides or its upper edge;
// - against it, an obstacle in its middle: a narrow object, less than half as far as the backdrop, that extends from
//   eye level through the upper edge, such as a column.
// Among equal views, the first to the right of -Z is chosen.
float best_yaw(const SceneRays& rays, vec3 eye);

}  // namespace ods
