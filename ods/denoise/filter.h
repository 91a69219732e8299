// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of the denoiser, block by block. Every pixel of a result depends on the levels before it alone, so neither
// the order of the blocks nor the number of threads matters.
#pragma once
#include <cmath>
#include <deque>
#include <functional>

#include "ods/denoise/denoise.h"
#include "ods/denoise/other_view.h"

namespace ods {

// Calls `work` for blocks that together are all eyes, from several threads. `inside` is set.
void for_each_block(const NoisyPicture& noisy, const std::function<void(Block& block)>& work);

size_t count_blocks(const NoisyPicture& noisy);

// Few samples may miss all light, and black pixels without variance seem certain. They become as uncertain as those
// around them that resemble them.
void doubt_darkness(const NoisyPicture& noisy, std::vector<Level>& levels);

// What a pass makes of noise if it takes all of its candidates. Those of a wide pass share pixels.
struct PassNoise {
  float growth = 1.0f;  // of the result's variance, over that of independent candidates
  float detail = 0.0f;  // variance of what the pass takes away, over that before it
};

struct FilterPass {
  int stride = 1;          // pixels from one candidate to the next; 5x5 of them
  float threshold = 1.0f;  // detail that is not so many times its noise does not come back
  PassNoise noise{};
};

// Sets `noise` of the passes that follow each other.
void expect_noise(std::span<FilterPass> passes);

inline float window_weight(int dx, int dy) {  // strides
  return std::exp(-static_cast<float>(dx * dx + dy * dy) / 4.5f);
}

// Towards the poles of a lat-long picture the columns are denser: candidates are so many strides apart.
int stretch_of(const NoisyPicture& noisy, const FilterPass& pass, int y);

// Sets the margin of a block that a window of this reach needs, in strides.
void set_margin(const NoisyPicture& noisy, const FilterPass& pass, int reach, Block& block);

inline constexpr int kBlockWidth = 256;  // at most

// A row's pixels and one of their neighbours each.
struct RowPair {
  const float* own[kPlaneCount];
  const float* next[kPlaneCount];
};

RowPair pair_rows(const Block& block, int y, int dx, int dy);

// Between the three planes from `first` on.
inline float squared_distance(const RowPair& pair, Plane first, int x) {
  const float a = pair.own[first][x] - pair.next[first][x];
  const float b = pair.own[first + 1][x] - pair.next[first + 1][x];
  const float c = pair.own[first + 2][x] - pair.next[first + 2][x];
  return a * a + b * b + c * c;
}

// A frame beside the one that is filtered. Not to be moved.
struct NoisyFrame {
  NoisyPicture noisy;
  std::vector<Level> levels;  // by eye: the first
  const FrameBeside* beside = nullptr;
};

// Fills `to` with means of what `from`, the other eye (both) and the frames beside this one show of the same surface.
void merge_views(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to, bool both,
                 const std::deque<NoisyFrame>& beside, Block& block);

// Fills `to` with means of pixels of `from` with similar normals and albedos.
void filter_block(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to,
                  const FilterPass& pass, Block& block);

}  // namespace ods
