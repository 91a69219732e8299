// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading textures: wrapping, interpolation and colour curve as glTF's samplers have them.
#ifdef __cplusplus
#pragma once
#include "ods/kernel/filter.h"
namespace ods {
struct TextureReader : FilterSampler {
#endif

  inline int wrap_texel(int i, int size, int wrap) {
    if (wrap == kWrapClamp) return clamp(i, 0, size - 1);
    if (wrap == kWrapRepeat) {
      int m = i % size;
      return m < 0 ? m + size : m;
    }
    int period = 2 * size;
    int m = i % period;
    if (m < 0) m += period;
    return m < size ? m : period - 1 - m;
  }

  // One texel, linear. Coordinates outside the picture wrap.
  inline vec4 texel_at(Texture texture, int x, int y) {
    uint column = uint(wrap_texel(x, texture.width, texture.wrap_u));
    uint row = uint(wrap_texel(y, texture.height, texture.wrap_v));
    uint bits = scene_texel(texture.first_texel + row * uint(texture.width) + column);
    int r = int(bits & 255u);
    int g = int((bits >> 8u) & 255u);
    int b = int((bits >> 16u) & 255u);
    float a = float(bits >> 24u) * (1.0f / 255.0f);
    if (texture.srgb == 1) {
      return vec4(scene_table(kSrgbTable + r), scene_table(kSrgbTable + g), scene_table(kSrgbTable + b), a);
    }
    return vec4(vec3(float(r), float(g), float(b)) * (1.0f / 255.0f), a);
  }

  // uv as in glTF: (0, 0) is the top left corner of the picture. Beyond a million turns the place within a texel is
  // lost to rounding; what is read stays inside the texture.
  inline vec4 texture_at(Texture texture, vec2 uv) {
    float x = clamp(uv.x, -1e6f, 1e6f);
    float y = clamp(uv.y, -1e6f, 1e6f);
    if (texture.wrap_u == kWrapRepeat) x = x - floor(x);
    if (texture.wrap_v == kWrapRepeat) y = y - floor(y);
    x = clamp(x * float(texture.width), -1e9f, 1e9f);
    y = clamp(y * float(texture.height), -1e9f, 1e9f);
    if (texture.nearest == 1) return texel_at(texture, int(floor(x)), int(floor(y)));
    x -= 0.5f;
    y -= 0.5f;
    int x0 = int(floor(x));
    int y0 = int(floor(y));
    float fx = x - floor(x);
    float fy = y - floor(y);
    vec4 top = mix(texel_at(texture, x0, y0), texel_at(texture, x0 + 1, y0), fx);
    vec4 bottom = mix(texel_at(texture, x0, y0 + 1), texel_at(texture, x0 + 1, y0 + 1), fx);
    return mix(top, bottom, fy);
  }

  // What a material reads through a slot; 1 where it has no texture.
  inline vec4 slot_at(TextureSlot slot, vec2 uv0, vec2 uv1) {
    if (slot.texture < 0) return vec4(1.0f);
    vec2 uv = slot.uv_set == 0 ? uv0 : uv1;
    return texture_at(scene_texture(slot.texture), slot.offset + slot.axis_u * uv.x + slot.axis_v * uv.y);
  }

#ifdef __cplusplus
};
}  // namespace ods
#endif
