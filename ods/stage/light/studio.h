// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A photographer's studio for an object on its own: a key light from behind the viewer's left shoulder, a larger and
// much weaker fill light on the right, and two rim lights behind the object. The walls are brighter than the floor just
// above the horizon and darken upwards, so the horizon shows without a hard line. The camera does not see the lights,
// which would dazzle.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Makes the studio, 512 x 256 texels. yaw: the viewer's, degrees to the right; the lights are placed around that line
// of sight. A white Lambert surface that faces the viewer has a radiance of about 1.
Environment make_studio(float yaw = 0.0f);

// Makes the same walls and floor without the lights, for Scene::background.
Environment make_studio_walls();

// The albedo of the studio's floor.
vec3 studio_floor();

// Adds a horizontal disc to the scene that catches the object's shadow. Over an environment with matching ground, such
// as make_studio() and make_sky(), its edge is invisible: fading it out would only add noise. It faces up and is
// invisible from below.
// Precondition: radius > 0.
void add_ground(Scene& scene, vec3 center, float radius, vec3 albedo);

}  // namespace ods
