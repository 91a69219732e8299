// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that place the camera. Shared by the commands that have one.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/camera/stereo_camera.h"
#include "ods/scene/scene.h"

struct CameraOptions {
  ods::StereoCamera stereo;  // what holds for every scene
  std::string merge_map;
  bool merge_map_inverted = false;
  std::string view_point;
  std::optional<ods::vec3> position;
  std::optional<float> yaw;
  std::optional<float> pitch;
  std::optional<float> roll;
};

// X,Y,Z of a place. name: of the option, for the message. Throws UsageError.
ods::vec3 parse_point(const std::string& name, const std::string& word);

// --camera and --position alone, the rest of where it stands, and how it sees. In this order.
void add_place_options(Options& options, CameraOptions& camera);
void add_camera_options(Options& options, CameraOptions& camera);
// The same without --camera, where there is no scene that could have one.
void add_sceneless_camera_options(Options& options, CameraOptions& camera);

// Looks at what was given as a whole, reads the merge map, and finds the height of the picture where it is 0. Throws
// UsageError and ods::Error.
void finish_camera_options(CameraOptions& camera, int width, int& height);

// The camera asked for, and where nothing is asked: the scene's first view point; else eye height above the origin, or
// above the middle of the scene; else, before an object too small to stand in, where all of it is seen. Notes which.
// Pitch and roll of a view point are left out: in a headset the horizon must be level. Throws UsageError.
ods::StereoCamera place_camera(const CameraOptions& camera, const ods::Scene& scene);

// The same without the note: for every frame of a video.
ods::StereoCamera place_camera_again(const CameraOptions& camera, const ods::Scene& scene);

// The camera asked for where there is no scene: at the origin, unless something else was given.
ods::StereoCamera place_camera(const CameraOptions& camera);
