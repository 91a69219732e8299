// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/reduced_textures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "ods/image/tone.h"
#include "ods/kernel/texture.h"

namespace ods {

static constexpr int kMaxHalvings = 3;
static constexpr int kEnoughTexels = 65536;

using Curve = std::array<float, 256>;  // decodes a stored value

static Curve make_curve(bool srgb) {
  Curve curve;
  for (size_t i = 0; i < curve.size(); i++) {
    const float value = static_cast<float>(i) / 255.0f;
    curve[i] = srgb ? srgb_decode(value) : value;
  }
  return curve;
}

static uint stored(float value) {
  return static_cast<uint>(value * 255.0f + 0.5f);
}

static uint mean_texel(const Texture& full, const uint* texels, int x0, int x1, int y0, int y1, const Curve& curve) {
  float r = 0.0f, g = 0.0f, b = 0.0f;
  uint a = 0;
  for (int y = y0; y < y1; y++) {
    const uint* row = texels + static_cast<size_t>(y) * static_cast<size_t>(full.width);
    for (int x = x0; x < x1; x++) {
      r += curve[row[x] & 255u], g += curve[row[x] >> 8 & 255u], b += curve[row[x] >> 16 & 255u];
      a += row[x] >> 24;
    }
  }
  const float share = 1.0f / static_cast<float>((x1 - x0) * (y1 - y0));
  vec3 mean = vec3(r, g, b) * share;
  if (full.srgb == 1) mean = vec3(srgb_encode(mean.x), srgb_encode(mean.y), srgb_encode(mean.z));
  const uint alpha = static_cast<uint>(static_cast<float>(a) * share + 0.5f);
  return stored(mean.x) | stored(mean.y) << 8 | stored(mean.z) << 16 | alpha << 24;
}

static uint mean_normal(const Texture& full, const uint* texels, int x0, int x1, int y0, int y1) {
  vec3 sum(0.0f);
  for (int y = y0; y < y1; y++) {
    const uint* row = texels + static_cast<size_t>(y) * static_cast<size_t>(full.width);
    for (int x = x0; x < x1; x++) sum += vec3(unpack_normal(row[x])) * 2.0f - vec3(1.0f);
  }
  return pack_normal(sum);
}

static Texture reduced_size(Texture texture) {
  int halvings = 0;
  while (halvings < kMaxHalvings && (texture.width >> halvings) * (texture.height >> halvings) > kEnoughTexels) {
    halvings++;
  }
  texture.width = std::max(texture.width >> halvings, 1);
  texture.height = std::max(texture.height >> halvings, 1);
  return texture;
}

void reduce_textures(Scene& scene) {
  scene.reduced_textures.clear();
  size_t total = 0;
  for (const Texture& full : scene.textures) {
    Texture reduced = reduced_size(full);
    reduced.first_texel = static_cast<uint>(total);
    total += static_cast<size_t>(reduced.width) * static_cast<size_t>(reduced.height);
    scene.reduced_textures.push_back(reduced);
  }
  scene.reduced_texels.resize(total);
  const Curve plain = make_curve(false), srgb = make_curve(true);
  for (size_t i = 0; i < scene.textures.size(); i++) {
    const Texture &full = scene.textures[i], &reduced = scene.reduced_textures[i];
    const uint* from = scene.texels.data() + full.first_texel;
    uint* to = scene.reduced_texels.data() + reduced.first_texel;
    tbb::parallel_for(0, reduced.height, [&](int y) {
      const auto edge = [](int at, int count, int size) {
        return static_cast<int>(static_cast<long>(at) * size / count);
      };
      const int y0 = edge(y, reduced.height, full.height), y1 = edge(y + 1, reduced.height, full.height);
      for (int x = 0; x < reduced.width; x++) {
        const int x0 = edge(x, reduced.width, full.width), x1 = edge(x + 1, reduced.width, full.width);
        to[y * reduced.width + x] = full.packing == kTexelNormal
                                        ? mean_normal(full, from, x0, x1, y0, y1)
                                        : mean_texel(full, from, x0, x1, y0, y1, full.srgb == 1 ? srgb : plain);
      }
    });
  }
}

}  // namespace ods
