// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene prepared for rendering several pictures on a device, such as the CPU (ods/render/cpu/render.h).
#pragma once
#include <span>
#include <vector>

#include "ods/base/progress.h"
#include "ods/camera/stereo_camera.h"
#include "ods/picture/picture.h"
#include "ods/render/keeper.h"
#include "ods/render/picture_samples.h"
#include "ods/render/render_options.h"
#include "ods/scene/motion.h"

namespace ods {

struct LightCells;

class Renderer {
 public:
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  virtual ~Renderer() = default;

  // Applies changes of the scene by set_time().
  virtual void update(const SceneChange& change) = 0;

  // Renders a picture, independent of earlier pictures. Ignores options.threads. Throws Error(kMemory) before anything
  // else if the machine has too little memory for the picture (picture_bytes).
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
  // own. Precondition: options.height > 0, fit(samples, options), fit_camera() (ods/render/render_target.h).
  virtual void sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
                      const Progress& progress = {}, const KeepSamples& keep = {},
                      const LightCells* cells = nullptr) const = 0;

  // The hits behind the depth layer: for each of eye_list(options.eyes) and each pixel, row by row, the hit of the ray
  // through its centre; t is the depth, negative if there is no hit. Precondition: options.height > 0.
  virtual std::vector<std::vector<Hit>> center_hits(const StereoCamera& camera, const RenderOptions& options) const = 0;
};

}  // namespace ods
