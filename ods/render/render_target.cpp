// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/render_target.h"

#include <fmt/format.h>

#include <cassert>

#include "ods/base/memory.h"
#include "ods/camera/projection.h"
#include "ods/render/picture_samples.h"

namespace ods {

RenderOptions with_height(RenderOptions options, const StereoCamera& stereo) {
  assert(options.width > 0 && options.height >= 0 && options.samples > 0 && options.bounces >= 0);
  if (options.height == 0) options.height = natural_height(stereo.projection, options.width);
  return options;
}

size_t picture_bytes(const RenderOptions& options) {
  const size_t radiance = 3, alpha = 1, depth = 1, normal = 3, albedo = 3, variance = 3, samples = 1;
  const size_t channels = radiance + (options.transparent ? alpha : 0) +
                          (options.layers ? depth + normal + albedo : 0) +
                          (options.statistics ? variance + samples : 0);
  const size_t pixels = static_cast<size_t>(options.width) * static_cast<size_t>(options.height);
  return eye_list(options.eyes).size() * pixels * channels * sizeof(float) + samples_bytes(options);
}

void check_picture_memory(const RenderOptions& options) {
  check_memory(picture_bytes(options), fmt::format("a picture {} pixels wide", options.width),
               "a smaller width or a single eye needs less");
}

Picture blank_picture(const RenderOptions& options) {
  Picture picture;
  for (int eye : eye_list(options.eyes)) {
    const int w = options.width, h = options.height;
    EyeImage& image = picture.eyes.emplace_back(EyeImage{eye, Image(w, h, 3), {}, {}, {}, {}});
    if (options.transparent) image.alpha = Image(w, h, 1);
    if (options.statistics) image.variance = Image(w, h, 3), image.samples = Image(w, h, 1);
    if (!options.layers) continue;
    image.depth = Image(w, h, 1);
    image.normal = image.albedo = Image(w, h, 3);
  }
  return picture;
}

}  // namespace ods
