// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The passes over a picture, on whatever device: adaptive sampling, progress, and the samples that are kept.
#pragma once
#include <span>
#include <vector>

#include "ods/base/progress.h"
#include "ods/kernel/camera/camera.h"
#include "ods/render/keeper.h"
#include "ods/render/picture_samples.h"
#include "ods/render/sampling_plan.h"
#include "ods/scene/scene.h"

namespace ods {

// Adds the samples from..to - 1 of all noisy pixels, or each block's share of them.
struct Pass {
  const SamplingPlan& plan;
  const std::vector<uint8_t>& noisy;
  int from;
  int to;
  SampleRange whole;  // range over which shared paths are balanced: this pass, or all samples if no pixel stops early
};

inline bool is_noisy(const Pass& pass, size_t block, int x, int y) {
  return pass.noisy[block] >> class_of(x, y) & 1;
}

// The weight of a noisy pixel's samples in the pass.
inline float block_weight(const Pass& pass, size_t block) {
  return static_cast<float>(samples_of(pass.plan, block, pass.whole.end) -
                            samples_of(pass.plan, block, pass.whole.begin));
}

// Returns whether the pass is the first of its part of the picture, which finds the depths, too.
inline bool is_first(const Pass& pass, const RenderOptions& options) {
  return pass.from == samples_of_part(options).begin;
}

// Blocks begin .. end - 1 of the picture, counted over all eyes.
struct BlockRange {
  int begin;
  int end;
};

// The work of a device in a pass.
class PassDevice {
 public:
  virtual ~PassDevice() = default;

  // Adds the pass's samples of some blocks. Returns false if it was cancelled; whole: it ignores progress.cancelled,
  // because samples of half a range cannot be kept. The thread that finishes a block reports the progress of the pass.
  virtual bool render_blocks(const Pass& pass, BlockRange blocks, const Progress& progress, bool whole) = 0;

  // The number of blocks that keep the device busy: it is given so many at once, if there are.
  virtual int blocks_at_once() const { return 16; }

  // Brings all samples so far to PictureSamples, for a device that keeps them elsewhere.
  virtual void fetch() {}
};

// Renders passes until the picture is clean, has all samples or has no time left. The device adds to `samples`. Throws
// Error(kCancelled).
void render_passes(PassDevice& device, const SamplingPlan& plan, const RenderOptions& options, PictureSamples& samples,
                   const Progress& progress, const KeepSamples& keep);

// Returns whether paths of one eye contribute to the other. With depth of field a hit has no single pixel in the other
// eye, and a shadow catcher has no radiance to share.
bool can_share(const StereoCamera& camera, const Scene& scene, const RenderOptions& options);

std::vector<Camera> cameras_of(std::span<const StereoCamera> path);

// Image position of a pixel's centre.
inline vec2 pixel_center(const RenderOptions& options, int x, int y) {
  return {(static_cast<float>(x) + 0.5f) / static_cast<float>(options.width),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(options.height)};
}

// The seed of a pixel's paths.
uint pixel_seed(const RenderOptions& options, int eye, int x, int y);

}  // namespace ods
