// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/render_options.h"

#include "ods/kernel/camera/camera.h"

namespace ods {

std::vector<int> eye_list(Eyes eyes) {
  switch (eyes) {
    case Eyes::kBothEyes:
      return {kLeft, kRight};
    case Eyes::kLeftEye:
      return {kLeft};
    case Eyes::kRightEye:
      return {kRight};
    case Eyes::kMonoEye:
      return {kMono};
  }
  return {};
}

size_t picture_bytes(const RenderOptions& options) {
  const size_t radiance = 3, alpha = 1, depth = 1, normal = 3, albedo = 3, variance = 3, samples = 1;
  const size_t channels = radiance + (options.transparent ? alpha : 0) +
                          (options.layers ? depth + normal + albedo : 0) +
                          (options.statistics ? variance + samples : 0);
  const size_t width = static_cast<size_t>(options.width);
  return eye_list(options.eyes).size() * width * static_cast<size_t>(options.height) * channels * sizeof(float);
}

}  // namespace ods
