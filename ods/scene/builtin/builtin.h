// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes made in code, selected by name instead of a file. Each has one ViewPoint, its default camera, and nothing
// closer to it than half a metre. Building a scene always gives the same bytes.
//
// The scenes whose summary starts with "test:" have answers in closed form, stated by the functions below.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct BuiltinScene {
  const char* name;
  const char* summary;  // one line
  Scene (*make)();      // leaves Scene::name empty
};

std::span<const BuiltinScene> builtin_scenes();

// Returns nullptr if there is no scene of that name.
const BuiltinScene* find_builtin(std::string_view name);

// "furnace": inside a closed box of Lambert surfaces with albedo 0.5 and emitted radiance 0.25. Every pixel is the
// geometric series over the segments of a path.
float furnace_radiance(int bounces);

// "spheres": a small emissive sphere at each of these world positions, and black everywhere else. The camera is at the
// origin with yaw 0; a sphere's radius is kMarkerSize times its distance from there.
std::vector<vec3> marker_positions();
inline constexpr float kMarkerSize = 0.008f;
inline constexpr float kMarkerRadiance = 1.0f;

// "lamp": a Lambert floor (y = 0) under a parallel emissive disc, without other light. The radiance of the floor in any
// direction at (x, 0, z) is albedo / pi times the irradiance from a disc of radius a at height h, d = |(x, z)| off its
// axis: E = pi L / 2 (1 - (d2 + h2 - a2) / sqrt((d2 + h2 + a2)2 - 4 a2 d2)). Source: Foote, Scientific Papers of the
// Bureau of Standards 12 (1915); d = 0 gives the known pi L a2 / (a2 + h2).
float lamp_floor_radiance(float x, float z);

// "slab": clear, absorbing glass perpendicular to -Z in front of an environment of radiance 1 in the half space z < 0;
// the other half is black, so the slab reflects nothing towards the camera. Within 40 degrees of straight ahead a pixel
// is (1 - F)2 t / (1 - F2 t2), with Fresnel's unpolarised F and the transmittance t of one passage along the refracted
// ray. direction: a unit vector, z < 0.
vec3 slab_transmittance(vec3 direction);

}  // namespace ods
