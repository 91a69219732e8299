// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a camera without a scene: from a sidecar, or as ods render takes them.
#pragma once
#include <optional>

#include "cli/options/camera_options.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/render/render_options.h"

struct CameraSource {
  CameraOptions camera;
  ods::Sidecar file;
  std::optional<ods::Layout> layout;  // value of --layout
  int width = 2048;                   // of one eye
  ods::Eyes eyes = ods::Eyes::kBothEyes;
};

// --from takes effect first: the options after it change what it read.
void add_camera_source(Options& options, CameraSource& source);

// The result of the options, once they are parsed. Throws UsageError and ods::Error.
ods::Sidecar read_camera_source(CameraSource& source);
