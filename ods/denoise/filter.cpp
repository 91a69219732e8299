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

constexpr int kBlockWidth = 256;
constexpr int kBlockHeight = 64;
constexpr int kRadius = 2;       // of a window, in strides
constexpr int kMostStretch = 8;  // of a window sideways

// A row's pixels and one of their neighbours each.
struct RowPair {
  const float* own[kPlaneCount];
  const float* next[kPlaneCount];
};

RowPair pair_rows(const Block& block, int y, int dx, int dy) {
  RowPair pair;
  for (int p = 0; p < kPlaneCount; p++) {
    pair.own[p] = block.row(static_cast<Plane>(p), y);
    pair.next[p] = block.row(static_cast<Plane>(p), y + dy) + dx;
  }
  return pair;
}

inline float squared_distance(const RowPair& pair, Plane first, int x) {
  const float a = pair.own[first][x] - pair.next[first][x];
  const float b = pair.own[first + 1][x] - pair.next[first + 1][x];
  const float c = pair.own[first + 2][x] - pair.next[first + 2][x];
  return a * a + b * b + c * c;
}

// Of the pixels of a row of a block.
struct Sums {
  float weight[kBlockWidth];
  float light[3][kBlockWidth];
  float variance[kBlockWidth];  // with the squares of the weights
};

// A pixel of unknown light begins with nothing, and agrees with everybody.
void begin_sums(const Block& block, int y, Sums& sums) {
  const float* variance = block.row(kVariance, y);
  for (int x = 0; x < block.inside.right - block.inside.left; x++) {
    const bool is_known = variance[x] >= 0.0f;
    sums.weight[x] = is_known ? 1.0f : 0.0f;
    sums.variance[x] = is_known ? variance[x] : 0.0f;
    for (int c = 0; c < 3; c++) sums.light[c][x] = block.row(static_cast<Plane>(kRed + c), y)[x];
  }
}

// What is still far noisier than the other after the narrowest pass is no sample of the same light: the silhouette of a
// lamp, of which nobody knows how much a pixel shows. Neither takes from the other, or wide windows would repeat it.
inline float alike_noise(float own, float theirs) {
  constexpr float kMostRatio = 1e4f;
  return std::min(kMostRatio * std::min(own, theirs) / (std::max(own, theirs) + 1e-30f), 1.0f);
}

void add_neighbours(const RowPair& pair, int count, float share, bool is_wide, Sums& sums) {
  for (int x = 0; x < count; x++) {
    const float own = pair.own[kVariance][x], theirs = pair.next[kVariance][x];
    const float variance = (own >= 0.0f ? own : 1e30f) + theirs;
    const float alike = feature_weight(squared_distance(pair, kNormalX, x), squared_distance(pair, kAlbedoR, x));
    const float weight = share * alike * light_weight(squared_distance(pair, kRed, x), variance);
    const float gate = is_wide && own >= 0.0f ? alike_noise(own, theirs) : 1.0f;
    const float used = theirs >= 0.0f ? weight * gate : 0.0f;
    sums.weight[x] += used;
    sums.light[0][x] += used * pair.next[kRed][x];
    sums.light[1][x] += used * pair.next[kGreen][x];
    sums.light[2][x] += used * pair.next[kBlue][x];
    sums.variance[x] += used * used * theirs;
  }
}

// A pixel that resembles no other, at the edge of a thing, turns to those beside it: else an outlier there would stay.
void add_beside(const Block& block, int y, Sums& sums) {
  constexpr float kAlone = 0.25f;  // weight of all neighbours below which a pixel is alone
  for (int x = 0; x < block.inside.right - block.inside.left; x++) {
    const float own = block.row(kVariance, y)[x];
    if (!(own > 0.0f) || sums.weight[x] > 1.0f + kAlone) continue;
    for (int i = 0; i < 9; i++) {
      const RowPair pair = pair_rows(block, y, i % 3 - 1, i / 3 - 1);
      const float theirs = pair.next[kVariance][x];
      if (i == 4 || theirs < 0.0f) continue;
      const float weight = 0.5f * light_weight(squared_distance(pair, kRed, x), own + theirs);
      sums.weight[x] += weight;
      for (int c = 0; c < 3; c++) sums.light[c][x] += weight * pair.next[kRed + c][x];
      sums.variance[x] += weight * weight * theirs;
    }
  }
}

// The nine pixels around the place where another view shows the same.
void add_view(const NoisyPicture& noisy, const Block& block, const NoisyView& view, const ViewPlace& place, float share,
              int x, int y, Sums& sums) {
  const int at = x - block.inside.left;
  const float own = block.row(kVariance, y)[at];
  const EyeImage& eye = noisy.eye(block.eye);
  const vec3 normal = normal_at(eye, noisy.index(x, y)), albedo = albedo_at(eye, noisy.index(x, y));
  const auto plane = [&](int p) { return block.row(static_cast<Plane>(p), y)[at]; };
  const vec3 light(plane(kRed), plane(kGreen), plane(kBlue));
  const vec2 middle = floor(place.at) + 0.5f;
  for (int i = 0; i < 9; i++) {
    const vec2 there = middle + vec2(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 - 1));
    const auto texel = neighbour_of(view.noisy, view.eye, place.cell, static_cast<int>(std::floor(there.x)),
                                    static_cast<int>(std::floor(there.y)));
    if (!texel) continue;
    const Level& level = view.levels[static_cast<size_t>(texel->source_eye)];
    const EyeImage& shown = view.noisy.eye(texel->source_eye);
    const size_t pixel = view.noisy.index(texel->x, texel->y);
    const float theirs = unpack_variance(level.variance[pixel]);
    const vec3 seen(level.light[3 * pixel], level.light[3 * pixel + 1], level.light[3 * pixel + 2]);
    if (theirs < 0.0f || !std::isfinite(seen.x + seen.y + seen.z)) continue;
    const vec3 dn = normal_at(shown, pixel) - normal, da = albedo_at(shown, pixel) - albedo;
    const vec2 off = there - place.at;
    const float weight = share * taper(dot(off, off) / 6.0f) * feature_weight(dot(dn, dn), dot(da, da)) *
                         light_weight(dot(seen - light, seen - light), (own >= 0.0f ? own : 1e30f) + theirs);
    sums.weight[at] += weight;
    for (int c = 0; c < 3; c++) sums.light[c][at] += weight * seen[c];
    sums.variance[at] += weight * weight * theirs;
  }
}

// Whether a place in another frame is so near to the same pixel that a candidate would be that pixel.
bool stays(vec2 place, int x, int y) {
  const vec2 moved = abs(place - (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f));
  return std::max(moved.x, moved.y) < 2.0f;
}

void add_frame(const NoisyPicture& noisy, const NoisyFrame& frame, const Block& block, float share, vec3 surface, int x,
               int y, Sums& sums) {
  const FrameBeside& beside = *frame.beside;
  if (!beside.places.empty()) surface = beside.places[static_cast<size_t>(block.eye)][noisy.index(x, y)];
  const NoisyView view{frame.noisy, frame.levels, block.eye};
  const auto place = place_in_view(view, surface);
  if (place && !(beside.same_noise && stays(place->at, x, y))) add_view(noisy, block, view, *place, share, x, y, sums);
}

// The other eye, and the frames beside this one.
void add_views(const NoisyPicture& noisy, const std::vector<Level>& from, const Block& block, FilterPass pass,
               const std::deque<NoisyFrame>& beside, int y, Sums& sums) {
  if (pass.other_eye == 0.0f && (pass.other_frame == 0.0f || beside.empty())) return;
  for (int x = block.inside.left; x < block.inside.right; x++) {
    if (block.row(kVariance, y)[x - block.inside.left] == 0.0f) continue;
    const auto surface = surface_at(noisy, block.eye, x, y);
    if (!surface) continue;
    if (pass.other_eye > 0.0f) {
      const NoisyView view{noisy, from, 1 - block.eye};
      const auto place = place_in_view(view, *surface);
      if (place) add_view(noisy, block, view, *place, pass.other_eye, x, y, sums);
    }
    if (pass.other_frame == 0.0f) continue;
    for (const NoisyFrame& frame : beside) add_frame(noisy, frame, block, pass.other_frame, *surface, x, y, sums);
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
    // Light without variance is exact, and light without like neighbours stays.
    const bool stays = weight == 0.0f || before.variance[pixel] == 0;
    for (size_t c = 0; c < 3; c++) {
      after.light[3 * pixel + c] = stays ? before.light[3 * pixel + c] : sums.light[c][at] / weight;
    }
    after.variance[pixel] = stays ? before.variance[pixel] : pack_variance(sums.variance[at] / (weight * weight));
  }
}

// Towards the poles of a lat-long picture the columns are denser. The square root of it serves the error best: what is
// near in the picture is more alike. Narrow windows are not stretched, or columns between the candidates would differ.
int stretch_of(const NoisyPicture& noisy, FilterPass pass, int y) {
  const Projection& projection = noisy.camera.projection;
  if (projection.kind != kLatLong || pass.stride < 4) return 1;
  const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(noisy.height());
  const float level = std::cos(projection.center.y + (0.5f - v) * projection.span.y);
  const float wide = 1.0f / std::sqrt(std::max(level, 1e-4f));
  return std::clamp(static_cast<int>(std::lround(wide)), 1, kMostStretch);
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

void filter_block(const NoisyPicture& noisy, const std::vector<Level>& from, std::vector<Level>& to, FilterPass pass,
                  const std::deque<NoisyFrame>& beside, Block& block) {
  int widest = 1;
  for (int y = block.inside.top; y < block.inside.bottom; y++) widest = std::max(widest, stretch_of(noisy, pass, y));
  block.across = kRadius * pass.stride * widest;
  block.down = kRadius * pass.stride;
  load_block(noisy, from, block);
  Sums sums;
  for (int y = block.inside.top; y < block.inside.bottom; y++) {
    begin_sums(block, y, sums);
    const int stretch = stretch_of(noisy, pass, y);
    for (int dy = -kRadius; dy <= kRadius; dy++) {
      for (int dx = -kRadius; dx <= kRadius; dx++) {
        if (dx == 0 && dy == 0) continue;
        const float share = std::exp(-static_cast<float>(dx * dx + dy * dy) / 4.5f);
        const RowPair pair = pair_rows(block, y, dx * pass.stride * stretch, dy * pass.stride);
        add_neighbours(pair, block.inside.right - block.inside.left, share, pass.stride > 1, sums);
      }
    }
    if (pass.stride == 1) add_beside(block, y, sums);
    add_views(noisy, from, block, pass, beside, y, sums);
    store_row(noisy, block, from, y, sums, to);
  }
}

}  // namespace ods
