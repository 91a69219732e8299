// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Data for real-time objects in a picture with depth, which the page (web/objects-panorama.js) needs beside the
// picture: the distances that hide them, and the light that falls on them.
#pragma once
#include <array>
#include <string>

#include "ods/base/json_reader.h"
#include "ods/kernel/math.h"
#include "ods/picture/stored_picture.h"

namespace ods {

struct PictureStage {
  // A PNG of 8 bits, the left eye above the right one, at most kMaxStageWidth wide: R and G are the high and the low
  // byte of a code c of the distance along the texel's ray from its own eye, nearest * 2^(c / per_octave) metres;
  // kFarCode is the sky, or what has no depth. Smaller pictures have every pixel, larger ones have the nearest one.
  std::string depth_png;
  int eyes = 0;
  float nearest = 1.0f;     // metres
  float per_octave = 1.0f;  // codes
  // The light from everywhere as it arrives at the viewer, of everything that the picture shows: real spherical
  // harmonics, as of ods/layers/probes/harmonics.h. Linear; of a display-encoded picture, what a display emits.
  std::array<vec3, 9> light{};
  vec3 ahead{0.0f};  // on the floor, 1.2 m ahead; at the viewer's height if the depth shows no floor
};

inline constexpr int kFarCode = 65535;
inline constexpr int kMaxStageWidth = 4096;  // texels
inline constexpr std::string_view kDepthFile = "depth.png";

// Throws Error(kUsage) if the picture has no depth, or is stored as its camera's lenses. Precondition: the picture has
// its pixels.
PictureStage make_stage(const StoredPicture& picture);

// The stage as view.json has it, with the pose of the picture's camera in the world.
Json stage_json(const PictureStage& stage, const StereoCamera& camera, const std::string& depth_file);

}  // namespace ods
