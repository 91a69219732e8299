// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Procedural colours, linear Rec. 709, as functions of a point p in 0..1 x 0..1 (v down), for add_texture(). Patterns
// that repeat in reality tile without a seam. They use only hashing, so they have the same bits everywhere.
#pragma once
#include "ods/kernel/math.h"

namespace ods {

// A random number 0..1, different for each (x, y, seed).
float hash01(int x, int y, uint seed);

// Smooth noise 0..1 that repeats after `period` cells, a power of two; octaves halve in size and weight.
float noise(vec2 p, int period, uint seed);
float fractal_noise(vec2 p, int period, int octaves, uint seed);

const int kPaintingCount = 5;

vec3 wood_planks(vec2 p);           // 8 rows of staggered boards along u: a square of 1.2 m
vec3 wood_grain(vec2 p);            // one board along u, grey-brown around 0.5: multiply by a colour
vec3 plaster(vec2 p);               // almost white
vec3 fabric(vec2 p);                // 32 x 32 threads, almost white: multiply by a colour
vec3 leather(vec2 p);               // almost white
vec3 brick(vec2 p);                 // 4 x 12 bricks
vec3 marble(vec2 p);                // white with grey veins
vec3 checker(vec2 p);               // 2 x 2, light and dark
vec3 rug(vec2 p);                   // one whole rug with border and medallion
vec3 painting(vec2 p, int number);  // a picture, number < kPaintingCount
vec3 book_spine(vec2 p);            // gold bands and a title on white: multiply by a colour

}  // namespace ods
