// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that say how the eyes stand: after another system, their distance, merges, convergence, lens.
#pragma once
#include "cli/options/camera_options.h"

void add_camera_preset_option(Options& options, CameraOptions& camera);
// What makes up the viewing circle: distance, merges, convergence, neck. Then the rest too.
void add_circle_options(Options& options, CameraOptions& camera);
void add_eye_options(Options& options, CameraOptions& camera);

// Reads the picture that --merge-map names. Throws UsageError and ods::Error.
void finish_eye_options(CameraOptions& camera);
