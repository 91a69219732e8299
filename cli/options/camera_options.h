// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that place the camera, shared by the commands that have one.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/options.h"
#include "cli/options/projection_options.h"
#include "ods/camera/camera_fields.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/sequence/scene_camera.h"

// The commands' default: kUsualMerge at both poles.
inline ods::StereoCamera usual_camera() {
  ods::StereoCamera camera;
  camera.top = camera.bottom = ods::kUsualMerge;
  return camera;
}

// The options that change a camera; fields that are absent keep the value of the file's, the scene's or the default
// camera.
struct CameraChanges {
  struct Preset {
    ods::StereoCamera camera;
    std::string note;  // how far it only approximates the other system; empty: not at all
  };
  struct Convergence {
    int mode;
    std::optional<float> distance;
  };
  std::optional<Preset> preset;                              // --camera-preset: replaces the camera
  std::map<ods::CameraField, std::optional<float>> numbers;  // the options that are one number, such as --ipd
  std::optional<ods::PoleMergeSetting> merge;                // both poles
  std::optional<ods::PoleMergeSetting> merge_top, merge_bottom;
  std::optional<float> merge_limit;      // --merge auto: minutes of arc
  std::string merge_map, head_tilt_map;  // files
  bool merge_map_inverted = false;
  std::optional<Convergence> convergence;
  std::optional<std::optional<ods::vec3>> axis;  // --axis; its nullopt: the camera's own
  std::optional<ods::vec2> lens;                 // radius and focus distance, metres
  bool left_handed = false;
  ProjectionChanges projection;
};

struct CameraOptions {
  CameraChanges changes;
  ods::StereoCamera stereo = usual_camera();  // the part that holds for every scene; finish_camera_options() changes it
  bool may_follow_depth = false;              // --merge auto is allowed: there is a scene to measure
  std::string file;                           // --camera-file
  std::string view_point;                     // --camera: a camera of the scene, by name
  std::optional<ods::vec3> position;
  std::optional<float> yaw;
  std::optional<float> pitch;
  std::optional<float> roll;
};

// Parses a position X,Y,Z. name: of the option, for the message. Throws UsageError.
ods::vec3 parse_point(const std::string& name, const std::string& word);

// add_place_options() adds --camera and --position. add_camera_options() adds --camera-file and these, then the
// orientation, the eyes and the projection.
void add_place_options(Options& options, CameraOptions& camera);
void add_camera_options(Options& options, CameraOptions& camera);
// Adds the options without --camera, for commands without a scene.
void add_sceneless_camera_options(Options& options, CameraOptions& camera);

// --camera-file, and the camera of such a file: a .camera.json or a picture that carries it. Notes doubts. Throws
// ods::Error.
void add_camera_file_option(Options& options, std::string& file, const std::string& text);
ods::Sidecar read_camera_file(const std::string& path);

// Sets position and orientation where no option does.
void take_pose(CameraOptions& camera, const ods::StereoCamera& own);

// Sets the camera that the options change to the camera of --camera-file (this Blender reads a .blend), else to the
// lens, the tilt and, if it has any, the eyes of a converted scene's camera, whose place is the view point's. A file's
// camera also sets position and orientation, unless an option does. Throws ods::Error.
void take_base(CameraOptions& camera, const std::optional<ForeignScene>& scene, const BlenderOptions& blender);

// Applies the changes to the camera, reads the maps, and finds the height of the picture if it is 0. Throws UsageError
// if the options do not fit together, and ods::Error.
void finish_camera_options(CameraOptions& camera, int width, int& height);

// Returns the camera that the options specify. Without options: the scene's first view point; otherwise eye height
// above the origin, or above the centre of the scene; otherwise in front of an object too small to stand in, so that
// all of it is visible. Notes which one. Pitch and roll of a view point are ignored: in a headset the horizon must be
// level. Throws UsageError.
ods::StereoCamera place_camera(const CameraOptions& camera, const ods::Scene& scene);

// Returns the camera that the options specify, for any scene; without a move.
ods::SceneCamera scene_camera(const CameraOptions& camera);

// Notes where the camera is. stereo: the camera, which may have moved since it was placed.
void note_camera(const CameraOptions& camera, const ods::Scene& scene, const ods::StereoCamera& stereo);

// Returns the camera that the options specify if there is no scene: at the origin by default.
ods::StereoCamera place_camera(const CameraOptions& camera);
