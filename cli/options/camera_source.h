// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a camera without a scene: from a file, or as ods render takes them.
#pragma once
#include <optional>

#include "cli/options/camera_options.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/render/render_options.h"

struct CameraSource {
  CameraOptions camera;               // its file: a .camera.json or a picture that carries it
  std::optional<ods::Layout> layout;  // value of --layout
  std::optional<int> width;           // of one eye; by default the file's, else 2048
  std::optional<ods::Eyes> eyes;      // by default the file's, else both
};

void add_camera_source(Options& options, CameraSource& source);

// Returns the camera that the options specify, in the form used by the file or the options. Sets source.camera to that
// camera. Throws UsageError and ods::Error.
ods::Sidecar read_camera_source(CameraSource& source);
