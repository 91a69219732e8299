// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The data that all paths of a picture share, the start of a path, and the loop that continues it.
#pragma once
#include <span>

#include "ods/kernel/camera/texel_ray.h"
#include "ods/kernel/path.h"
#include "ods/render/cpu/embree_scene.h"
#include "ods/render/moving_camera.h"
#include "ods/render/render_options.h"

namespace ods {

struct Job {
  const EmbreeScene& embree;
  PathTracer tracer;
  std::span<const Camera>
      cameras;    // evenly spaced in time from the shutter's opening to its closing; a single one for a static camera
  Camera camera;  // the one in the middle
  bool shutter;   // every sample has its own time
  Media media;    // the media that the camera is in
  RenderOptions options;
  PathSettings settings;
  int filter;
  double unit;  // layer_unit()
  bool shares;  // paths of one eye contribute light to the other
};

inline Camera camera_at_time(const Job& job, float time) {
  return job.cameras.size() > 1 ? camera_at(job.cameras, time) : job.camera;
}

struct FirstRay {
  Ray ray;  // direction 0 if the picture is empty there
  float time;
};

// home: the centre of the sample's pixel. uv: the sample's position.
inline FirstRay first_ray(const Job& job, int eye, vec2 home, vec2 uv, uint seed, uint index) {
  const vec2 lens = job.camera.lens_radius > 0.0f ? random_pair(seed, index, kLensPair) : vec2(0.0f);
  const float time = job.shutter ? random_pair(seed, index, kTimePair).x : 0.5f;
  if (job.cameras.size() > 1) return {sample_ray(camera_at(job.cameras, time), eye, home, uv, lens), time};
  return {sample_ray(job.camera, eye, home, uv, lens), time};
}

// The render loop, from the first hit on. Calls shaded(step) after each surface. Inlining the whole kernel here, and
// the camera above, makes it a quarter faster.
template <typename Shaded>
[[gnu::flatten]] void trace_path(Job& job, Hit hit, const Shaded& shaded) {
  PathTracer& tracer = job.tracer;
  const PathState& path = tracer.path;
  while (true) {
    tracer.shade(hit, job.settings);
    shaded(tracer.this_step);
    if (path.shadow_pending && job.embree.reaches_light(tracer)) tracer.add_shadow_light();
    if (!path.alive) return;
    hit = job.embree.closest_hit(tracer, path.ray, kPathRay);
  }
}

}  // namespace ods
