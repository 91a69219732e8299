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

RenderOptions with_texels(RenderOptions options, int width, int height) {
  options.width = width, options.height = height;
  options.eyes = Eyes::kMonoEye;
  options.filter = PixelFilter::kBox;
  return options;
}

bool fit_camera(const RenderOptions& options, const StereoCamera& stereo) {
  if (!stereo.texel_rays) return true;
  const RenderOptions needed = with_texels(options, stereo.texel_rays->width, stereo.texel_rays->height);
  return options.width == needed.width && options.height == needed.height && options.eyes == needed.eyes &&
         options.filter == needed.filter;
}

size_t picture_bytes(const RenderOptions& options) {
  const size_t radiance = 3, alpha = 1, depth = 1, normal = 3, albedo = 3, variance = 3, samples = 1;
  const size_t channels = radiance + (options.transparent ? alpha : 0) +
                          (options.layers ? depth + normal + albedo : 0) +
                          (options.statistics ? variance + samples : 0);
  const size_t pixels = static_cast<size_t>(options.width) * static_cast<size_t>(options.height);
  const size_t of_eye = pixels * channels * sizeof(float);
  return samples_bytes(options) + of_eye;  // develop() frees the samples of an eye before it makes the next
}

void check_picture_memory(const RenderOptions& options) {
  check_memory(picture_bytes(options), fmt::format("a picture {} pixels wide", options.width),
               "a smaller width or a single eye needs less");
}

EyeImage blank_eye(const RenderOptions& options, int eye) {
  const int w = options.width, h = options.height;
  EyeImage image{eye, Image(w, h, 3), {}, {}, {}, {}};
  if (options.transparent) image.alpha = Image(w, h, 1);
  if (options.statistics) image.variance = Image(w, h, 3), image.samples = Image(w, h, 1);
  if (options.layers) {
    image.depth = Image(w, h, 1);
    image.normal = image.albedo = Image(w, h, 3);
  }
  return image;
}

}  // namespace ods
