// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/patterns.h"

#include <bit>
#include <cassert>

#include "ods/kernel/camera/camera.h"

namespace ods {

float hash01(int x, int y, uint seed) {
  uint h = static_cast<uint>(x) * 0x8da6b343u ^ static_cast<uint>(y) * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return static_cast<float>((h ^ (h >> 16)) >> 8) / 16777216.0f;
}

float noise(vec2 p, int period, uint seed) {
  assert(std::has_single_bit(static_cast<uint>(period)));
  const vec2 cell = floor(p);
  const vec2 t = smoothstep(vec2(0.0f), vec2(1.0f), p - cell);
  const int wrap = period - 1, left = static_cast<int>(cell.x), above = static_cast<int>(cell.y);
  const int x = left & wrap, y = above & wrap, right = (left + 1) & wrap, below = (above + 1) & wrap;
  return mix(mix(hash01(x, y, seed), hash01(right, y, seed), t.x),
             mix(hash01(x, below, seed), hash01(right, below, seed), t.x), t.y);
}

float fractal_noise(vec2 p, int period, int octaves, uint seed) {
  float sum = 0.0f, weight = 0.5f, total = 0.0f;
  for (int i = 0; i < octaves; i++) {
    sum += weight * noise(p, period, seed + static_cast<uint>(i));
    total += weight;
    weight *= 0.5f;
    p *= 2.0f;
    period *= 2;
  }
  return sum / total;
}

// 1 inside, 0 outside, with a soft edge.
static float inside(float distance, float edge) {
  return 1.0f - smoothstep(-edge, edge, distance);
}

// Grain along u: noise that is 16 times longer than wide, with darker growth rings.
static float grain(vec2 p, uint seed) {
  const float wander = fractal_noise(p * vec2(4.0f, 8.0f), 8, 3, seed);
  const float fibre = fractal_noise(p * vec2(8.0f, 128.0f), 128, 2, seed + 7u);
  const float rings = 0.5f + 0.5f * sin((p.y * 7.0f + wander * 2.2f) * 2.0f * kPi);
  return 0.55f * rings * rings + 0.45f * fibre;
}

vec3 wood_planks(vec2 p) {
  const int rows = 8;
  const int row = static_cast<int>(floor(p.y * rows));
  const float along = fract(p.x + hash01(row, 0, 11u));
  const vec2 inside_board(along, fract(p.y * rows));
  const uint board = static_cast<uint>(row) * 2u + (along < 0.5f ? 0u : 1u);
  const float tone = hash01(static_cast<int>(board), 1, 12u);
  const float g = grain(vec2(p.x, inside_board.y * 0.5f), 40u + board);
  vec3 color = mix(vec3(0.60f, 0.39f, 0.21f), vec3(0.40f, 0.225f, 0.105f), 0.75f * g);
  color *= mix(0.72f, 1.15f, tone);
  const float to_side = min(inside_board.y, 1.0f - inside_board.y) / rows;
  const float to_end = min(min(along, 1.0f - along), abs(along - 0.5f));
  return color * mix(0.25f, 1.0f, smoothstep(0.0f, 0.0035f, min(to_side, to_end)));
}

vec3 wood_grain(vec2 p) {
  return mix(vec3(1.0f), vec3(0.5f, 0.42f, 0.36f), grain(p, 3u));
}

vec3 plaster(vec2 p) {
  const float broad = fractal_noise(p * 4.0f, 4, 5, 21u), fine = noise(p * 128.0f, 128, 22u);
  return vec3(0.90f + 0.08f * broad + 0.03f * (fine - 0.5f));
}

vec3 fabric(vec2 p) {
  const vec2 thread = p * 32.0f;
  const bool over = (static_cast<int>(thread.x) + static_cast<int>(thread.y)) % 2 == 0;
  const vec2 t = abs(fract(thread) - 0.5f) * 2.0f;
  const float bulge = over ? 1.0f - t.x * t.x : 1.0f - t.y * t.y;
  const float fleck = hash01(static_cast<int>(thread.x), static_cast<int>(thread.y), 31u);
  return vec3(0.55f + 0.35f * bulge + 0.10f * fleck);
}

vec3 leather(vec2 p) {
  const float crease = abs(fractal_noise(p * 16.0f, 16, 3, 41u) - 0.5f) * 2.0f;
  return vec3(0.75f + 0.25f * smoothstep(0.0f, 0.3f, crease)) * (0.85f + 0.15f * noise(p * 2.0f, 2, 42u));
}

vec3 brick(vec2 p) {
  const int rows = 12, columns = 4;
  const int row = static_cast<int>(p.y * rows);
  const float x = p.x * columns + (row % 2 == 0 ? 0.0f : 0.5f);
  const int column = static_cast<int>(x) % columns;
  const vec2 t = abs(vec2(fract(x), fract(p.y * rows)) - 0.5f);
  const float mortar = max(smoothstep(0.46f, 0.49f, t.x), smoothstep(0.40f, 0.46f, t.y));
  const float rough = fractal_noise(p * 32.0f, 32, 3, 51u);
  const vec3 clay = mix(vec3(0.30f, 0.09f, 0.05f), vec3(0.46f, 0.19f, 0.10f), hash01(column, row, 52u));
  return mix(clay * (0.6f + 0.7f * rough), vec3(0.42f, 0.38f, 0.33f), mortar);
}

vec3 marble(vec2 p) {
  const float bend = fractal_noise(p * 4.0f, 4, 5, 61u);
  const float vein = abs(sin((p.x + p.y + 1.4f * bend) * 2.0f * kPi));
  return mix(vec3(0.42f, 0.42f, 0.45f), vec3(0.88f, 0.86f, 0.83f), smoothstep(0.0f, 0.25f, vein));
}

vec3 checker(vec2 p) {
  const bool dark = (p.x < 0.5f) != (p.y < 0.5f);
  return dark ? vec3(0.09f, 0.10f, 0.12f) : vec3(0.72f, 0.70f, 0.66f);
}

vec3 rug(vec2 p) {
  const vec3 red(0.30f, 0.035f, 0.03f), navy(0.03f, 0.045f, 0.13f), cream(0.62f, 0.52f, 0.36f),
      gold(0.5f, 0.28f, 0.07f);
  const vec2 q = abs(p - 0.5f) * vec2(3.0f, 2.0f);  // folded into one quarter: 1.5 x 1
  const float edge = min(1.5f - q.x, 1.0f - q.y);
  const auto lozenges = [](vec2 at, float size) {
    const vec2 t = abs(fract(at / size) - 0.5f);
    return t.x + t.y;
  };
  vec3 color = red;
  if (lozenges(q, 0.16f) < 0.20f) color = mix(red, gold, 0.55f);
  const float medallion = q.x / 0.95f + q.y / 0.62f + 0.05f * cos(q.x * 40.0f) * cos(q.y * 40.0f);
  if (medallion < 1.0f) color = navy;
  if (medallion < 1.0f && lozenges(q, 0.11f) < 0.17f) color = cream;
  if (abs(medallion - 1.0f) < 0.05f) color = cream;
  if (medallion < 0.5f) color = gold * 0.8f;
  if (abs(medallion - 0.5f) < 0.05f) color = cream;
  if (medallion < 0.25f) color = red;
  if (edge < 0.26f) color = navy;
  if (edge < 0.24f && edge > 0.06f && lozenges(q + 0.03f, 0.18f) < 0.32f)
    color = lozenges(q + 0.03f, 0.18f) < 0.16f ? gold : red;
  if (abs(edge - 0.255f) < 0.014f || abs(edge - 0.05f) < 0.012f) color = cream;
  if (edge < 0.03f) color = red * 0.6f;
  const float pile = hash01(static_cast<int>(p.x * 420.0f), static_cast<int>(p.y * 280.0f), 71u);
  return color * (0.75f + 0.4f * pile) * (0.85f + 0.3f * fractal_noise(p * 4.0f, 4, 3, 72u));
}

// Hills behind hills under a low sun.
static vec3 painted_hills(vec2 p) {
  vec3 color = mix(vec3(0.10f, 0.20f, 0.38f), vec3(0.95f, 0.50f, 0.22f), smoothstep(0.0f, 0.6f, p.y));
  color =
      mix(color, vec3(1.0f, 0.80f, 0.45f), inside(length((p - vec2(0.66f, 0.42f)) * vec2(1.4f, 1.0f)) - 0.09f, 0.01f));
  for (int i = 0; i < 4; i++) {
    const float fi = static_cast<float>(i);
    const float ridge = 0.48f + 0.12f * fi + 0.16f * (noise(vec2(p.x * (3.0f + fi), fi), 16, 81u) - 0.5f);
    color =
        mix(color, mix(vec3(0.34f, 0.25f, 0.36f), vec3(0.02f, 0.07f, 0.06f), fi / 3.0f), inside(ridge - p.y, 0.006f));
  }
  return color;
}

// Overlapping flat shapes, a little modernist.
static vec3 painted_shapes(vec2 p) {
  vec3 color(0.72f, 0.64f, 0.52f);
  color = mix(color, vec3(0.65f, 0.17f, 0.07f), inside(length(p - vec2(0.38f, 0.36f)) - 0.24f, 0.004f));
  color =
      mix(color, vec3(0.04f, 0.13f, 0.18f), inside(max(abs(p.x - 0.62f) - 0.16f, abs(p.y - 0.62f) - 0.25f), 0.004f));
  color =
      mix(color, vec3(0.70f, 0.42f, 0.08f), inside(max(length(p - vec2(0.5f, 0.80f)) - 0.26f, p.y - 0.80f), 0.004f));
  color = mix(color, vec3(0.05f), inside(abs(p.y - 0.82f - 0.06f * sin(p.x * 9.0f)) - 0.006f, 0.003f));
  return color;
}

// A moonlit sea.
static vec3 painted_sea(vec2 p) {
  const float horizon = 0.55f;
  const float haze = fractal_noise(p * vec2(4.0f, 12.0f), 16, 4, 83u);
  vec3 color =
      mix(vec3(0.015f, 0.035f, 0.09f), vec3(0.13f, 0.22f, 0.30f), smoothstep(0.0f, horizon, p.y) * (0.5f + haze));
  color =
      mix(color, vec3(0.9f, 0.86f, 0.7f), inside(length((p - vec2(0.42f, 0.22f)) * vec2(1.0f, 1.0f)) - 0.065f, 0.006f));
  if (p.y > horizon) {
    const float wave = noise(vec2(p.x * 14.0f, p.y * 90.0f), 128, 84u);
    const float track = inside(abs(p.x - 0.42f) - 0.03f - 0.35f * (p.y - horizon), 0.06f);
    color = mix(vec3(0.012f, 0.05f, 0.075f), vec3(0.75f, 0.70f, 0.52f), track * smoothstep(0.45f, 0.8f, wave));
  }
  return color;
}

// Soft bands of colour, one over another.
static vec3 painted_field(vec2 p) {
  const float ragged = 0.02f * (fractal_noise(p * 8.0f, 8, 4, 85u) - 0.5f);
  const auto band = [&](vec2 low, vec2 high) {
    const vec2 d = max(low - p, p - high) + ragged;
    return inside(max(d.x, d.y), 0.025f);
  };
  vec3 color(0.28f, 0.05f, 0.03f);
  color = mix(color, vec3(0.80f, 0.32f, 0.06f), band(vec2(0.09f, 0.07f), vec2(0.91f, 0.48f)));
  color = mix(color, vec3(0.10f, 0.02f, 0.05f), band(vec2(0.09f, 0.53f), vec2(0.91f, 0.70f)));
  color = mix(color, vec3(0.62f, 0.10f, 0.05f), band(vec2(0.09f, 0.74f), vec2(0.91f, 0.93f)));
  return color;
}

// Dark leaves on either side of a stalk.
static vec3 painted_leaves(vec2 p) {
  vec3 color = mix(vec3(0.74f, 0.69f, 0.56f), vec3(0.62f, 0.55f, 0.42f), fractal_noise(p * 4.0f, 4, 4, 87u));
  const auto stalk_x = [](float y) { return 0.5f + 0.05f * sin(3.0f * y); };
  color = mix(color, vec3(0.10f, 0.15f, 0.06f), inside(max(abs(p.x - stalk_x(p.y)) - 0.006f, 0.1f - p.y), 0.003f));
  for (int i = 0; i < 11; i++) {
    const float y = 0.14f + 0.072f * static_cast<float>(i), size = 0.12f + 0.022f * static_cast<float>(i);
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    const vec2 from = p - vec2(stalk_x(y), y), along(side * 0.82f, -0.57f);
    const float t = dot(from, along) / size, across = abs(from.x * along.y - from.y * along.x) / size;
    const float half_width = 0.24f * sin(kPi * clamp(t, 0.0f, 1.0f));
    const vec3 green = mix(vec3(0.03f, 0.12f, 0.07f), vec3(0.16f, 0.24f, 0.08f), hash01(i, 0, 88u));
    color = mix(color, across < 0.012f ? green * 1.8f : green,
                inside(across - half_width, 0.02f) * (t > 0.0f && t < 1.0f ? 1.0f : 0.0f));
  }
  return color;
}

vec3 painting(vec2 p, int number) {
  const float canvas = 0.92f + 0.16f * noise(p * 160.0f, 256, 86u);
  switch (number) {
    case 0:
      return canvas * painted_hills(p);
    case 1:
      return canvas * painted_shapes(p);
    case 2:
      return canvas * painted_sea(p);
    case 3:
      return canvas * painted_leaves(p);
    default:
      return canvas * painted_field(p);
  }
}

vec3 book_spine(vec2 p) {
  const vec3 cloth(0.9f + 0.1f * hash01(static_cast<int>(p.x * 64.0f), static_cast<int>(p.y * 256.0f), 91u));
  const vec3 gold(1.0f, 0.72f, 0.28f);
  const float lines = min(min(abs(p.y - 0.09f), abs(p.y - 0.115f)), min(abs(p.y - 0.91f), abs(p.y - 0.885f)));
  if (lines < 0.006f) return gold;
  const float letter = hash01(static_cast<int>(p.y * 90.0f), 0, 92u);
  const bool title = p.y > 0.25f && p.y < 0.62f && abs(p.x - 0.5f) < 0.10f + 0.12f * letter && letter > 0.3f;
  return title ? gold : cloth;
}

}  // namespace ods
