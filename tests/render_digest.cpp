// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints a number that stands for every bit of a small picture with a little of everything in it. The test builds this
// program with another compiler and compares.
#include <cstdio>

#include "ods/cpu/render.h"
#include "tests/pictures.h"

int main() {
  ods::RenderOptions options = ods::small_render(64, 8);
  options.eyes = ods::Eyes::kBothEyes;
  options.filter = ods::PixelFilter::kBlackmanHarris;
  ods::CameraRig rig;
  rig.yaw = 20.0f;
  rig.top.mode = ods::kMergeCosine;
  rig.bottom.mode = ods::kMergeSmoothstep;
  const ods::Picture picture = ods::render_cpu(ods::feature_scene(), rig, options);
  std::printf("%016llx\n", static_cast<unsigned long long>(ods::digest(picture)));
}
