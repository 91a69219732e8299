// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A camera as options of ods render, to copy from the studio.
#pragma once
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"

// The options that give this camera in a picture of this width, {"--yaw", "30", ...}: position and yaw, and all else
// that differs from the commands' defaults. Its maps are files whose names begin with `maps`: options name files, and a
// camera has pixels.
std::vector<std::string> camera_arguments(const ods::StereoCamera& camera, int width, const std::string& maps);

// Writes those files; returns the parts of their names after `maps`. Throws Error(kOutput).
std::vector<std::string> save_maps(const ods::StereoCamera& camera, const std::string& maps);
