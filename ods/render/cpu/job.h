// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What all paths of a picture have in common.
#pragma once
#include <span>

#include "ods/render/cpu/embree_scene.h"
#include "ods/render/render_options.h"

namespace ods {

struct Job {
  const EmbreeScene& embree;
  PathTracer tracer;
  std::span<const Camera>
      cameras;    // evenly spaced in time from the shutter's opening to its closing; one: a static camera
  Camera camera;  // the middle one
  bool shutter;   // every sample has its own time
  Media media;    // the volumes that the camera is in
  RenderOptions options;
  PathSettings settings;
  int filter;
  double unit;  // layer_unit()
  bool shares;  // paths of one eye bring light to the other
};

}  // namespace ods
