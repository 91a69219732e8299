// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/cpu/render.h"

namespace ods {

Picture render_cpu(const Scene&, const CameraRig&, const RenderOptions& options, const Progress&) {
  Picture picture;  // placeholder while the kernel is being written
  const int count = options.eyes == Eyes::kBothEyes ? 2 : 1;
  for (int i = 0; i < count; i++) {
    const int w = options.width, h = options.width / 2;
    const int eye = options.eyes == Eyes::kBothEyes ? i : options.eyes == Eyes::kMonoEye ? kMono : options.eyes == Eyes::kLeftEye ? kLeft : kRight;
    picture.eyes.push_back({eye, Image(w, h, 3), Image(w, h, 1), Image(w, h, 3), Image(w, h, 3)});
  }
  return picture;
}

}  // namespace ods
