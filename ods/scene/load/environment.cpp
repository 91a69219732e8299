// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/load/environment.h"

#include <algorithm>
#include <cmath>

#include "ods/image/image_file.h"

namespace ods {

static float repaired(float value) {
  constexpr float kBrightest = 65504.0f;
  if (!(value > 0.0f)) return 0.0f;  // also for NaN
  return std::isinf(value) ? kBrightest : std::min(value, 1e9f);
}

Environment load_environment(const std::string& path, std::string* color_fault) {
  const Image image = read_image(path, color_fault);
  Environment environment;
  environment.radiance = vec3(1.0f);
  environment.width = image.width;
  environment.height = image.height;
  environment.texels.reserve(image.pixels.size() / 3);
  for (size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    environment.texels.emplace_back(repaired(image.pixels[i]), repaired(image.pixels[i + 1]),
                                    repaired(image.pixels[i + 2]));
  }
  return environment;
}

}  // namespace ods
