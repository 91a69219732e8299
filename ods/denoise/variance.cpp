// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The variance that a pixel is tested with.
#include <algorithm>
#include <cmath>

#include "ods/denoise/filter.h"
#include "ods/denoise/membership.h"

namespace ods {
namespace {

constexpr int kReach = 2;                // of both windows
constexpr int kMargin = 2 * kReach + 1;  // the cap's neighbours' neighbours
constexpr float kPureNormal = 0.1f;      // steps of features above which a pixel is an edge
constexpr float kPureAlbedo = 0.05f;
constexpr float kEdgeFactor = 3.0f;

// A grid of values over a block and its margin.
struct Grid {
  const Block& block;
  std::vector<float> values;
  explicit Grid(const Block& of)
      : block(of),
        values(static_cast<size_t>(of.stride()) * static_cast<size_t>(of.inside.bottom - of.inside.top + 2 * of.down)) {
  }
  float& at(int x, int y) {
    return values[static_cast<size_t>((y - block.inside.top + block.down) * block.stride() + x - block.inside.left +
                                      block.across)];
  }
};

float value_at(const Block& block, int plane, int x, int y) {
  return block.row(static_cast<Plane>(plane), y)[x - block.inside.left];
}

float distance(const Block& block, Plane first, int x, int y, int nx, int ny) {
  float sum = 0.0f;
  for (int c = 0; c < 3; c++) {
    const float d = value_at(block, first + c, x, y) - value_at(block, first + c, nx, ny);
    sum += d * d;
  }
  return sum;
}

// The factor from the variance of light without albedo to that of radiance.
float scale_at(const Block& block, int x, int y) {
  float sum = 0.0f;
  for (int c = 0; c < 3; c++) {
    const float by = value_at(block, kAlbedoR + c, x, y) + 0.05f;
    sum += by * by;
  }
  return sum * (1.0f / 3.0f);
}

bool is_edge(const Block& block, int x, int y) {
  const int steps[][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  for (const auto& [dx, dy] : steps) {
    if (value_at(block, kVariance, x + dx, y + dy) < 0.0f) continue;
    const float t = distance(block, kNormalX, x, y, x + dx, y + dy) / (kPureNormal * kPureNormal) +
                    distance(block, kAlbedoR, x, y, x + dx, y + dy) / (kPureAlbedo * kPureAlbedo);
    if (t >= 1.0f) return true;
  }
  return false;
}

// Mean of the radiance's channels.
float radiance_at(const Block& block, int x, int y) {
  float sum = 0.0f;
  for (int c = 0; c < 3; c++) {
    sum += value_at(block, kRed + c, x, y) * (value_at(block, kAlbedoR + c, x, y) + 0.05f);
  }
  return sum * (1.0f / 3.0f);
}

// The variance counts samples as independent. Those of a pixel are spread evenly, though, so where an edge crosses it,
// what they cover varies far less than that. The pixels beside the edge tell how noisy the light is. A pixel brighter
// than all but two neighbours is no mixture of them, but an outlier.
float edge_variance(const Block& block, Grid& pure, int x, int y) {
  const float own = value_at(block, kVariance, x, y);
  if (own <= 0.0f || pure.at(x, y) >= 0.0f) return own;
  float most = -1.0f;
  float brightest[3] = {};  // of the neighbours, in falling order
  for (int dy = -kReach; dy <= kReach; dy++) {
    for (int dx = -kReach; dx <= kReach; dx++) {
      if (dx == 0 && dy == 0) continue;
      most = std::max(most, pure.at(x + dx, y + dy));
      float radiance = radiance_at(block, x + dx, y + dy);
      for (float& each : brightest) {
        if (radiance > each) std::swap(radiance, each);
      }
    }
  }
  if (most < 0.0f) return own;
  const float of_radiance = kEdgeFactor * most;
  if (radiance_at(block, x, y) > brightest[2] + 2.0f * std::sqrt(of_radiance)) return own;
  return std::min(own, of_radiance / scale_at(block, x, y));
}

// At least the mean of the neighbourhood; an outlier keeps its own, and so finds neighbours who share its light.
float smooth_at(const Block& block, Grid& variance, int x, int y) {
  const float own = variance.at(x, y);
  float sum = 0.0f, weights = 0.0f;
  for (int dy = -kReach; dy <= kReach; dy++) {
    for (int dx = -kReach; dx <= kReach; dx++) {
      const float theirs = variance.at(x + dx, y + dy);
      if (theirs < 0.0f) continue;
      const float alike = feature_weight(distance(block, kNormalX, x, y, x + dx, y + dy),
                                         distance(block, kAlbedoR, x, y, x + dx, y + dy));
      const float weight = alike * std::exp(-static_cast<float>(dx * dx + dy * dy) / 2.2f);
      sum += weight * theirs, weights += weight;
    }
  }
  return weights > 0.0f ? std::max(own, sum / weights) : own;
}

}  // namespace

void smooth_variance(const NoisyPicture& noisy, std::vector<Level>& levels) {
  std::vector<std::vector<uint16_t>> smooth;
  for (const Level& level : levels) smooth.push_back(level.variance);
  for_each_block(noisy, [&](Block& block) {
    block.across = block.down = kMargin;
    load_block(noisy, levels, block);
    const Cell& inside = block.inside;
    Grid pure(block), variance(block);
    const auto fill = [&](Grid& grid, int around, const auto& value) {
      for (int y = inside.top - around; y < inside.bottom + around; y++) {
        for (int x = inside.left - around; x < inside.right + around; x++) grid.at(x, y) = value(x, y);
      }
    };
    fill(pure, 2 * kReach, [&](int x, int y) {
      const float own = value_at(block, kVariance, x, y);
      return own < 0.0f || is_edge(block, x, y) ? -1.0f : own * scale_at(block, x, y);
    });
    fill(variance, kReach, [&](int x, int y) { return edge_variance(block, pure, x, y); });
    for (int y = inside.top; y < inside.bottom; y++) {
      for (int x = inside.left; x < inside.right; x++) {
        const size_t pixel = noisy.index(x, y);
        const bool is_sky = is_bare_sky(noisy.eye(block.eye), pixel);
        smooth[static_cast<size_t>(block.eye)][pixel] = pack_variance(is_sky ? 0.0f : smooth_at(block, variance, x, y));
      }
    }
  });
  for (size_t i = 0; i < levels.size(); i++) levels[i].variance = std::move(smooth[i]);
}

}  // namespace ods
