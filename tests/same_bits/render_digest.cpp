// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints numbers that stand for every bit of a small picture with a little of everything in it, and of one of things
// that move. The test builds this program with another compiler and compares.
#include <cstdio>

#include "ods/render/cpu/render.h"
#include "ods/scene/load/load.h"
#include "ods/scene/shutter.h"
#include "tests/support/pictures.h"

int main() {
  ods::RenderOptions options = ods::small_render(64, 8);
  options.eyes = ods::Eyes::kBothEyes;
  options.filter = ods::PixelFilter::kBlackmanHarris;
  ods::StereoCamera camera;
  camera.yaw = 20.0f;
  camera.top.mode = ods::kMergeCosine;
  camera.bottom.mode = ods::kMergeSmoothstep;
  const ods::Picture picture = ods::render_cpu(ods::feature_scene(), camera, options);
  ods::Scene toys = ods::load_scene("toys");
  ods::play(toys.animation, "");
  ods::open_shutter(toys, 1.3, 1.32);
  camera.position = toys.view_points[0].position;
  const ods::Picture moving = ods::render_cpu(toys, camera, options);
  std::printf("%016llx %016llx\n", static_cast<unsigned long long>(ods::digest(picture)),
              static_cast<unsigned long long>(ods::digest(moving)));
}
