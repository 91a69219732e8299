// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/camera_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "cli/options/field_option.h"
#include "ods/base/error.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/stage/place.h"

using ods::CameraField, ods::StereoCamera, ods::Scene, ods::vec3, ods::ViewPoint;

vec3 parse_point(const std::string& name, const std::string& word) {
  const std::vector<float> p = parse_numbers(word);
  const bool legal = p.size() == 3 && std::all_of(p.begin(), p.end(),
                                                  [](float x) { return range_of(CameraField::kPosition).contains(x); });
  if (!legal) throw UsageError(fmt::format("{} is X,Y,Z in metres, each within 1e6, not '{}'", name, word));
  return {p[0], p[1], p[2]};
}

static void add_position_option(Options& options, CameraOptions& camera) {
  options.custom(
      "--position", "X,Y,Z", "", [&](const std::string& word) { camera.position = parse_point("--position", word); },
      "midpoint between the eyes, in metres; +Y is up");
}

static void add_attitude_options(Options& options, CameraOptions& camera) {
  add_field_option(options, "--yaw", camera.yaw, CameraField::kYaw,
                   "turn to the right, degrees; at 0 the picture's centre looks along -Z");
  add_field_option(options, "--pitch", camera.pitch, CameraField::kPitch, "tilt up, degrees; tilts the horizon too");
  add_field_option(options, "--roll", camera.roll, CameraField::kRoll,
                   "roll clockwise, degrees; tilts the horizon too");
  add_camera_preset_option(options, camera.changes);
  add_eye_options(options, camera);
  add_projection_options(options, camera.changes.projection);
}

// Keeps the tilt of the options.
static void take_scene_camera(CameraOptions& camera, const ForeignScene& scene) {
  if (!scene.camera) return;
  const StereoCamera& own = scene.camera->camera;
  camera.stereo.projection = own.projection;
  if (own.pitch != 0.0f && !camera.pitch) camera.pitch = own.pitch;
  if (own.roll != 0.0f && !camera.roll) camera.roll = own.roll;
  camera.stereo.lens_radius = own.lens_radius;
  camera.stereo.focus_distance = own.focus_distance;
  if (!scene.has_stereo) return;
  camera.stereo.ipd = own.ipd;
  camera.stereo.convergence = own.convergence;
  camera.stereo.convergence_distance = own.convergence_distance;
  camera.stereo.top = own.top;
  camera.stereo.bottom = own.bottom;
}

void take_pose(CameraOptions& camera, const StereoCamera& own) {
  camera.position = camera.position.value_or(own.position);
  camera.yaw = camera.yaw.value_or(own.yaw);
  camera.pitch = camera.pitch.value_or(own.pitch);
  camera.roll = camera.roll.value_or(own.roll);
}

void take_base(CameraOptions& camera, const std::optional<ForeignScene>& scene, const BlenderOptions& blender) {
  if (camera.file.empty()) {
    if (scene) take_scene_camera(camera, *scene);
  } else if (is_foreign_scene(camera.file)) {
    const ForeignScene other = convert_foreign_scene(camera.file, blender);
    if (!other.camera) throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}' has no camera", camera.file));
    take_scene_camera(camera, other);
    take_pose(camera, other.camera->camera);
  } else {
    camera.stereo = read_camera_file(camera.file).camera;
    take_pose(camera, camera.stereo);
  }
}

ods::Sidecar read_camera_file(const std::string& path) {
  std::vector<std::string> warnings;
  ods::Sidecar file = ods::open_camera(path, warnings);
  for (const std::string& warning : warnings) note(warning);
  return file;
}

static void add_view_options(Options& options, CameraOptions& camera) {
  options.text("--camera", "NAME", camera.view_point,
               "a camera in the file (ods info lists them), or none; by default the first, unless the whole scene is a "
               "speck in it");
  add_position_option(options, camera);
}

void add_place_options(Options& options, CameraOptions& camera) {
  options.group("Camera");
  add_view_options(options, camera);
}

void add_camera_file_option(Options& options, std::string& file, const std::string& text) {
  options.text("--camera-file", ValueKind::input_file(), file, text);
}

void add_camera_options(Options& options, CameraOptions& camera) {
  camera.may_follow_depth = true;
  options.group("Camera");
  add_camera_file_option(
      options, camera.file,
      "take the camera, including its position, from a .blend, a .camera.json or a picture that carries it");
  add_view_options(options, camera);
  add_attitude_options(options, camera);
}

void add_sceneless_camera_options(Options& options, CameraOptions& camera) {
  options.group("Camera");
  add_position_option(options, camera);
  add_attitude_options(options, camera);
}

void finish_camera_options(CameraOptions& camera, int width, int& height) {
  const CameraChanges& changes = camera.changes;
  if (changes.preset && !changes.preset->note.empty()) note(changes.preset->note);
  camera.stereo = changed(camera.stereo, changes);
  read_maps(changes, camera.stereo);
  if (!camera.yaw && camera.stereo.yaw != 0.0f) camera.yaw = camera.stereo.yaw;  // a preset's
  finish_projection(camera.stereo.projection, width, height);
}

ods::SceneCamera scene_camera(const CameraOptions& camera) {
  return {camera.stereo, camera.view_point, camera.position, camera.yaw, camera.pitch, camera.roll, {}};
}

void note_camera(const CameraOptions& camera, const Scene& scene, const StereoCamera& stereo) {
  const ViewPoint view = view_of(scene_camera(camera), scene);
  const bool is_ours = ods::camera_choice(camera.view_point) != ods::CameraChoice::kNamed && !uses_own_camera(scene);
  std::string from = is_ours ? view.name : "the scene's camera '" + view.name + "'";
  if (camera.position) from = "--position";
  note(fmt::format("camera at {:.4g},{:.4g},{:.4g}, yaw {:.4g} ({})", stereo.position.x, stereo.position.y,
                   stereo.position.z, stereo.yaw, from));
  if (!camera.pitch && !camera.roll && (std::abs(view.pitch) > 0.5f || std::abs(view.roll) > 0.5f)) {
    note(fmt::format("kept level; --pitch {:.4g} --roll {:.4g} tilts it as in the file", view.pitch, view.roll));
  }
}

StereoCamera place_camera(const CameraOptions& camera, const Scene& scene) {
  const StereoCamera stereo = camera_in(scene_camera(camera), scene);
  note_camera(camera, scene, stereo);
  return stereo;
}

ods::StereoCamera place_camera(const CameraOptions& camera) {
  ods::StereoCamera stereo = camera.stereo;
  stereo.position = camera.position.value_or(vec3(0.0f));
  stereo.yaw = camera.yaw.value_or(0.0f);
  stereo.pitch = camera.pitch.value_or(0.0f);
  stereo.roll = camera.roll.value_or(0.0f);
  return stereo;
}
