// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The passes over a picture on a graphics card. Each pixel of a piece of the picture has a slot, and three stages take
// turns over all slots: `trace` follows the rays that slots wait for, `begin` starts samples and finds what the other
// eye sees, `shade` moves paths by one step (ods/render/gpu/shaders/slot.glsl).
#pragma once
#include "ods/render/gpu/gpu_device.h"
#include "ods/render/gpu/gpu_samples.h"
#include "ods/render/gpu/gpu_times.h"
#include "ods/render/gpu/shaders/shared.h"
#include "ods/render/render_passes.h"

namespace ods {

// Numbers of pipelines.
struct GpuStages {
  size_t trace;
  size_t begin;
  size_t shade;
};

// Compiles the stages, or takes them from the device's cache. whole: as for gpu_shaders()
// (ods/render/gpu/shaders.h).
GpuStages make_stages(GpuDevice& device, bool whole);

class GpuPasses : public PassDevice {
 public:
  // view: complete but for the samples, and what a pass adds. slots: the number of pixels that are rendered at once.
  // The device, the options and the samples must outlive this object.
  GpuPasses(GpuDevice& device, const GpuStages& stages, GpuView view, int slots, const RenderOptions& options,
            PictureSamples& samples);
  ~GpuPasses() override;
  GpuPasses(const GpuPasses&) = delete;
  GpuPasses& operator=(const GpuPasses&) = delete;

  bool render_blocks(const Pass& pass, BlockRange blocks, const Progress& progress, bool whole) override;
  int blocks_at_once() const override { return most_blocks_; }
  void fetch() override { planes_.fetch(samples_); }

  GpuTimes times() const { return times_; }

 private:
  int total_blocks() const;
  void upload_pass(const Pass& pass);
  bool render_slots(const Pass& pass, BlockRange blocks, const Progress& progress, bool whole);
  void run_rounds(GpuRound& round, uint32_t groups);
  bool is_busy(const GpuRound& round);
  void count_samples_of(const Pass& pass, BlockRange blocks);

  GpuDevice& device_;
  GpuStages stages_;
  int most_blocks_;  // that have slots at once
  const RenderOptions& options_;
  PictureSamples& samples_;
  GpuSamples planes_;
  GpuBuffer pass_, slots_, lists_, slots_in_lists_, view_;
  int rounds_ = 1;  // at once
  GpuTimes times_;
};

}  // namespace ods
