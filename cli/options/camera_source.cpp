// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options/camera_source.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/options/picture_options.h"

using ods::Sidecar;

void add_camera_source(Options& options, CameraSource& source) {
  options.group("Picture");
  add_camera_file_option(options, source.camera.file,
                         "take the camera from a .camera.json file or a picture that carries it");
  options.number("--width", source.width, 2, 32768, "width of one eye in pixels",
                 fmt::format("{}", PictureForm().usual_width));
  options.choice("--eyes", source.eyes, ods::kEyesTable, "which eyes to make", "both");
  add_layout_option(options, source.layout,
                    "how both eyes share the file; by default top-bottom, side-by-side for vr180");
  add_sceneless_camera_options(options, source.camera);
}

Sidecar read_camera_source(CameraSource& source) {
  CameraOptions& camera = source.camera;
  Sidecar file;
  if (!camera.file.empty()) {
    file = read_camera_file(camera.file);
    camera.stereo = file.camera;
    take_pose(camera, file.camera);
  }
  const int own_width = file.eye.width > 0 ? file.eye.width : PictureForm().usual_width,
            width = source.width.value_or(own_width);
  int height = width == file.eye.width ? file.eye.height : 0;  // the file's height goes with its width
  const ods::Layout own_layout = file.layout;
  const ods::ProjectionSetting own_projection = file.camera.projection;
  finish_camera_options(camera, width, height);
  file.camera = place_camera(camera);
  file.layout = source.layout.value_or(layout_of_converted(own_layout, own_projection, file.camera.projection));
  if (source.eyes || camera.file.empty()) file.eyes = ods::eye_list(source.eyes.value_or(ods::Eyes::kBothEyes));
  file.eye = {width, height};
  return file;
}
