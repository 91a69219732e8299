// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/filter.h"

namespace ods {

constexpr int kAround = 2;

static float mean_around(const Block& block, int at, int y) {
  float sum = 0.0f, weights = 0.0f;
  for (int dy = -kAround; dy <= kAround; dy++) {
    for (int dx = -kAround; dx <= kAround; dx++) {
      const RowPair pair = pair_rows(block, y, dx, dy);
      const float theirs = pair.next[kVariance][at];
      if (theirs < 0.0f) continue;
      const float weight = alike_features(pair, at) * window_weight(dx, dy);
      sum += weight * theirs, weights += weight;
    }
  }
  return weights > 0.0f ? sum / weights : 0.0f;
}

void doubt_darkness(const NoisyPicture& noisy, std::vector<Level>& levels) {
  std::vector<std::vector<uint16_t>> doubted;
  for (const Level& level : levels) doubted.push_back(level.variance);
  for_each_block(noisy, [&](Block& block) {
    block.across = block.down = kAround;
    load_block(noisy, levels, block);
    for (int y = block.inside.top; y < block.inside.bottom; y++) {
      for (int x = block.inside.left; x < block.inside.right; x++) {
        const int at = x - block.inside.left;
        const size_t pixel = noisy.index(x, y);
        const bool is_dark = block.row(kRed, y)[at] + block.row(kGreen, y)[at] + block.row(kBlue, y)[at] == 0.0f;
        if (!is_dark || block.row(kVariance, y)[at] != 0.0f || is_bare_sky(noisy.eye(block.eye), pixel)) continue;
        doubted[static_cast<size_t>(block.eye)][pixel] = pack_variance(mean_around(block, at, y));
      }
    }
  });
  for (size_t i = 0; i < levels.size(); i++) levels[i].variance = std::move(doubted[i]);
}

}  // namespace ods
