// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The path tracer on a graphics card: the kernel as compute shaders, over a tree of its own.
//
// Pictures equal those of the CPU in distribution, not bit by bit: drivers may round differently, and paths part after
// a last bit. Two pictures of one card have the same bits, whatever the order of its work.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "ods/render/gpu/gpu_device.h"
#include "ods/render/gpu/gpu_times.h"
#include "ods/render/renderer.h"

namespace ods {

class GpuRenderer : public Renderer {
 public:
  // slots: pixels that are rendered at once, for tests; 0 for a number that suits the device. Renderers of one device
  // compile its shaders once; they are used one at a time. The scene must outlive this object. Throws Error(kDevice).
  GpuRenderer(const Scene& scene, std::shared_ptr<GpuDevice> device, int slots = 0);
  ~GpuRenderer() override;

  void update(const SceneChange& change) override;

  // Throws Error(kUsage) for what gpu_lacks() names (ods/render/gpu/gpu_lacks.h), and Error(kDevice) if the device
  // fails; `keep` has then received the samples at most half a minute before.
  void sample(std::span<const StereoCamera> path, const RenderOptions& options, PictureSamples& samples,
              const Progress& progress = {}, const KeepSamples& keep = {},
              const LightCells* cells = nullptr) const override;

  // The times of all pictures so far.
  const GpuTimes& times() const;

  // Found on the CPU, in the same tree.
  std::vector<std::vector<Hit>> center_hits(const StereoCamera& camera, const RenderOptions& options) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ods
