// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Lettering that stands in the world of a stereo 360 picture, to be laid over it: each pixel's ray meets the card that
// the text is written on, so that it has the parallax of its distance in every projection, merge and convergence.
//
// Source: Google, "Rendering Omni-directional Stereo Content": titles over live action, objects at 60 cm or more, at
// 3.5 m or more straight above and below (for 6.5 cm between the eyes).
#pragma once
#include <span>

#include "ods/camera/layout.h"
#include "ods/camera/stereo_camera.h"
#include "ods/compose/lettering.h"

namespace ods {

struct TitleSetting {
  float yaw = 0.0f;  // degrees to the right, and up, of the direction that the text's middle lies in; the world's
  float pitch = 0.0f;
  float distance = 3.0f;  // metres from the viewing circle's middle
  float height = 0.2f;    // metres: the font's size, about the distance of two lines
  bool curved = true;     // about the viewer, so that all letters are equally far; else flat
  vec3 color{1.0f};       // linear light
  float opacity = 1.0f;
};

struct Title {
  Camera camera;  // at the card's origin
  Extent eye;
  Image coverage;
  TitleSetting setting;
  vec3 right, up, middle;  // of the card, unit vectors
  float pixels = 0.0f;     // of the coverage to a metre
  float reach = -1.0f;     // cosine of the angle from its middle that no ray to it exceeds
  float rise = 1.0f;       // sine of the angle above or below its middle line that no ray to it exceeds
};

// How many of the lettering's pixels an em should have, so that it is as sharp as the picture.
float lettering_em(const StereoCamera& stereo, Extent eye, const TitleSetting& setting);

// The camera is at the centre of the title's world, whatever its position.
// Precondition: as of make_camera(); sides, distance and height above 0.
Title make_title(const StereoCamera& stereo, Extent eye, const TitleSetting& setting, const Lettering& lettering);

// Row y of one eye: R, G, B multiplied by A, A, and Z (metres along the ray, kFarDepth where there is no letter) of
// every pixel.
void fill_title_row(const Title& title, int eye, int y, std::span<float> row);

// Degrees that the text spans, seen from the viewing circle's middle.
float title_width(const Title& title);

// Degrees. A wider text cannot be read without turning the head: eyes turn some 30 degrees to either side with ease.
inline constexpr float kComfortableWidth = 60.0f;

// Metres. The setting's height, or what makes the text no wider than is comfortable.
float comfortable_height(const Title& title);

// Metres. What is nearer strains the eyes, by the source's two rules and this camera's ipd.
float nearest_comfortable(const StereoCamera& stereo, float pitch);

}  // namespace ods
