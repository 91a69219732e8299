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

// A scene ready to be rendered, for videos: from one frame to the next only what moves is rebuilt.
class CpuRenderer {
 public:
  // threads: 0 for all processors. The scene must outlive this object.
  explicit CpuRenderer(const Scene& scene, int threads = 0);
  ~CpuRenderer();

  // Applies what set_time() changed in the scene.
  void update(const SceneChange& change);

  // Renders as render_cpu() does on a new CpuRenderer, bit for bit, whatever was rendered before.
  // options.threads is ignored.
  Picture render(const StereoCamera& camera, const RenderOptions& options, const Progress& progress = {}) const;

  // Likewise with a camera that moves while the shutter is open. path: the camera at evenly spaced times from the
  // shutter's opening to its closing, an odd number of them; all but position and orientation is that of the middle
  // camera, and so is the depth layer. With open_shutter() the scene moves as well: every sample has its own time,
  // evenly distributed.
  Picture render(std::span<const StereoCamera> path, const RenderOptions& options, const Progress& progress = {}) const;

  // Likewise, in a way that can be interrupted: goes on from `samples`, which are no_samples() or those that an earlier
  // call has kept, and leaves what develop() makes the picture of. The result has the same bits, wherever it was
  // interrupted. `keep` gets the samples at least every 30 seconds, or, if it takes longer than 2.5 seconds, when ten
  // times as much has passed; and before kCancelled is thrown. cells: of fill_cells(), instead of a light cache of its
  // own. Precondition: options.height > 0, fit(samples, options).
  void sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
              const Progress& progress = {}, const KeepSamples& keep = {}, const LightCells* cells = nullptr) const;

  // The light cache that sample() would fill, for several pictures from one place while the scene stays as it is.
  // Without cells if the options ask for no cache. Precondition: options.height > 0.
  LightCells fill_cells(std::span<const StereoCamera> path, const RenderOptions& options,
                        const Progress& progress = {}) const;

  // What the depth layer shows: for each of eye_list(options.eyes) and each pixel, row by row, what the ray through its
  // centre hits; t is the depth, negative if there is nothing. Precondition: options.height > 0.
  std::vector<std::vector<Hit>> center_hits(const StereoCamera& camera, const RenderOptions& options) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Renders every requested eye. The same arguments give the same bits, whatever the number of threads, on processors
// with the same instruction set (Scene::portable: nearly on all). Throws Error: kCancelled if progress requests it;
// kMemory, before anything else, if the machine has too little memory for the picture (picture_bytes). Precondition:
// width > 0, samples > 0, bounces >= 0, threads >= 0.
Picture render_cpu(const Scene& scene, const StereoCamera& camera, const RenderOptions& options,
                   const Progress& progress = {});

}  // namespace ods
