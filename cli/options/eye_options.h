// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of the two eyes: a preset of another system, distance, merges, convergence, lens.
#pragma once
#include "cli/options/camera_options.h"

void add_camera_preset_option(Options& options, CameraChanges& changes);
// add_circle_options() adds the options of the viewing circle: distance, merges, convergence, neck. add_eye_options()
// adds them and the rest.
void add_circle_options(Options& options, CameraOptions& camera);
void add_eye_options(Options& options, CameraOptions& camera);

// `auto[,MINUTES]`: the limit in minutes of arc; nullopt if it is another merge. Throws UsageError.
std::optional<float> parse_auto_merge(const std::string& text);

// Describes the stereo that a merge map leaves, if the map is the same all around: "full stereo up to 41 degrees up and
// ...".
std::string merge_curve_text(const ods::Image& merge_map);
// Describes a merge that follows from depth, for a note.
std::string merge_by_depth_text(const ods::Image& merge_map);

// The camera with the changes, except for its maps. Throws UsageError if the options do not fit together.
ods::StereoCamera changed(ods::StereoCamera camera, const CameraChanges& changes);

// Reads the pictures that --merge-map and --head-tilt-map name into a camera with the changes. Throws UsageError and
// ods::Error.
void read_maps(const CameraChanges& changes, ods::StereoCamera& camera);
