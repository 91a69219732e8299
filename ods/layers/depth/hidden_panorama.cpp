// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/hidden_panorama.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "ods/kernel/camera/project.h"

namespace ods {

namespace {

constexpr float kUnder = 2.0f;     // texels by which hidden surfaces continue beyond what eyes see of them
constexpr float kBehind = 0.995f;  // of the nearness: hidden surfaces do not come through those in front of them
constexpr int kSides[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

struct Spread {
  DepthPanorama hidden;
  std::vector<float> left;     // texels that the surface still continues; by texel
  std::vector<size_t> border;  // texels that were set last
};

// The four inner texels beside one: right, below, left, above.
std::array<size_t, 4> sides_of(const PageGrid& grid, size_t texel) {
  const auto [page, x, y] = texel_at(grid, texel);
  std::array<size_t, 4> sides;
  for (size_t i = 0; i < 4; i++) sides[i] = inner_texel(grid, page, vec2(x + kSides[i][0], y + kSides[i][1]) + 0.5f);
  return sides;
}

// The front's values at the texels of a grid.
DepthPanorama reduced(const DepthPanorama& front, const PageGrid& grid) {
  DepthPanorama small = empty_panorama(grid);
  tbb::parallel_for(size_t{0}, texel_count(grid), [&](size_t texel) {
    const size_t from = texel_towards(front.grid, ray_of(grid, texel_at(grid, texel)));
    small.colors[texel] = front.colors[from];
    small.nearness[texel] = front.nearness[from];
  });
  return small;
}

// Starts at the edges: on the far side, with what an eye may see behind the near one.
Spread start(const DepthPanorama& front, float reach) {
  const PageGrid& grid = front.grid;
  const float pixel = grid.pixel();
  Spread spread{empty_panorama(grid), std::vector<float>(front.nearness.size()), {}};
  for_each_inner_texel(grid, [&](PageTexel at) {
    const size_t far = index_of(grid, at);
    const float behind = front.nearness[far];
    if (!(behind > 0.0f)) return;
    const std::array<size_t, 4> sides = sides_of(grid, far);
    float seen = 0.0f;
    for (size_t i = 0; i < 4; i++) {
      const float before = front.nearness[sides[i]];
      const float opposite = front.nearness[sides[(i + 2) % 4]];
      const float beyond = front.nearness[sides_of(grid, sides[i])[i]];
      if (before <= behind || continues(opposite, behind, before, beyond, reach, pixel)) continue;
      seen = std::max(seen, reach * (before - behind) / pixel);
    }
    if (seen <= 0.0f) return;
    spread.hidden.nearness[far] = kBehind * behind;
    spread.hidden.colors[far] = front.colors[far];
    spread.left[far] = seen + kUnder;
    spread.border.push_back(far);
  });
  return spread;
}

// Continues all surfaces by a texel. Returns false if none did.
bool spread_once(const DepthPanorama& front, float reach, Spread& spread) {
  const PageGrid& grid = front.grid;
  std::vector<size_t> reached;
  for (const size_t texel : spread.border) {
    if (spread.left[texel] < 1.0f) continue;
    for (const size_t next : sides_of(grid, texel)) {
      const float behind = spread.hidden.nearness[texel];
      const bool is_hidden =
          front.nearness[next] > behind && !shows_one_surface(front.nearness[next], behind, reach, grid.pixel());
      if (is_hidden && spread.hidden.nearness[next] == kNothing) reached.push_back(next);
    }
  }
  std::ranges::sort(reached);
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  struct Value {
    vec3 color;
    float nearness, left;
  };
  std::vector<Value> values;
  for (const size_t texel : reached) {
    Value value{vec3(0.0f), 0.0f, 0.0f};
    float count = 0.0f;
    for (const size_t from : sides_of(grid, texel)) {
      if (spread.hidden.nearness[from] == kNothing || spread.left[from] < 1.0f) continue;
      value.color += spread.hidden.colors[from];
      value.nearness += spread.hidden.nearness[from];
      value.left = std::max(value.left, spread.left[from] - 1.0f);
      count += 1.0f;
    }
    values.push_back({value.color / count, value.nearness / count, value.left});
  }
  for (size_t i = 0; i < reached.size(); i++) {
    spread.hidden.colors[reached[i]] = values[i].color;
    spread.hidden.nearness[reached[i]] = values[i].nearness;
    spread.left[reached[i]] = values[i].left;
  }
  spread.border = std::move(reached);
  return !spread.border.empty();
}

// Replaces the colours of points that one of the eyes shows.
void look_with_eyes(const Reprojection& picture, DepthPanorama& hidden) {
  const Source& source = *picture.source;
  const StoredPicture& stored = *source.picture;
  if (stored.eyes.size() < 2) return;
  const Resampler resampler(source);
  const vec2 size(static_cast<float>(stored.size.width), static_cast<float>(stored.size.height));
  tbb::parallel_for(size_t{0}, hidden.nearness.size(), [&](size_t texel) {
    if (!(hidden.nearness[texel] > 0.0f)) return;
    const vec3 direction = ray_of(hidden.grid, texel_at(hidden.grid, texel));
    std::vector<float> values(static_cast<size_t>(resampler.channels()));
    for (int eye = 0; eye < 2; eye++) {
      const ImagePosition at =
          project_point(source.camera, stored.eyes[static_cast<size_t>(eye)].eye, direction / hidden.nearness[texel]);
      if (!at.seen) continue;
      const Place place{eye, at.uv * size, true};
      if (!shows_only(picture, place, 1.0f / at.depth)) continue;
      hidden.colors[texel] = color_at(source, resampler, place, values);
      return;
    }
  });
}

// Sets the gutters to what is beyond the pages' edges.
void fill_gutters(DepthPanorama& panorama) {
  for (size_t texel = 0; texel < texel_count(panorama.grid); texel++) {
    const auto [page, x, y] = texel_at(panorama.grid, texel);
    const size_t inner = inner_texel(panorama.grid, page, vec2(x, y) + 0.5f);
    panorama.colors[texel] = panorama.colors[inner];
    panorama.nearness[texel] = panorama.nearness[inner];
  }
}

}  // namespace

DepthPanorama hidden_panorama(const Reprojection& picture, const DepthPanorama& front, const PageGrid& grid,
                              float reach) {
  const DepthPanorama small = reduced(front, grid);
  Spread spread = start(small, reach);
  while (spread_once(small, reach, spread)) {
  }
  look_with_eyes(picture, spread.hidden);
  fill_gutters(spread.hidden);
  return std::move(spread.hidden);
}

}  // namespace ods
