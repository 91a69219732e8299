// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures that Blender's Cycles has rendered with our camera (ods/camera/cycles_camera.h), one eye per file: a
// multilayer EXR with the passes Combined, Depth, Normal and Denoising Albedo.
//
// Cycles' depth in a panorama is the distance from the camera's place, the centre of the viewing circle
// (camera_z_depth() in its src/kernel/camera/camera.h); ours is along the ray from the eye.
#pragma once
#include <span>
#include <string>

#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"

namespace ods {

struct CyclesPasses {
  StereoCamera camera;
  int eye = kLeft;
  float unit = 1.0f;       // of Blender's lengths, metres
  bool has_alpha = false;  // keeps the alpha
};

// Returns the mean of files that are parts of one picture, each with as many samples of its own, with its layers. Of
// two parts or more, `variance` is that of the mean, and `samples` the number of the parts, for the denoiser. Throws
// Error(kInput): a file cannot be read, lacks the depth, or has another size. Precondition: there is a file.
EyeImage read_cycles(std::span<const std::string> files, const CyclesPasses& passes);

// Returns the number of samples of each pixel in all of these files, 1 channel, from the pass Debug Sample Count. Empty
// if one of them does not have it. Throws Error(kInput) as read_cycles().
Image read_cycles_counts(std::span<const std::string> files);

// The distance along a ray from its own origin of a point of which the distance from the circle's centre is known; both
// in metres. Returns 0, which is invalid, for a point inside the circle.
float along_ray(const StereoCamera& camera, const Ray& ray, float from_center);

}  // namespace ods
