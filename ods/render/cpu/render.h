// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The path tracer on the CPU: the kernel on Embree.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "ods/render/cpu/light_cells.h"
#include "ods/render/renderer.h"

namespace ods {

class CpuRenderer : public Renderer {
 public:
  // threads: 0 for all processors. The scene must outlive this object.
  explicit CpuRenderer(const Scene& scene, int threads = 0);
  ~CpuRenderer() override;

  // Pictures have the same bits as those of render_cpu() on a new CpuRenderer.
  void update(const SceneChange& change) override;
  void sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
              const Progress& progress = {}, const KeepSamples& keep = {},
              const LightCells* cells = nullptr) const override;
  std::vector<std::vector<Hit>> center_hits(const StereoCamera& camera, const RenderOptions& options) const override;

  // Fills the light cache of sample() once, for several pictures from one place while the scene does not change.
  // Returns no cells if the options do not use a cache. Precondition: options.height > 0.
  LightCells fill_cells(std::span<const StereoCamera> path, const RenderOptions& options,
                        const Progress& progress = {}) const;

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
