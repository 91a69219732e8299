// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/edges.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ods/denoise/filter.h"
#include "ods/denoise/membership.h"

namespace ods {
namespace {

constexpr int kEdgeReach = 2;
constexpr int kMaxNeighbours = (2 * kEdgeReach + 1) * (2 * kEdgeReach + 1) - 1;
constexpr int kTerms = 7;           // a constant, normal, albedo
constexpr int kFewest = 6;          // minimum number of pixels for a fit
constexpr float kRidge = 0.003f;    // relative to the features' squares
constexpr float kMinShare = 0.02f;  // weight of a pixel that is unlike all others
constexpr float kUnlikely = 4.0f;   // deviations: beyond this the fit contradicts the pixel, which shows a lamp

struct Neighbour {
  std::array<float, kTerms> terms;  // 1, then the features relative to the central pixel
  vec3 light;                       // radiance
  float weight;
};

struct Neighbourhood {
  Neighbour list[kMaxNeighbours];
  int count = 0;
  float weight = 0.0f;
  float squares = 0.0f;  // sum of the squared weights

  // The ratio of a fit's error to its residual, which is smaller because the terms adapt to the pixels: n / (n - terms)
  // for equal weights.
  float growth() const {
    const float pixels = weight * weight / squares;
    return pixels / std::max(pixels - static_cast<float>(kTerms), 1.0f);
  }
};

vec3 three(const Block& block, Plane first, int at, int y) {
  return {block.row(first, y)[at], block.row(static_cast<Plane>(first + 1), y)[at],
          block.row(static_cast<Plane>(first + 2), y)[at]};
}

vec3 divisor_at(const Block& block, int at, int y) {
  return divisor_of(three(block, kAlbedoR, at, y));
}

vec3 radiance_at(const Block& block, int at, int y) {
  return three(block, kRed, at, y) * divisor_at(block, at, y);
}

void look_around(const Block& block, int at, int y, Neighbourhood& around) {
  around.count = 0, around.weight = around.squares = 0.0f;
  const vec3 normal = three(block, kNormalX, at, y), albedo = three(block, kAlbedoR, at, y);
  for (int dy = -kEdgeReach; dy <= kEdgeReach; dy++) {
    for (int dx = -kEdgeReach; dx <= kEdgeReach; dx++) {
      if ((dx == 0 && dy == 0) || block.row(kVariance, y + dy)[at + dx] < 0.0f) continue;
      if (block.row(kOwner, y + dy)[at + dx] != block.row(kOwner, y)[at]) continue;
      Neighbour& one = around.list[around.count++];
      const vec3 dn = three(block, kNormalX, at + dx, y + dy) - normal;
      const vec3 da = three(block, kAlbedoR, at + dx, y + dy) - albedo;
      one.terms = {1.0f, dn.x, dn.y, dn.z, da.x, da.y, da.z};
      one.light = radiance_at(block, at + dx, y + dy);
      one.weight = window_weight(dx, dy) * (kMinShare + block.row(kShare, y + dy)[at + dx]);
      around.weight += one.weight, around.squares += one.weight * one.weight;
    }
  }
}

// Computes the fit's value at the centre, and the variance of its errors: the mean over the channels. Returns false if
// there is no fit.
bool fit(const Neighbourhood& around, vec3& middle, float& residual) {
  float matrix[kTerms][kTerms] = {};
  vec3 right[kTerms] = {};
  for (int n = 0; n < around.count; n++) {
    const Neighbour& one = around.list[n];
    for (size_t i = 0; i < kTerms; i++) {
      const float weighted = one.weight * one.terms[i];
      for (size_t j = i; j < kTerms; j++) matrix[i][j] += weighted * one.terms[j];
      right[i] += weighted * one.light;
    }
  }
  for (int i = 1; i < kTerms; i++) matrix[i][i] += kRidge * around.weight;
  // Elimination without pivoting: the matrix is symmetric and positive definite; only its upper half is used.
  for (int i = 0; i < kTerms; i++) {
    if (!(matrix[i][i] > 1e-12f)) return false;
    for (int j = i + 1; j < kTerms; j++) {
      const float factor = matrix[i][j] / matrix[i][i];
      for (int k = j; k < kTerms; k++) matrix[j][k] -= factor * matrix[i][k];
      right[j] -= factor * right[i];
    }
  }
  for (int i = kTerms - 1; i >= 0; i--) {
    for (int k = i + 1; k < kTerms; k++) right[i] -= matrix[i][k] * right[k];
    right[i] /= matrix[i][i];
  }
  vec3 squares(0.0f), low(1e30f), high(-1e30f);
  for (int n = 0; n < around.count; n++) {
    const Neighbour& one = around.list[n];
    vec3 off = one.light;
    for (size_t i = 0; i < kTerms; i++) off -= one.terms[i] * right[i];
    squares += one.weight * off * off;
    low = min(low, one.light), high = max(high, one.light);
  }
  middle = clamp(right[0], low, high);
  residual = around.growth() * (squares.x + squares.y + squares.z) / (3.0f * around.weight);
  return true;
}

}  // namespace

void fit_edges(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to) {
  for_each_block(noisy, [&](Block& block) {
    block.across = block.down = kEdgeReach;
    load_block(noisy, from, block);
    const Level& before = from[static_cast<size_t>(block.eye)];
    Level& after = to[static_cast<size_t>(block.eye)];
    Neighbourhood around;
    for (int y = block.inside.top; y < block.inside.bottom; y++) {
      for (int x = block.inside.left; x < block.inside.right; x++) {
        const int at = x - block.inside.left;
        const size_t pixel = noisy.index(x, y);
        vec3 light(before.light[3 * pixel], before.light[3 * pixel + 1], before.light[3 * pixel + 2]);
        const float variance = block.row(kVariance, y)[at];
        if (variance > 0.0f) {
          look_around(block, at, y, around);
          const vec3 by = divisor_at(block, at, y);
          const float own = variance * dot(by, by) / 3.0f;
          vec3 middle(0.0f);
          float residual = 0.0f;
          if (around.count >= kFewest && fit(around, middle, residual)) {
            const vec3 off = middle - light * by;
            const float share =
                own / (own + residual + 1e-30f) * light_weight(dot(off, off), kUnlikely * (own + residual));
            light += share * off / by;
          }
        }
        for (size_t c = 0; c < 3; c++) after.light[3 * pixel + c] = light[static_cast<int>(c)];
      }
    }
  });
}

}  // namespace ods
