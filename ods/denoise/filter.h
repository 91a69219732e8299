// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of the denoiser, block by block. Every pixel of a result depends only on the previous levels, so neither
// the order of the blocks nor the number of threads matters.
#pragma once
#include <cmath>
#include <deque>
#include <functional>

#include "ods/denoise/denoise.h"
#include "ods/denoise/membership.h"
#include "ods/denoise/other_view.h"

namespace ods {

// Calls `work` for blocks that together cover all eyes, from several threads. `inside` is set.
void for_each_block(const NoisyPicture& noisy, const std::function<void(Block& block)>& work);

size_t count_blocks(const NoisyPicture& noisy);

// With few samples, some pixels may miss all light: black pixels without variance that seem certain. Gives them the
// variance of similar pixels around them.
void doubt_darkness(const NoisyPicture& noisy, std::vector<Level>& levels);

// The effect of a pass on noise if it uses all of its candidates. Those of a wide pass share pixels.
struct PassNoise {
  float growth = 1.0f;  // variance of the result over the variance for independent candidates
  float detail = 0.0f;  // variance of the light that the pass removes, over the variance before it
};

struct FilterPass {
  int stride = 1;          // distance of the candidates in pixels; 5x5 of them
  float threshold = 1.0f;  // detail below this multiple of its noise is not restored
  PassNoise noise{};
};

// Sets `noise` of consecutive passes.
void expect_noise(std::span<FilterPass> passes);

inline float window_weight(int dx, int dy) {  // strides
  return std::exp(-static_cast<float>(dx * dx + dy * dy) / 4.5f);
}

// The distance of candidates in strides: towards the poles of a lat-long picture the columns are denser.
int stretch_of(const NoisyPicture& noisy, const FilterPass& pass, int y);

// Sets the margin of a block that a window of this reach needs, in strides.
void set_margin(const NoisyPicture& noisy, const FilterPass& pass, int reach, Block& block);

inline constexpr int kBlockWidth = 256;  // at most

// Pixels of a row, each paired with one of its neighbours.
struct RowPair {
  const float* own[kPlaneCount];
  const float* next[kPlaneCount];
};

RowPair pair_rows(const Block& block, int y, int dx, int dy);

// The squared distance between the three planes from `first` on.
inline float squared_distance(const RowPair& pair, Plane first, int x) {
  const float a = pair.own[first][x] - pair.next[first][x];
  const float b = pair.own[first + 1][x] - pair.next[first + 1][x];
  const float c = pair.own[first + 2][x] - pair.next[first + 2][x];
  return a * a + b * b + c * c;
}

// The similarity of two pixels of one owner by their normals and albedos.
inline float alike_features(const RowPair& pair, int x) {
  const float alike = feature_weight(squared_distance(pair, kNormalX, x), squared_distance(pair, kAlbedoR, x));
  return pair.own[kOwner][x] == pair.next[kOwner][x] ? alike : 0.0f;
}

// Another frame of the video. It must not be moved.
struct NoisyFrame {
  NoisyPicture noisy;
  std::vector<Level> levels;  // the first level of each eye
  const FrameBeside* beside = nullptr;
};

// Fills `to` with the mean of `from`, the other eye (if `both`) and the other frames for the same surface.
void merge_views(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to, bool both,
                 const std::deque<NoisyFrame>& beside, Block& block);

// Fills `to` with the mean of pixels of `from` with similar normals and albedos.
void filter_block(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to,
                  const FilterPass& pass, Block& block);

}  // namespace ods
