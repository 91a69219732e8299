// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that place the camera, shared by the commands that have one.
#pragma once
#include <optional>
#include <string>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/options.h"
#include "ods/camera/stereo_camera.h"
#include "ods/sequence/scene_camera.h"

// The commands' default: kUsualMerge at both poles.
inline ods::StereoCamera usual_camera() {
  ods::StereoCamera camera;
  camera.top = camera.bottom = ods::kUsualMerge;
  return camera;
}

struct CameraOptions {
  ods::StereoCamera stereo = usual_camera();  // the part that holds for every scene
  std::string merge_map;
  bool merge_map_inverted = false;
  bool may_follow_depth = false;     // --merge auto is allowed: there is a scene to measure
  std::optional<float> merge_limit;  // --merge auto: minutes of arc; the merge is found when the scene is there
  std::string head_tilt_map;
  std::string view_point;
  std::optional<ods::vec3> position;
  std::optional<float> yaw;
  std::optional<float> pitch;
  std::optional<float> roll;
};

// Parses a position X,Y,Z. name: of the option, for the message. Throws UsageError.
ods::vec3 parse_point(const std::string& name, const std::string& word);

// add_place_options() adds --camera and --position. add_camera_options() adds --camera-from, which the others change
// (it reads a .blend with that Blender), these, then the orientation, the eyes and the projection.
void add_place_options(Options& options, CameraOptions& camera);
void add_camera_options(Options& options, CameraOptions& camera, const BlenderOptions& blender);
// Likewise without --camera, where no scene could have one.
void add_sceneless_camera_options(Options& options, CameraOptions& camera);

// The lens, the tilt and, if it has any, the eyes of a foreign scene's camera. Its place is that of the view point.
void take_camera(CameraOptions& camera, const ForeignScene& scene);

// Checks the options as a whole, reads the maps, and finds the height of the picture if it is 0. Throws UsageError
// and ods::Error.
void finish_camera_options(CameraOptions& camera, int width, int& height);

// The camera that the options ask for. Without options: the scene's first view point; otherwise eye height above the
// origin, or above the centre of the scene; otherwise in front of an object too small to stand in, so that all of it is
// visible. Notes which.
// Pitch and roll of a view point are ignored: in a headset the horizon must be level. Throws UsageError.
ods::StereoCamera place_camera(const CameraOptions& camera, const ods::Scene& scene);

// The camera that the options ask for, for any scene; without a move.
ods::SceneCamera scene_camera(const CameraOptions& camera);

// Notes where the camera is. stereo: the camera, which may have moved since it was placed.
void note_camera(const CameraOptions& camera, const ods::Scene& scene, const ods::StereoCamera& stereo);

// The camera that the options ask for if there is no scene: at the origin by default.
ods::StereoCamera place_camera(const CameraOptions& camera);
