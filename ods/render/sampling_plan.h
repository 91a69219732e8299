// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Determines how many samples each block of pixels gets.
//
// A pixel near the poles of a lat-long picture covers little of the sphere. It gets fewer samples, in proportion, so
// that noise per solid angle is even. In addition, blocks that are clean enough stop (RenderOptions::noise).
//
// A pixel does not decide when it stops itself, because that would favour values that look clean. Pixels are in two
// classes, like the squares of a chessboard: each class of a block stops when the other class is clean.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "ods/camera/stereo_camera.h"
#include "ods/render/picture_samples.h"

namespace ods {

inline constexpr int kBlockSize = 8;  // pixels

inline int class_of(int x, int y) {
  return (x + y) & 1;
}

// Blocks in reading order.
int block_columns(const RenderOptions& options);
size_t block_count(const RenderOptions& options);

struct SamplingPlan {
  int columns = 0;           // blocks across
  std::vector<float> share;  // per block: fraction of the samples of the pixels with the largest solid angle, 0..1
  std::shared_ptr<const TexelRays> texels{};  // the camera's, whose pixels have equal shares; empty ones do not count
};

// Precondition: options.height > 0.
SamplingPlan make_plan(const StereoCamera& camera, const RenderOptions& options);

size_t block_at(const SamplingPlan& plan, int x, int y);

// The number of samples that a pixel of this block takes out of the first `samples`.
int samples_of(const SamplingPlan& plan, size_t block, int samples);

// Updates the blocks that are still noisier than options.noise; if the exposure differs from that of the last call,
// blocks that have stopped are judged again, too. Returns how many more samples the picture may need, as a multiple of
// its present samples: noise decreases with the square root of their number. Preconditions: options.noise > 0, and no
// pass has begun.
double judge_noise(const SamplingPlan& plan, const RenderOptions& options, PictureSamples& samples);

}  // namespace ods
