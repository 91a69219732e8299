// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The path tracer on the CPU: the kernel on Embree.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"
#include "ods/render/cpu/light_cells.h"
#include "ods/render/keeper.h"
#include "ods/render/picture_samples.h"
#include "ods/render/render_options.h"
#include "ods/scene/motion.h"

namespace ods {

// A scene prepared for rendering several pictures. Between the frames of a video, only moving objects are rebuilt.
class CpuRenderer {
 public:
  // threads: 0 for all processors. The scene must outlive this object.
  explicit CpuRenderer(const Scene& scene, int threads = 0);
  ~CpuRenderer();

  // Applies changes of the scene by set_time().
  void update(const SceneChange& change);

  // Renders the same bits as render_cpu() on a new CpuRenderer, independent of earlier pictures. Ignores
  // options.threads.
  Picture render(const StereoCamera& camera, const RenderOptions& options, const Progress& progress = {}) const;

  // Renders with a camera that moves while the shutter is open. path: the camera at an odd number of evenly spaced
  // times from the shutter's opening to its closing. Everything but position and orientation is taken from the middle
  // camera, and so is the depth layer. With open_shutter() the scene moves as well: every sample has its own time,
  // evenly distributed.
  Picture render(std::span<const StereoCamera> path, const RenderOptions& options, const Progress& progress = {}) const;

  // Renders in a way that can be interrupted: continues from `samples`, which are no_samples() or samples stored by an
  // earlier call, and adds to them until develop() can compute the final picture. The result has the same bits wherever
  // it was interrupted. `keep` receives the samples at least every 30 seconds, or, if it takes longer than 2.5 seconds,
  // after ten times as long; and before kCancelled is thrown. cells: from fill_cells(), instead of a light cache of its
  // own. Precondition: options.height > 0, fit(samples, options).
  void sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
              const Progress& progress = {}, const KeepSamples& keep = {}, const LightCells* cells = nullptr) const;

  // Fills the light cache of sample() once, for several pictures from one place while the scene does not change.
  // Returns no cells if the options do not use a cache. Precondition: options.height > 0.
  LightCells fill_cells(std::span<const StereoCamera> path, const RenderOptions& options,
                        const Progress& progress = {}) const;

  // The hits behind the depth layer: for each of eye_list(options.eyes) and each pixel, row by row, the hit of the ray
  // through its centre; t is the depth, negative if there is no hit. Precondition: options.height > 0.
  std::vector<std::vector<Hit>> center_hits(const StereoCamera& camera, const RenderOptions& options) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Renders every requested eye. The same arguments give the same bits, whatever the number of threads, on processors
// with the same instruction set (on nearly all processors with Scene::portable). Throws Error: kCancelled if progress
// requests it; kMemory, before anything else, if the machine has too little memory for the picture (picture_bytes).
// Precondition: width > 0, samples > 0, bounces >= 0, threads >= 0.
Picture render_cpu(const Scene& scene, const StereoCamera& camera, const RenderOptions& options,
                   const Progress& progress = {});

}  // namespace ods
