// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that place the camera, shared by the commands that have one.
#pragma once
#include <optional>
#include <string>

#include "cli/bridge/foreign_scene.h"
#include "cli/console/options.h"
#include "cli/options/scene_source.h"
#include "ods/camera/stereo_camera.h"
#include "ods/scene/scene.h"

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
  std::string from;                          // --camera-from
  std::optional<ForeignScene> from_foreign;  // what became of it, if it is the scene of another program
  std::vector<std::string> notes;            // on what the options mean
};

// Parses a position X,Y,Z. name: of the option, for the message. Throws UsageError.
ods::vec3 parse_point(const std::string& name, const std::string& word);

// add_place_options() adds --camera and --position. add_camera_options() adds --camera-from, which the others change,
// these, then the orientation, the eyes and the projection, for a command whose scene argument was added before.
void add_place_options(Options& options, CameraOptions& camera);
void add_camera_options(Options& options, CameraOptions& camera, const SceneSource& scene);
// Likewise without --camera, where no scene could have one.
void add_sceneless_camera_options(Options& options, CameraOptions& camera);

// The lens, the tilt and, if it has any, the eyes of a foreign scene's camera. Its place is that of the view point.
void take_camera(CameraOptions& camera, const ForeignScene& scene);

// Scenes of other programs on a command line. They are converted when the line has been parsed once, so that a typo is
// told before Blender starts. The line is then parsed again over their cameras: options win over a file.
struct ForeignScenes {
  std::optional<ForeignScene> scene, camera_from;
};

// Whether the line names such a scene that is not converted yet. Until then finish_camera_options() has no camera.
bool is_unread_foreign(const SceneSource& scene, const CameraOptions& camera);

// Converts them. Throws as read_foreign(), and Error(kInput) if the file of --camera-from has no camera.
ForeignScenes read_foreign_scenes(const SceneSource& scene, const CameraOptions& camera);

// Begins the second parsing.
void take_foreign(SceneSource& scene, CameraOptions& camera, const ForeignScenes& foreign);

// Checks the options as a whole, notes what they mean, reads the maps, and finds the height of the picture if it is 0.
// Throws UsageError and ods::Error.
void finish_camera_options(CameraOptions& camera, int width, int& height);

// The camera that the options ask for. Without options: the scene's first view point; otherwise eye height above the
// origin, or above the centre of the scene; otherwise in front of an object too small to stand in, so that all of it is
// visible. Notes which.
// Pitch and roll of a view point are ignored: in a headset the horizon must be level. Throws UsageError.
ods::StereoCamera place_camera(const CameraOptions& camera, const ods::Scene& scene);

// Likewise without the note: for every frame of a video.
ods::StereoCamera place_camera_again(const CameraOptions& camera, const ods::Scene& scene);

// That note. stereo: the camera, which may have moved since it was placed.
void note_camera(const CameraOptions& camera, const ods::Scene& scene, const ods::StereoCamera& stereo);

// Whether the file's animation, as it plays, moves this camera. Throws UsageError.
bool file_moves_camera(const CameraOptions& camera, const ods::Scene& scene);

// The camera that the options ask for if there is no scene: at the origin by default.
ods::StereoCamera place_camera(const CameraOptions& camera);
