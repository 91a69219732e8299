// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Lettering placed in the world of a stereo 360 picture, to be composited over it. Each pixel's ray is intersected with
// the card that carries the text, so the parallax is right for its distance in every projection, merge and convergence.
//
// Source: Google, "Rendering Omni-directional Stereo Content": keep titles over live action, and objects, at 60 cm or
// more, and at 3.5 m or more straight above and below (for 6.5 cm between the eyes).
#pragma once
#include <span>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/compose/lettering.h"

namespace ods {

struct TitleSetting {
  float yaw = 0.0f;  // degrees to the right, and up: the direction of the text's centre, in world space
  float pitch = 0.0f;
  float distance = 3.0f;  // metres from the centre of the viewing circle
  float height = 0.2f;    // metres: the font size, about the distance between two lines
  bool curved = true;     // bent around the viewer, so that all letters are equally far; else flat
  vec3 color{1.0f};       // linear light
  float opacity = 1.0f;
};

struct Title {
  Camera camera;  // at the card's origin
  Extent eye;
  Image coverage;
  TitleSetting setting;
  vec3 right, up, middle;  // the card's axes, unit vectors
  float pixels = 0.0f;     // pixels of the coverage per metre
  float reach = -1.0f;     // cosine of the largest angle between its centre and a ray that hits it
  float rise = 1.0f;       // sine of the largest angle above or below its centre line of a ray that hits it
};

// The lettering's pixels per em that match the picture's resolution.
float lettering_em(const StereoCamera& stereo, Extent eye, const TitleSetting& setting);

// The camera is at the origin of the title's world, regardless of its position. Preconditions: those of make_camera();
// sides, distance and height above 0.
Title make_title(const StereoCamera& stereo, Extent eye, const TitleSetting& setting, const Lettering& lettering);

// Fills row y of one eye with R, G, B (premultiplied), A, and Z (metres along the ray,
// kFarDepth where there is no letter).
void fill_title_row(const Title& title, int eye, int y, std::span<float> row);

// The text's angular width in degrees, from the centre of the viewing circle.
float title_width(const Title& title);

// Degrees. Wider text requires turning the head: eyes turn about 30 degrees to either side with ease.
inline constexpr float kComfortableWidth = 60.0f;

// Metres: the setting's height, or less if the text would be wider than kComfortableWidth.
float comfortable_height(const Title& title);

// Metres: closer objects strain the eyes, by the source's two rules and this camera's ipd.
float nearest_comfortable(const StereoCamera& stereo, float pitch);

}  // namespace ods
