// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The path tracer on the CPU: the kernel on Embree.
#pragma once
#include <memory>
#include <span>

#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"
#include "ods/scene/motion.h"

namespace ods {

// A scene ready to be rendered, for videos: from one frame to the next only what moves is made anew.
class CpuRenderer {
 public:
  // threads: 0 for all of the machine's. The scene must outlive this object.
  explicit CpuRenderer(const Scene& scene, int threads = 0);
  ~CpuRenderer();

  // What set_time() has changed in the scene.
  void update(const SceneChange& change);

  // As render_cpu(), which it is on a new CpuRenderer, bit for bit, whatever was rendered before. options.threads does
  // not count.
  Picture render(const StereoCamera& camera, const RenderOptions& options, const Progress& progress = {}) const;

  // The same with a camera that moves while the shutter is open: where it is at even times from its opening to its
  // closing, an odd number of them; all but its place and orientation is that of the middle, and so is the depth layer.
  // With open_shutter() the scene moves as well: every sample is of a time of its own, evenly spread.
  Picture render(std::span<const StereoCamera> path, const RenderOptions& options, const Progress& progress = {}) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Renders every eye asked for. The same arguments give the same bits, whatever the number of threads.
// Throws Error: kCancelled when progress says so, kMemory before anything else when the machine has too little for the
// picture (picture_bytes).
// Precondition: width a positive number, samples and bounces not negative (samples > 0), threads >= 0.
Picture render_cpu(const Scene& scene, const StereoCamera& camera, const RenderOptions& options,
                   const Progress& progress = {});

}  // namespace ods
