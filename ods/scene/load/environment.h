// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Environment light from a picture of the sky.
#pragma once
#include <string>

#include "ods/scene/scene.h"

namespace ods {

// A lat-long picture in any format of file_format.h: .hdr and .exr hold radiance, the others display-encoded colour;
// read_image() converts both to linear light, and `color_fault` receives the colour metadata that is ignored. The
// picture covers the whole sphere; one that is not twice as wide as high looks stretched (check the width and height
// returned). Negative and NaN texels become 0, infinite ones 65504, the largest half float;
// larger ones are clamped to 1e9. Throws Error(kInput).
Environment load_environment(const std::string& path, std::string* color_fault = nullptr);

}  // namespace ods
