// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The stereo 360 picture that a layered scene shows from the middle of its box: for viewers outside the box, and for
// players that know only pictures. It takes seconds, because the light is baked already.
#pragma once
#include <string>

#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"

namespace ods {

struct LayeredPictureOptions {
  int width = 4096;       // of one eye, pixels; lat-long
  int jpeg_quality = 92;  // 1 to 100
  int threads = 0;        // 0 for all processors
};

// Throws the errors of write_layered_picture() that are known before rendering: kUsage and kOutput as check_output()
// (ods/picture/save.h).
void check_layered_picture(const std::string& path, const LayeredPictureOptions& options = {});

// Renders the picture, left eye above the right one, with the usual merge at the poles, and writes it. The eyes are 65 mm
// apart, or less if the box is smaller. Throws Error as
// check_layered_picture(), kMemory, kCancelled.
void write_layered_picture(const LayeredScene& layers, const std::string& path,
                           const LayeredPictureOptions& options = {}, const Progress& progress = {});

}  // namespace ods
