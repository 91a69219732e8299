// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/camera_source.h"

#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"

using ods::Sidecar, ods::Eyes;

namespace {

void load(const std::string& path, CameraSource& source) {
  std::vector<std::string> warnings;
  source.file = ods::open_camera(path, warnings);
  for (const std::string& warning : warnings) note(warning);
  CameraOptions& camera = source.camera;
  camera.stereo = source.file.camera;
  camera.position = camera.stereo.position;
  camera.yaw = camera.stereo.yaw, camera.pitch = camera.stereo.pitch, camera.roll = camera.stereo.roll;
  if (source.file.eye.width > 0) source.width = source.file.eye.width;
  for (const Eyes eyes : ods::kAllEyes) {
    if (ods::eye_list(eyes) == source.file.eyes) source.eyes = eyes;
  }
}

}  // namespace

void add_camera_source(Options& options, CameraSource& source) {
  options.group("Picture");
  options.custom(
      "--from", ValueKind::input_file(), "", [&](const std::string& path) { load(path, source); },
      "take the camera from a .camera.json file or a picture that carries it");
  options.number("--width", source.width, 2, 32768, "width of one eye in pixels");
  options.choice("--eyes", source.eyes, ods::kEyesTable, "which eyes to make");
  add_layout_option(options, source.layout,
                    "how both eyes share the file; by default top-bottom, side-by-side for vr180");
  add_sceneless_camera_options(options, source.camera);
}

Sidecar read_camera_source(CameraSource& source) {
  // The source's height goes with its width.
  int height = source.width == source.file.eye.width ? source.file.eye.height : 0;
  finish_camera_options(source.camera, source.width, height);
  Sidecar file = source.file;
  file.camera = place_camera(source.camera);
  const ods::Layout kept = layout_of_converted(file.layout, source.file.camera.projection, file.camera.projection);
  file.layout = source.layout.value_or(kept);
  file.eyes = ods::eye_list(source.eyes);
  file.eye = {source.width, height};
  return file;
}
