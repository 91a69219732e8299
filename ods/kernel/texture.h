// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads textures: wrapping, interpolation and colour curve as glTF's samplers define them.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/filter.h"
namespace ods {
#endif

// floor() to an integer, without the function call that floor() compiles to for older processors. |x| < 2^31.
inline int floor_int(float x) {
  int i = int(x);
  return x < float(i) ? i - 1 : i;
}

// Maps a texture coordinate to 0..1.
inline float wrap_coordinate(float x, int wrap) {
  x = clamp(x, -1e6f, 1e6f);
  if (wrap == kWrapRepeat) return x - float(floor_int(x));
  if (wrap == kWrapMirror) return abs(x - 2.0f * float(floor_int(0.5f * x + 0.5f)));
  return clamp(x, 0.0f, 1.0f);
}

// The neighbour of an edge texel: -1 <= i <= size. In a mirrored picture, an edge texel is its own neighbour.
inline int wrap_texel(int i, int size, int wrap) {
  if (wrap == kWrapRepeat) return i < 0 ? size - 1 : (i >= size ? 0 : i);
  return clamp(i, 0, size - 1);
}

// Packs a vector of a normal map, of any length above 0, as kTexelNormal. z < 0 counts as 0.
inline uint pack_normal(vec3 n) {
  n = vec3(n.x, n.y, max(n.z, 0.0f));
  float size = length(n);
  n = size > 1e-6f ? n * (1.0f / size) : vec3(0.0f, 0.0f, 1.0f);
  return uint((n.x * 0.5f + 0.5f) * 65535.0f + 0.5f) | uint((n.y * 0.5f + 0.5f) * 65535.0f + 0.5f) << 16u;
}

// The vector as texels of bytes store it: 0..1 for -1..1. Few textures are packed, so this is not inlined into the
// reader of the others.
#ifdef __cplusplus
[[gnu::noinline, gnu::cold]]
#endif
inline vec4
unpack_normal(uint bits) {
  float x = float(bits & 65535u) * (1.0f / 65535.0f);
  float y = float(bits >> 16u) * (1.0f / 65535.0f);
  vec2 n = vec2(x * 2.0f - 1.0f, y * 2.0f - 1.0f);
  return vec4(x, y, sqrt(max(1.0f - dot(n, n), 0.0f)) * 0.5f + 0.5f, 1.0f);
}

#ifdef __cplusplus
struct TextureReader : FilterSampler {
#endif

  // One texel, linear.
  inline vec4 texel_at(Texture texture, bool reduced, int x, int y) {
    uint at = texture.first_texel + uint(y) * uint(texture.width) + uint(x);
    uint bits = reduced ? scene_reduced_texel(at) : scene_texel(at);
    int r = int(bits & 255u);
    int g = int((bits >> 8u) & 255u);
    int b = int((bits >> 16u) & 255u);
    float a = float(bits >> 24u) * (1.0f / 255.0f);
    if (texture.srgb == 1) {
      return vec4(scene_table(kSrgbTable + r), scene_table(kSrgbTable + g), scene_table(kSrgbTable + b), a);
    }
    if (texture.packing == kTexelNormal) return unpack_normal(bits);
    return vec4(vec3(float(r), float(g), float(b)) * (1.0f / 255.0f), a);
  }

  // reduced: the texture is a reduced copy. uv as in glTF: (0, 0) is the top left corner of the picture.
  // Beyond a million repeats rounding loses the position within a texel; the texel read is still inside the texture.
  // The four texels are read in one place: compilers for GPUs inline each place of a call. Without interpolation the
  // fractions are 0.
  inline vec4 texture_at(Texture texture, bool reduced, vec2 uv) {
    float x = wrap_coordinate(uv.x, texture.wrap_u) * float(texture.width);
    float y = wrap_coordinate(uv.y, texture.wrap_v) * float(texture.height);
    bool nearest = texture.nearest == 1;
    int x0 = nearest ? min(int(x), texture.width - 1) : floor_int(x - 0.5f);
    int y0 = nearest ? min(int(y), texture.height - 1) : floor_int(y - 0.5f);
    float fx = nearest ? 0.0f : x - 0.5f - float(x0);
    float fy = nearest ? 0.0f : y - 0.5f - float(y0);
    int x1 = wrap_texel(x0 + 1, texture.width, texture.wrap_u);
    int y1 = wrap_texel(y0 + 1, texture.height, texture.wrap_v);
    x0 = wrap_texel(x0, texture.width, texture.wrap_u);
    y0 = wrap_texel(y0, texture.height, texture.wrap_v);
    vec4 row = vec4(0.0f);
    vec4 top = vec4(0.0f);
    for (int i = 0; i < 4; i++) {
      bool left = (i & 1) == 0;
      vec4 texel = texel_at(texture, reduced, left ? x0 : x1, i < 2 ? y0 : y1);
      row = left ? texel : mix(row, texel, fx);
      if (i == 1) top = row;
    }
    return mix(top, row, fy);
  }

  // The value that a material reads through a slot; 1 if the slot has no texture.
  inline vec4 slot_at(TextureSlot slot, vec2 uv0, vec2 uv1, bool reduced) {
    if (slot.texture < 0) return vec4(1.0f);
    vec2 uv = slot.uv_set == 0 ? uv0 : uv1;
    vec2 place = slot.offset + slot.axis_u * uv.x + slot.axis_v * uv.y;
    Texture texture;
    if (reduced) {
      texture = scene_reduced_texture(slot.texture);
    } else {
      texture = scene_texture(slot.texture);
    }
    return texture_at(texture, reduced, place);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
