// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/layered_picture.h"

#include <algorithm>

#include "ods/layers/as_scene.h"
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"

namespace ods {

namespace {

constexpr int kSamples = 16;         // a pixel: enough for edges, as nothing is noisy
constexpr float kUsualIpd = 0.065f;  // metres

SaveOptions save_options(const LayeredPictureOptions& options) {
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  save.jpeg_quality = options.jpeg_quality;
  return save;
}

}  // namespace

void check_layered_picture(const std::string& path, const LayeredPictureOptions& options) {
  check_output(path, save_options(options), eye_list(Eyes::kBothEyes), {options.width, options.width / 2});
}

void write_layered_picture(const LayeredScene& layers, const std::string& path, const LayeredPictureOptions& options,
                           const Progress& progress) {
  check_layered_picture(path, options);
  StereoCamera camera;
  camera.position = layers.box.center;
  camera.yaw = layers.yaw;
  camera.ipd = std::min({kUsualIpd, layers.box.size.x, layers.box.size.z});
  camera.top = camera.bottom = kUsualMerge;
  RenderOptions render;
  render.width = options.width;
  render.samples = kSamples;
  render.bounces = 0;
  render.layers = false;
  render.threads = options.threads;
  const Scene scene = as_scene(layers);
  save_picture(render_cpu(scene, camera, render, progress), camera, save_options(options), path);
}

}  // namespace ods
