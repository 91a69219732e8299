// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Light from a picture of the whole sky.
#pragma once
#include <string>

#include "ods/scene/scene.h"

namespace ods {

// A lat-long picture in any format that file_format.h names: .hdr and .exr hold radiance, the others what a display
// shows; read_image() makes light of both, and says in `color_fault` what of a file's colours it ignores. It covers the
// sphere whatever its shape; one that is not twice as wide as high looks stretched (compare width and height of what is
// returned). Negative texels and those that are not numbers become 0, infinite ones 65504, the largest number of a half
// float, and none exceeds 1e9. Throws Error(kInput).
Environment load_environment(const std::string& path, std::string* color_fault = nullptr);

}  // namespace ods
