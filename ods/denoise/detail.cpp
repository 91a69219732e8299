// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/detail.h"

#include <algorithm>

namespace ods {
namespace {

constexpr int kReach = 2;  // radius of the window, in strides

// Sums over the windows of a row's pixels in a block.
struct DetailSums {
  float found[kBlockWidth];     // squares of the light that the pass removed
  float variance[kBlockWidth];  // three times the variance, scaled by the share of candidates that the pass used
};

void add_window(const RowPair& pair, const float* took, const float* share, float weight, int count, DetailSums& sums) {
  for (int x = 0; x < count; x++) {
    const float theirs = pair.next[kVariance][x];
    const float used = theirs >= 0.0f ? weight * alike_features(pair, x) : 0.0f;
    sums.found[x] += used * took[x];
    sums.variance[x] += used * 3.0f * theirs * share[x];
  }
}

// A single pixel that stands out from its window is a rare sample, unless it does so by four of its deviations.
void begin_window(const RowPair& pair, const float* took, const float* share, float detail, int count,
                  DetailSums& sums) {
  for (int x = 0; x < count; x++) {
    sums.variance[x] = 3.0f * std::max(pair.own[kVariance][x], 0.0f) * share[x];
    sums.found[x] = took[x] > 16.0f * detail * sums.variance[x] ? took[x] : 0.0f;
  }
}

// Squares of the light that the pass removed, summed over the channels.
void take_squares(const Block& before, const Block& after, std::vector<float>& squares) {
  squares.assign(before.planes[kRed].size(), 0.0f);
  for (const Plane plane : {kRed, kGreen, kBlue}) {
    const float *a = before.planes[plane].data(), *b = after.planes[plane].data();
    for (size_t i = 0; i < squares.size(); i++) squares[i] += (a[i] - b[i]) * (a[i] - b[i]);
  }
}

}  // namespace

void add_detail(const NoisyPicture& noisy, const std::vector<Level>& before, const std::vector<Level>& after,
                const FilterPass& pass, std::vector<float>& light, Block& block) {
  static thread_local Block smooth;
  static thread_local std::vector<float> squares;
  set_margin(noisy, pass, kReach, block);
  smooth.eye = block.eye, smooth.cell = block.cell, smooth.inside = block.inside;
  smooth.across = block.across, smooth.down = block.down;
  load_block(noisy, before, block);
  load_block(noisy, after, smooth, false);
  take_squares(block, smooth, squares);
  const int count = block.inside.right - block.inside.left;
  DetailSums sums;
  for (int y = block.inside.top; y < block.inside.bottom; y++) {
    const int stride_across = pass.stride * stretch_of(noisy, pass, y);
    begin_window(pair_rows(block, y, 0, 0), squares.data() + block.offset(y), smooth.row(kShare, y), pass.noise.detail,
                 count, sums);
    for (int dy = -kReach; dy <= kReach; dy++) {
      for (int dx = -kReach; dx <= kReach; dx++) {
        if (dx == 0 && dy == 0) continue;
        const int across = dx * stride_across, down = dy * pass.stride;
        const float* took = squares.data() + block.offset(y + down) + across;
        add_window(pair_rows(block, y, across, down), took, smooth.row(kShare, y + down) + across,
                   window_weight(dx, dy), count, sums);
      }
    }
    for (int x = 0; x < count; x++) {
      if (block.row(kVariance, y)[x] < 0.0f) continue;
      const float noise = pass.noise.detail * sums.variance[x];
      const float kept = std::max(1.0f - pass.threshold * noise / (sums.found[x] + 1e-30f), 0.0f);
      const size_t pixel = noisy.index(block.inside.left + x, y);
      for (size_t c = 0; c < 3; c++) {
        const Plane plane = static_cast<Plane>(kRed + c);
        light[3 * pixel + c] += kept * (block.row(plane, y)[x] - smooth.row(plane, y)[x]);
      }
    }
  }
}

}  // namespace ods
