// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/depth_panorama.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace ods {

namespace {

constexpr float kSameDepth = 0.02f;  // relative difference of adjacent texels, at most, that is never cut
constexpr float kOffSlope = 0.75f;   // of a difference between texels: how far a slope may miss
constexpr int kEdgeReach = 4;        // texels from the edge of a surface to colours without another one's

bool is_texel_of_surface(float nearness) {
  return nearness > 0.0f;
}

// Finds the texels at the edges of surfaces.
class Edges {
 public:
  Edges(const DepthPanorama& panorama, float reach) : panorama_(panorama), reach_(reach) {}

  // Returns whether any texel beside this one belongs to another surface.
  bool has(int page, int x, int y) const {
    for (int dy = -1; dy <= 1; dy++) {
      for (int dx = -1; dx <= 1; dx++) {
        if (!is_same(page, x, y, dx, dy)) return true;
      }
    }
    return false;
  }

  // Returns whether a texel and another one, a few texels beside it, are of one surface.
  bool is_same(int page, int x, int y, int dx, int dy) const {
    const float from = at(page, x, y), to = at(page, x + dx, y + dy);
    if (from <= 0.0f || to <= 0.0f) return from == to;
    return continues(at(page, x - dx, y - dy), from, to, at(page, x + 2 * dx, y + 2 * dy), reach_,
                     panorama_.grid.pixel());
  }

 private:
  float at(int page, int x, int y) const {
    const int last = panorama_.grid.size() - 1;
    return panorama_.nearness[index_of(panorama_.grid, {page, std::clamp(x, 0, last), std::clamp(y, 0, last)})];
  }

  const DepthPanorama& panorama_;
  float reach_;
};

// The colour of the nearest texels of the same surface that are not mixed with another one; its own if there are none.
vec3 inside_color(const DepthPanorama& panorama, const Edges& edges, const std::vector<char>& mixed, int page, int x,
                  int y) {
  const int last = panorama.grid.size() - 1;
  for (int reach = 1; reach <= kEdgeReach; reach++) {
    vec3 sum(0.0f);
    int count = 0;
    for (int row = std::max(y - reach, 0); row <= std::min(y + reach, last); row++) {
      for (int column = std::max(x - reach, 0); column <= std::min(x + reach, last); column++) {
        const size_t other = index_of(panorama.grid, {page, column, row});
        if (mixed[other] || !edges.is_same(page, x, y, column - x, row - y)) continue;
        sum += panorama.colors[other];
        count++;
      }
    }
    if (count > 0) return sum / static_cast<float>(count);
  }
  return panorama.colors[index_of(panorama.grid, {page, x, y})];
}

void clean_edges(DepthPanorama& panorama, float reach, std::vector<char> mixed) {
  const Edges edges(panorama, reach);
  const int size = panorama.grid.size(), rows = panorama.grid.pages() * size;
  const auto for_each = [&](const auto& visit) {
    tbb::parallel_for(0, rows, [&](int row) {
      for (int x = 0; x < size; x++) visit(row / size, x, row % size);
    });
  };
  for_each([&](int page, int x, int y) {
    if (edges.has(page, x, y)) mixed[index_of(panorama.grid, {page, x, y})] = 1;
  });
  std::vector<vec3> clean = panorama.colors;
  for_each([&](int page, int x, int y) {
    const size_t texel = index_of(panorama.grid, {page, x, y});
    if (mixed[texel]) clean[texel] = inside_color(panorama, edges, mixed, page, x, y);
  });
  panorama.colors = std::move(clean);
}

}  // namespace

DepthPanorama empty_panorama(const PageGrid& grid) {
  const size_t texels = texel_count(grid);
  return {grid, std::vector<vec3>(texels, vec3(0.0f)), std::vector<float>(texels, kNothing)};
}

vec3 color_at(const Source& source, const Resampler& resampler, const Place& place, std::vector<float>& values) {
  std::ranges::fill(values, 0.0f);
  resampler.add(place, cell_of(source.camera.projection, source.picture->size, place.at), 1.0f, values.data());
  return max(vec3(values[0], values[1], values[2]), vec3(0.0f));
}

bool shows_only(const Reprojection& picture, const Place& place, float nearness) {
  constexpr float kFilter = 2.0f;  // texels
  constexpr vec2 kAround[] = {{0.0f, 0.0f}, {kFilter, 0.0f}, {-kFilter, 0.0f}, {0.0f, kFilter}, {0.0f, -kFilter}};
  return std::ranges::all_of(kAround, [&](vec2 beside) {
    const float there = nearness_of(picture, {place.source_eye, place.at + beside, true});
    return there == nearness || (nearness > 0.0f && is_one_surface(there, nearness));
  });
}

DepthPanorama look_from_middle(const Reprojection& picture, const PageGrid& grid, float reach) {
  const Source& source = *picture.source;
  const Resampler resampler(source);
  const bool has_other = source.picture->eyes.size() > 1;
  DepthPanorama panorama = empty_panorama(grid);
  std::vector<char> mixed(panorama.colors.size());
  tbb::parallel_for(0, grid.pages() * grid.size(), [&](int row) {
    std::vector<float> values(static_cast<size_t>(resampler.channels()));
    for (int x = 0; x < grid.size(); x++) {
      const int page = row / grid.size(), y = row % grid.size();
      const Ray ray{vec3(0.0f), grid.texel_ray(page, x, y)};
      SurfaceHit hit = meet_surface(picture, 0, ray, true);
      if (!hit.place.seen) continue;
      const size_t texel = index_of(grid, {page, x, y});
      const float nearness = panorama.nearness[texel] = inverse_depth(hit.depth);
      if (!shows_only(picture, hit.place, nearness)) {
        const SurfaceHit other = has_other ? meet_surface(picture, 1, ray, false) : SurfaceHit();
        const bool is_clean = other.place.seen && is_one_surface(inverse_depth(other.depth), nearness) &&
                              shows_only(picture, other.place, nearness);
        if (is_clean) hit = other;
        mixed[texel] = is_clean ? 0 : 1;
      }
      panorama.colors[texel] = color_at(source, resampler, hit.place, values);
    }
  });
  clean_edges(panorama, reach, std::move(mixed));
  return panorama;
}

size_t inner_texel(const PageGrid& grid, int page, vec2 position) {
  const int first = PageGrid::kGutter, last = grid.size() - PageGrid::kGutter - 1;
  const auto is_inner = [&](float at) { return at >= static_cast<float>(first) && at < static_cast<float>(last + 1); };
  if (!is_inner(position.x) || !is_inner(position.y)) {
    const PagePlace place = place_in_pages(grid, from_page(grid, page, position));
    page = place.page;
    position = place.position;
  }
  const auto at = [&](float along) { return std::clamp(static_cast<int>(along), first, last); };
  return index_of(grid, {page, at(position.x), at(position.y)});
}

size_t texel_towards(const PageGrid& grid, vec3 direction) {
  const PagePlace place = place_in_pages(grid, direction);
  return inner_texel(grid, place.page, place.position);
}

bool shows_one_surface(float a, float b, float reach, float pixel) {
  if (!is_texel_of_surface(a) || !is_texel_of_surface(b)) return false;
  return std::abs(a - b) <= std::max(pixel / reach, kSameDepth * std::max(a, b));
}

bool continues(float before, float a, float b, float after, float reach, float pixel) {
  if (!is_texel_of_surface(a) || !is_texel_of_surface(b)) return false;
  if (shows_one_surface(a, b, reach, pixel)) return true;
  const float miss = std::max(pixel / reach, kOffSlope * std::abs(a - b));
  return (is_texel_of_surface(before) && std::abs(2.0f * a - before - b) <= miss) ||
         (is_texel_of_surface(after) && std::abs(2.0f * b - after - a) <= miss);
}

}  // namespace ods
