// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of the denoiser, block by block. Every pixel of a result depends on the levels before it alone, so neither
// the order of the blocks nor the number of threads matters.
#pragma once
#include <deque>
#include <functional>

#include "ods/denoise/denoise.h"
#include "ods/denoise/other_view.h"

namespace ods {

// Calls `work` for blocks that together are all eyes, from several threads. `inside` is set.
void for_each_block(const NoisyPicture& noisy, const std::function<void(Block& block)>& work);

size_t count_blocks(const NoisyPicture& noisy);

// Replaces the first level's variances, which few samples estimate badly, by what they are with those of the
// neighbourhood.
void smooth_variance(const NoisyPicture& noisy, std::vector<Level>& levels);

struct FilterPass {
  int stride = 1;            // pixels from one candidate to the next; 5x5 of them
  float other_eye = 0.0f;    // weight of the nine pixels that show the same in the other eye; 0: left out
  float other_frame = 0.0f;  // and in each frame beside this one
};

// A frame beside the one that is filtered. Not to be moved.
struct NoisyFrame {
  NoisyPicture noisy;
  std::vector<Level> levels;  // by eye: the first, with smooth variance
  const FrameBeside* beside = nullptr;
};

// Fills `to` from `from`. Throws nothing.
void filter_block(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to, FilterPass pass,
                  const std::deque<NoisyFrame>& beside, Block& block);

}  // namespace ods
