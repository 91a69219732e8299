// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/still_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ods/image/tone.h"
#include "ods/layers/film/kept_light.h"
#include "ods/layers/page_grid.h"

namespace ods {

namespace {

constexpr float kNeutral = 128.0f / 255.0f;  // no change
constexpr float kNoise = 2.5f / 255.0f;      // a change of 4 % in linear light
constexpr int kGrown = 2;                    // texels around a change
constexpr int kCrowd = 4;                    // of the 9 texels around one that changes: fewer are noise
constexpr int kMaxHalvings = 6;

// The ray of a block of a texture: that of its lit texel that is nearest to the middle. It covers the block where all of
// it is lit, on one surface, and flat.
struct Block {
  const LayerGeometry& geometry;
  int texture, left, top, step;

  size_t texel(int x, int y) const {
    const int last = geometry.texture_size - 1;
    return texel_index(geometry.texture_size, texture, std::min(left + x, last), std::min(top + y, last));
  }

  bool is_whole(size_t middle) const {
    const TexelRays& rays = geometry.rays;
    if (left + step > geometry.texture_size || top + step > geometry.texture_size) return false;
    for (int i = 0; i < step * step; i++) {
      const size_t at = texel(i % step, i / step);
      if (rays.owners[at] != rays.owners[middle] || rays.rays[at].across == vec3(0.0f)) return false;
    }
    return true;
  }

  void add_to(TexelRay& ray, int& owner) const {
    const TexelRays& rays = geometry.rays;
    const int middle = (step - 1) / 2;
    int nearest = 4 * step * step;
    size_t best = 0;
    for (int i = 0; i < step * step; i++) {
      const size_t at = texel(i % step, i / step);
      const int dx = i % step - middle, dy = i / step - middle;
      if (rays.owners[at] < 0 || rays.rays[at].direction == vec3(0.0f) || dx * dx + dy * dy >= nearest) continue;
      nearest = dx * dx + dy * dy;
      best = at;
    }
    if (nearest == 4 * step * step) return;
    ray = rays.rays[best];
    owner = rays.owners[best];
    if (step == 1 || nearest > 0 || !is_whole(best)) return;
    const float aside = 0.5f * static_cast<float>(step - 1 - 2 * middle);
    ray.origin += aside * (ray.across + ray.down);
    ray.across *= static_cast<float>(step), ray.down *= static_cast<float>(step);
  }
};

float code_of(float before, float now) {
  const float ratio = (now + kDarkLight) / (before + kDarkLight);
  return ratio / (ratio + kRatioUnit);
}

// The changes of a texture: codes less the neutral one, or nothing where there is no light.
struct Changes {
  int size;
  std::vector<vec3> change;
  std::vector<char> is_lit;

  size_t at(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x); }

  // Calls visit(index) for the lit ones of the 9 texels around one.
  template <typename Visit>
  void around(int x, int y, const Visit& visit) const {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, size - 1); v++) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, size - 1); u++) {
        if (is_lit[at(u, v)]) visit(at(u, v));
      }
    }
  }

  template <typename Visit>
  void each(const Visit& visit) const {
    for (int y = 0; y < size; y++) {
      for (int x = 0; x < size; x++) visit(x, y, at(x, y));
    }
  }
};

Changes changes_of(const CoarseLayers& layers, size_t texture, const Image& before, const Image& now) {
  Changes all{layers.size, {}, {}};
  const size_t texels = static_cast<size_t>(layers.size) * static_cast<size_t>(layers.size), first = texture * texels;
  all.change.resize(texels), all.is_lit.resize(texels);
  for (size_t i = 0; i < texels; i++) {
    all.is_lit[i] = layers.rays->owners[first + i] >= 0 ? 1 : 0;
    if (!all.is_lit[i]) continue;
    for (size_t c = 0; c < 3; c++) {
      const size_t at = 3 * (first + i) + c;
      all.change[i][static_cast<int>(c)] = code_of(before.pixels[at], now.pixels[at]) - kNeutral;
    }
  }
  return all;
}

// Removes changes that are no larger than noise.
void remove_noise(Changes& all) {
  std::vector<float> share(all.change.size());
  all.each([&](int x, int y, size_t i) {
    vec3 sum(0.0f);
    float count = 0.0f;
    all.around(x, y, [&](size_t near) { sum += all.change[near], count += 1.0f; });
    const vec3 mean = abs(sum) / std::max(count, 1.0f);
    share[i] = all.is_lit[i] ? std::clamp(2.0f * std::max({mean.x, mean.y, mean.z}) / kNoise - 1.0f, 0.0f, 1.0f) : 0.0f;
  });
  std::vector<int> crowd(share.size());
  all.each(
      [&](int x, int y, size_t i) { all.around(x, y, [&](size_t near) { crowd[i] += share[near] > 0.0f ? 1 : 0; }); });
  for (size_t i = 0; i < share.size(); i++) all.change[i] *= crowd[i] < kCrowd ? 0.0f : share[i];
}

// Texels beside lit ones, which filters read, change alike.
void push(Changes& all) {
  for (int ring = 0; ring < kGrown; ring++) {
    const Changes before = all;
    all.each([&](int x, int y, size_t i) {
      if (before.is_lit[i]) return;
      vec3 sum(0.0f);
      float count = 0.0f;
      before.around(x, y, [&](size_t near) { sum += before.change[near], count += 1.0f; });
      if (count == 0.0f) return;
      all.change[i] = sum / count;
      all.is_lit[i] = 1;
    });
  }
}

ChangedPart part_of_changes(const Changes& all) {
  ChangedPart part{glm::ivec2(all.size), glm::ivec2(0), {}};
  all.each([&](int x, int y, size_t i) {
    if (all.change[i] == vec3(0.0f)) return;
    part.from = glm::min(part.from, glm::ivec2(x, y));
    part.to = glm::max(part.to, glm::ivec2(x + 1, y + 1));
  });
  if (part.to.x == 0) return {};
  const glm::ivec2 size = part.to - part.from;
  part.codes = Image(size.x, size.y, 3);
  for (int y = 0; y < size.y; y++) {
    for (int x = 0; x < size.x; x++) {
      const vec3 change = all.change[all.at(part.from.x + x, part.from.y + y)];
      for (int c = 0; c < 3; c++) part.codes.at(x, y)[c] = kNeutral + change[c];
    }
  }
  return part;
}

// --- textures of all

struct Cell {
  glm::ivec2 from{0}, to{0};  // of the layer's coarse texture
  glm::ivec2 place{0};        // of `from` in the common texture
  bool is_empty() const { return to.x <= from.x; }
};

// The border of cells that does not change: it holds whole texels after some halvings, too.
int border_of(int halvings) {
  return halvings == 0 ? 1 : 3 << halvings;
}

// Places the cells in rows, the highest ones first; returns the size of all.
glm::ivec2 place_cells(std::vector<Cell>& cells, int border) {
  const auto size_of = [&](size_t i) { return cells[i].to - cells[i].from + 2 * border; };
  std::vector<size_t> order(cells.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::erase_if(order, [&](size_t i) { return cells[i].is_empty(); });
  std::ranges::stable_sort(order, std::greater(), [&](size_t i) { return size_of(i).y; });
  int area = 0, width = 1;
  for (const size_t i : order) area += size_of(i).x * size_of(i).y, width = std::max(width, size_of(i).x);
  width = std::max(width, static_cast<int>(std::sqrt(static_cast<float>(area))));
  glm::ivec2 at(0), all(0);
  int high = 0;
  for (const size_t i : order) {
    const glm::ivec2 size = size_of(i);
    if (at.x + size.x > width) at = {0, at.y + high}, high = 0;
    cells[i].place = at + border;
    at.x += size.x, high = std::max(high, size.y);
    all = glm::max(all, at + glm::ivec2(0, size.y));
  }
  return all;
}

Image with_parts(const std::vector<Cell>& cells, const std::vector<ChangedPart>& parts, glm::ivec2 size) {
  Image ratios(size.x, size.y, 3);
  std::ranges::fill(ratios.pixels, kNeutral);
  for (size_t i = 0; i < parts.size(); i++) {
    const glm::ivec2 to = cells[i].place + parts[i].from - cells[i].from;
    for (int y = 0; y < parts[i].codes.height; y++) {
      std::copy_n(parts[i].codes.at(0, y), 3 * parts[i].codes.width, ratios.at(to.x, to.y + y));
    }
  }
  return ratios;
}

// Half as wide and high: the mean of four texels.
Image halved(const Image& image) {
  Image half((image.width + 1) / 2, (image.height + 1) / 2, 3);
  for (int y = 0; y < half.height; y++) {
    for (int x = 0; x < half.width; x++) {
      for (int i = 0; i < 4; i++) {
        const float* from =
            image.at(std::min(2 * x + i % 2, image.width - 1), std::min(2 * y + i / 2, image.height - 1));
        for (int c = 0; c < 3; c++) half.at(x, y)[c] += 0.25f * from[c];
      }
    }
  }
  return half;
}

size_t texels_in(glm::ivec2 size) {
  return static_cast<size_t>(size.x) * static_cast<size_t>(size.y);
}

}  // namespace

CoarseLayers coarse_layers(const LayerGeometry& geometry, int width) {
  CoarseLayers layers;
  layers.step = std::max(static_cast<int>(std::lround(static_cast<float>(width) / kCoarseWidth)), 1);
  layers.size = (geometry.texture_size + layers.step - 1) / layers.step;
  layers.texels = static_cast<float>(geometry.texture_size) / static_cast<float>(layers.step);
  layers.textures = geometry.scene.meshes.size();
  auto rays = std::make_shared<TexelRays>();
  rays->width = layers.size;
  rays->height = layers.size * static_cast<int>(layers.textures);
  rays->rays.resize(texels_in({rays->width, rays->height}));
  rays->owners.assign(rays->rays.size(), -1);
  for (size_t texture = 0; texture < layers.textures; texture++) {
    if (geometry.scene.meshes[texture].kind == LayerKind::kBlended) continue;
    for (int y = 0; y < layers.size; y++) {
      for (int x = 0; x < layers.size; x++) {
        const size_t at = texel_index(layers.size, static_cast<int>(texture), x, y);
        const Block block{geometry, static_cast<int>(texture), layers.step * x, layers.step * y, layers.step};
        block.add_to(rays->rays[at], rays->owners[at]);
      }
    }
  }
  layers.rays = std::move(rays);
  return layers;
}

Image coarse_light(const CoarseLayers& layers, const Renderer& renderer, const LayerLight& light,
                   const std::string& kept, const Progress& progress) {
  Image all = kept_light(renderer, layers.rays, light.bake, kept, progress);
  for (size_t i = 0; i < all.pixels.size(); i += 3) {
    const vec3 shown = tone_map({all.pixels[i], all.pixels[i + 1], all.pixels[i + 2]}, light.exposure, light.tone);
    for (size_t c = 0; c < 3; c++) all.pixels[i + c] = std::clamp(shown[static_cast<int>(c)], 0.0f, 1.0f);
  }
  return all;
}

std::vector<ChangedPart> changed_parts(const CoarseLayers& layers, const Image& before, const Image& now) {
  std::vector<ChangedPart> parts;
  for (size_t texture = 0; texture < layers.textures; texture++) {
    Changes all = changes_of(layers, texture, before, now);
    remove_noise(all);
    push(all);
    parts.push_back(part_of_changes(all));
  }
  return parts;
}

LightChange light_change(const CoarseLayers& layers, std::span<const std::vector<ChangedPart>> parts, size_t most) {
  std::vector<Cell> cells(layers.textures);
  for (const std::vector<ChangedPart>& light : parts) {
    for (size_t i = 0; i < light.size(); i++) {
      if (light[i].codes.pixels.empty()) continue;
      const bool is_first = cells[i].is_empty();
      cells[i].from = is_first ? light[i].from : glm::min(cells[i].from, light[i].from);
      cells[i].to = is_first ? light[i].to : glm::max(cells[i].to, light[i].to);
    }
  }
  int halvings = 0;
  const auto place_all = [&] { return place_cells(cells, border_of(halvings)); };
  glm::ivec2 size = place_all();
  while (halvings < kMaxHalvings && parts.size() * texture_bytes(texels_in(size)) >> (2 * halvings) > most) {
    halvings++;
    size = place_all();
  }
  LightChange change;
  if (size.x == 0) return change;
  for (const Cell& cell : cells) {
    ChangePlace place;
    if (!cell.is_empty()) {
      const vec2 all(size);
      place.scale = layers.texels / all;
      place.offset = vec2(cell.place - cell.from) / all;
      const float outside = static_cast<float>(border_of(halvings)) - 0.5f * static_cast<float>(1 << halvings);
      place.low = (vec2(cell.place) - outside) / all;
      place.high = (vec2(cell.place + cell.to - cell.from) + outside) / all;
    }
    change.places.push_back(place);
  }
  for (const std::vector<ChangedPart>& light : parts) {
    Image ratios = with_parts(cells, light, size);
    for (int i = 0; i < halvings; i++) ratios = halved(ratios);
    change.ratios.push_back(std::move(ratios));
  }
  return change;
}

}  // namespace ods
