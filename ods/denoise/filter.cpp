// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/filter.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ods/denoise/membership.h"

namespace ods {
namespace {

constexpr int kBlockHeight = 64;
constexpr int kRadius = 2;  // radius of a window, in strides
constexpr int kWindow = 2 * kRadius + 1;
constexpr int kMaxStretch = 8;  // maximum horizontal stretch of a window

// Sums for the pixels of a row in a block.
struct Sums {
  float weight[kBlockWidth];
  float light[3][kBlockWidth];
  float variance[kBlockWidth];  // weighted by the squared weights
  float share[kBlockWidth];     // fraction of the window's candidates that are used
};

// A pixel with unknown light starts with weight 0, and agrees with all others.
void begin_sums(const Block& block, int y, Sums& sums) {
  const float* variance = block.row(kVariance, y);
  for (int x = 0; x < block.inside.right - block.inside.left; x++) {
    const bool is_known = variance[x] >= 0.0f;
    sums.weight[x] = is_known ? 1.0f : 0.0f;
    sums.variance[x] = is_known ? variance[x] : 0.0f;
    for (int c = 0; c < 3; c++) sums.light[c][x] = block.row(static_cast<Plane>(kRed + c), y)[x];
  }
}

// 0 if the light differs by more than five deviations. A stricter test would leave noise beside the edges of shadows.
inline float alike_light(float distance, float own, float theirs) {
  return light_weight(distance, 4.0f * ((own >= 0.0f ? own : 1e30f) + theirs));
}

// Pixels of very different noise do not belong to the same light, for example at the silhouette of a lamp. They are not
// averaged, or the lamp would smear.
inline float alike_noise(float own, float theirs, bool is_wide, float alike) {
  // In the narrowest pass, a rare sample is distributed to its neighbours on the same surface; otherwise its light
  // would be lost.
  constexpr float kMaxRatio = 300.0f, kMaxRatioBeside = 3000.0f;
  if (theirs == 0.0f) return 1.0f;  // exact
  if (own < 0.0f) return 1.0f;
  const float square = alike * alike;
  return std::min((is_wide ? kMaxRatio : kMaxRatioBeside * square * square) * std::min(own, theirs) /
                      (std::max(own, theirs) + 1e-30f),
                  1.0f);
}

void add_neighbours(const RowPair& pair, int count, float share, bool is_wide, Sums& sums) {
  for (int x = 0; x < count; x++) {
    const float own = pair.own[kVariance][x], theirs = pair.next[kVariance][x];
    const float alike = alike_features(pair, x);
    const float noise = alike_noise(own, theirs, is_wide, alike);
    const float light = is_wide && theirs != 0.0f ? 1.0f : alike_light(squared_distance(pair, kRed, x), own, theirs);
    const float used = theirs >= 0.0f ? share * alike * light * noise : 0.0f;
    sums.weight[x] += used;
    sums.light[0][x] += used * pair.next[kRed][x];
    sums.light[1][x] += used * pair.next[kGreen][x];
    sums.light[2][x] += used * pair.next[kBlue][x];
    sums.variance[x] += used * used * theirs;
  }
}

// Candidates that share pixels of earlier passes count only once.
void finish_window(const Block& block, int y, const PassNoise& noise, Sums& sums) {
  float all = 0.0f;
  for (int i = 0; i < kWindow * kWindow; i++) all += window_weight(i % kWindow - kRadius, i / kWindow - kRadius);
  const float* before = block.row(kShare, y);
  for (int x = 0; x < block.inside.right - block.inside.left; x++) {
    sums.share[x] = std::clamp((sums.weight[x] - 1.0f) / (all - 1.0f), 0.0f, 1.0f);
    sums.variance[x] *= 1.0f + (noise.growth - 1.0f) * before[x] * sums.share[x];
  }
}

constexpr float kEyeWeight = 1.0f;  // both eyes get the same light
constexpr float kFrameWeight = 2.0f;

// Light of other views is used if it does not differ significantly: it may be a reflection.
void add_view(const NoisyPicture& noisy, const Block& block, const NoisyView& view, const ViewPlace& place, float share,
              int x, int y, Sums& sums) {
  const int at = x - block.inside.left;
  const float own = block.row(kVariance, y)[at];
  const EyeImage& eye = noisy.eye(block.eye);
  const vec3 normal = normal_at(eye, noisy.index(x, y)), albedo = albedo_at(eye, noisy.index(x, y));
  const auto plane = [&](int p) { return block.row(static_cast<Plane>(p), y)[at]; };
  const vec3 light(plane(kRed), plane(kGreen), plane(kBlue));
  const vec2 corner = floor(place.at - 0.5f);
  for (int i = 0; i < 4; i++) {
    const vec2 there = corner + vec2(static_cast<float>(i % 2), static_cast<float>(i / 2));
    const auto texel =
        neighbour_of(view.noisy, view.eye, place.cell, static_cast<int>(there.x), static_cast<int>(there.y));
    if (!texel) continue;
    const Level& level = view.levels[static_cast<size_t>(texel->source_eye)];
    const EyeImage& shown = view.noisy.eye(texel->source_eye);
    const size_t pixel = view.noisy.index(texel->x, texel->y);
    const float theirs = unpack_variance(level.variance[pixel]);
    const vec3 seen(level.light[3 * pixel], level.light[3 * pixel + 1], level.light[3 * pixel + 2]);
    if (theirs < 0.0f || !std::isfinite(seen.x + seen.y + seen.z)) continue;
    const vec3 dn = normal_at(shown, pixel) - normal, da = albedo_at(shown, pixel) - albedo;
    const vec2 near = 1.0f - abs(there + 0.5f - place.at);
    const float weight = share * near.x * near.y * feature_weight(dot(dn, dn), dot(da, da)) *
                         light_weight(dot(seen - light, seen - light), (own >= 0.0f ? own : 1e30f) + theirs);
    sums.weight[at] += weight;
    for (int c = 0; c < 3; c++) sums.light[c][at] += weight * seen[c];
    sums.variance[at] += weight * weight * theirs;
  }
}

// Returns whether a position in another frame is so close to the pixel that a candidate would be the same pixel.
bool stays(vec2 place, int x, int y) {
  const vec2 moved = abs(place - (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f));
  return std::max(moved.x, moved.y) < 2.0f;
}

void add_frame(const NoisyPicture& noisy, const NoisyFrame& frame, const Block& block, vec3 surface, int x, int y,
               Sums& sums) {
  const FrameBeside& beside = *frame.beside;
  if (!beside.places.empty()) surface = beside.places[static_cast<size_t>(block.eye)][noisy.index(x, y)];
  const NoisyView view{frame.noisy, frame.levels, block.eye};
  const auto place = place_in_view(view, surface);
  if (place && !(beside.same_noise && stays(place->at, x, y)))
    add_view(noisy, block, view, *place, kFrameWeight, x, y, sums);
}

// The eyes share paths, so half of the other eye's noise is this eye's and cannot be averaged out.
void share_noise(float own, Sums& sums, int at) {
  if (own >= 0.0f) sums.variance[at] = 0.5f * (sums.variance[at] + own * sums.weight[at] * sums.weight[at]);
}

// Adds the other eye and the other frames.
void add_views(const NoisyPicture& noisy, const std::vector<Level>& from, const Block& block, bool both,
               const std::deque<NoisyFrame>& beside, int y, Sums& sums) {
  for (int x = block.inside.left; x < block.inside.right; x++) {
    if (block.row(kVariance, y)[x - block.inside.left] == 0.0f) continue;
    const auto surface = surface_at(noisy, block.eye, x, y);
    if (!surface) continue;
    if (both) {
      const NoisyView view{noisy, from, 1 - block.eye};
      const auto place = place_in_view(view, *surface);
      if (place) add_view(noisy, block, view, *place, kEyeWeight, x, y, sums);
      share_noise(block.row(kVariance, y)[x - block.inside.left], sums, x - block.inside.left);
    }
    for (const NoisyFrame& frame : beside) add_frame(noisy, frame, block, *surface, x, y, sums);
  }
}

void store_row(const NoisyPicture& noisy, const Block& block, const std::vector<Level>& from, int y, const Sums& sums,
               std::vector<Level>& to) {
  const Level& before = from[static_cast<size_t>(block.eye)];
  Level& after = to[static_cast<size_t>(block.eye)];
  for (int x = block.inside.left; x < block.inside.right; x++) {
    const int at = x - block.inside.left;
    const size_t pixel = noisy.index(x, y);
    const float weight = sums.weight[at];
    // Light without variance is exact; light without similar neighbours is kept.
    const bool stays = weight == 0.0f || before.variance[pixel] == 0;
    for (size_t c = 0; c < 3; c++) {
      after.light[3 * pixel + c] = stays ? before.light[3 * pixel + c] : sums.light[c][at] / weight;
    }
    after.share[pixel] = static_cast<uint8_t>(std::lrint(255.0f * sums.share[at]));
    after.variance[pixel] = stays ? before.variance[pixel] : pack_variance(sums.variance[at] / (weight * weight));
  }
}

struct BlockPlace {
  int eye;
  Cell cell;
  Cell inside;
};

std::vector<BlockPlace> places_of_blocks(const NoisyPicture& noisy) {
  std::vector<BlockPlace> places;
  for (int eye = 0; eye < static_cast<int>(noisy.picture->eyes.size()); eye++) {
    for (const Cell& cell : noisy.cells) {
      for (int y = cell.top; y < cell.bottom; y += kBlockHeight) {
        for (int x = cell.left; x < cell.right; x += kBlockWidth) {
          const Cell inside{x, y, std::min(x + kBlockWidth, cell.right), std::min(y + kBlockHeight, cell.bottom)};
          places.push_back({eye, cell, inside});
        }
      }
    }
  }
  return places;
}

}  // namespace

size_t count_blocks(const NoisyPicture& noisy) {
  return places_of_blocks(noisy).size();
}

void for_each_block(const NoisyPicture& noisy, const std::function<void(Block& block)>& work) {
  const std::vector<BlockPlace> places = places_of_blocks(noisy);
  tbb::enumerable_thread_specific<Block> rooms;
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    Block& block = rooms.local();
    block.eye = places[i].eye, block.cell = places[i].cell, block.inside = places[i].inside;
    work(block);
  });
}

RowPair pair_rows(const Block& block, int y, int dx, int dy) {
  RowPair pair;
  for (int p = 0; p < kPlaneCount; p++) {
    pair.own[p] = block.row(static_cast<Plane>(p), y);
    pair.next[p] = block.row(static_cast<Plane>(p), y + dy) + dx;
  }
  return pair;
}

// Stretching by the square root of the ratio of column densities gives the smallest error, because closer pixels are
// more alike. Narrow windows are not stretched, or columns between the candidates would differ.
int stretch_of(const NoisyPicture& noisy, const FilterPass& pass, int y) {
  const Projection& projection = noisy.camera.projection;
  if (projection.kind != kLatLong || pass.stride < 4) return 1;
  const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(noisy.height());
  const float level = std::cos(projection.center.y + (0.5f - v) * projection.span.y);
  const float wide = 1.0f / std::sqrt(std::max(level, 1e-4f));
  return std::clamp(static_cast<int>(std::lround(wide)), 1, kMaxStretch);
}

void set_margin(const NoisyPicture& noisy, const FilterPass& pass, int reach, Block& block) {
  int widest = 1;
  for (int y = block.inside.top; y < block.inside.bottom; y++) widest = std::max(widest, stretch_of(noisy, pass, y));
  block.across = reach * pass.stride * widest;
  block.down = reach * pass.stride;
}

// Windows are products of a horizontal and a vertical one, so one dimension is computed and squared.
void expect_noise(std::span<FilterPass> passes) {
  float all = 0.0f, squares = 0.0f;
  for (int d = -kRadius; d <= kRadius; d++)
    all += window_weight(d, 0), squares += window_weight(d, 0) * window_weight(d, 0);
  std::vector<float> before = {1.0f};  // share of each pixel in the mean of a pixel
  const auto product = [](const std::vector<float>& a, const std::vector<float>& b) {
    float sum = 0.0f;
    for (size_t i = 0; i < a.size(); i++) sum += a[i] * b[i];
    return sum * sum;
  };
  for (FilterPass& pass : passes) {
    const size_t step = static_cast<size_t>(pass.stride), reach = kRadius * step;
    std::vector<float> after(before.size() + 2 * reach, 0.0f), same(after.size(), 0.0f);
    std::copy(before.begin(), before.end(), same.begin() + static_cast<ptrdiff_t>(reach));
    for (size_t i = 0; i < before.size(); i++) {
      for (size_t d = 0; d < kWindow; d++) {
        after[i + d * step] += before[i] * window_weight(static_cast<int>(d) - kRadius, 0) / all;
      }
    }
    const float was = product(same, same), is = product(after, after), alone = squares / (all * all);
    pass.noise.growth = is / (was * alone * alone);
    pass.noise.detail = (was + is - 2.0f * product(same, after)) / was;
    before = after;
  }
}

void merge_views(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to, bool both,
                 const std::deque<NoisyFrame>& beside, Block& block) {
  block.across = block.down = 0;
  load_block(noisy, from, block);
  Sums sums;
  for (int y = block.inside.top; y < block.inside.bottom; y++) {
    begin_sums(block, y, sums);
    std::fill_n(sums.share, kBlockWidth, 0.0f);
    add_views(noisy, from, block, both, beside, y, sums);
    store_row(noisy, block, from, y, sums, to);
  }
}

void filter_block(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to,
                  const FilterPass& pass, Block& block) {
  set_margin(noisy, pass, kRadius, block);
  load_block(noisy, from, block);
  Sums sums;
  for (int y = block.inside.top; y < block.inside.bottom; y++) {
    begin_sums(block, y, sums);
    const int stretch = stretch_of(noisy, pass, y);
    for (int dy = -kRadius; dy <= kRadius; dy++) {
      for (int dx = -kRadius; dx <= kRadius; dx++) {
        if (dx == 0 && dy == 0) continue;
        const RowPair pair = pair_rows(block, y, dx * pass.stride * stretch, dy * pass.stride);
        add_neighbours(pair, block.inside.right - block.inside.left, window_weight(dx, dy), pass.stride > 1, sums);
      }
    }
    finish_window(block, y, pass.noise, sums);
    store_row(noisy, block, from, y, sums, to);
  }
}

}  // namespace ods
