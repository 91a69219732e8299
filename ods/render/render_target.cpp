// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/render_target.h"

#include <fmt/format.h>

#include <cassert>

#include "ods/base/memory.h"
#include "ods/camera/projection.h"

namespace ods {

RenderOptions with_height(RenderOptions options, const StereoCamera& stereo) {
  assert(options.width > 0 && options.height >= 0 && options.samples > 0 && options.bounces >= 0);
  if (options.height == 0) options.height = natural_height(stereo.projection, options.width);
  return options;
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
