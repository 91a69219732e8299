// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A camera as the options of ods render: what people can copy from the studio.
#pragma once
#include <string>
#include <vector>

#include "ods/camera/stereo_camera.h"

// The options that give this camera, {"--yaw", "30", ...}: position and yaw, and all else that differs from the
// commands' defaults. Maps are left out: options name files, and a camera has pixels.
std::vector<std::string> camera_words(const ods::StereoCamera& camera);
