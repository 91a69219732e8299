// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A clear sky with a sun, computed from scattering: air molecules (Rayleigh), aerosol (Mie), ozone, all orders of
// scattering.
// Source: Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020, with the atmosphere
// of Bruneton and Neyret, "Precomputed Atmospheric Scattering", 2008: the physical values of air and ozone at 680, 550
// and 440 nm, which stand for R, G and B, and the aerosol of a clear day. Nothing is fitted to pictures.
//
// Radiance is relative: above the air, the sun is white and so bright that a horizontal white Lambert surface has a
// radiance of about 1 under the default sun. A lower sun is darker, as in reality.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// The sun's irradiance above the air, on a surface that faces it, equal in R, G and B.
inline constexpr float kSunAboveAir = 6.08f;

struct SkyOptions {
  float elevation = 35.0f;  // sun's centre, degrees above the horizon, 0..90
  float azimuth = 120.0f;   // sun, degrees clockwise from -Z, seen from above

  bool operator==(const SkyOptions&) const = default;
};

// Makes a sky of 1024 x 512 texels. The sun's disc is spread over the texels that it covers, so that the kernel's
// interpolation yields its irradiance. Below the horizon there is uniform ground, a third as bright as white, lit by
// this sun and sky; it fades into the haze of the horizon. Takes about a fifth of a second of one processor.
// Precondition: elevation in 0..90, azimuth finite.
Environment make_sky(const SkyOptions& options = {});

// The albedo of the sky's ground.
vec3 sky_ground();

// The irradiance of the sun's whole disc at sea level, on a surface that faces it.
vec3 sun_irradiance(float elevation);

}  // namespace ods
