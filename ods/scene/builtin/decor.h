// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decoration for built-in scenes: lamps, plants, books, pictures, curtains. Origins and fronts are as in furniture.h.
#pragma once
#include "ods/scene/builtin/furniture.h"

namespace ods {

void add_floor_lamp(Scene& scene, const Finishes& finishes, const glm::mat4& place);  // 1.6 high
void add_table_lamp(Scene& scene, const Finishes& finishes, const glm::mat4& place);  // 0.52 high

// A paper ball on a cord; the origin is the point where the cord meets the ceiling, `drop` metres above the ball's
// centre.
void add_lantern(Scene& scene, const Finishes& finishes, const glm::mat4& place, float drop, float radius);

// A pot with leaves on bent stems, `height` metres tall.
void add_plant(Scene& scene, const Finishes& finishes, const glm::mat4& place, float height, int leaves, uint seed);

// A row of books on a shelf of size.x by size.y by size.z, some lying flat, with an occasional vase;
// different for each seed.
void add_books(Scene& scene, const Finishes& finishes, const glm::mat4& place, vec3 size, uint seed);

// The texture of a painting from patterns.h.
int add_painting(Scene& scene, int number);

// A framed painting, centred at the origin.
void add_picture(Scene& scene, const glm::mat4& place, vec2 size, int painting, int frame);

// A curtain that hangs down from y = 0.
void add_curtain(Scene& scene, int material, const glm::mat4& place, float width, float drop, float phase);

void add_wine_and_fruit(Scene& scene, const Finishes& finishes, const glm::mat4& place);    // for the coffee table
void add_vase(Scene& scene, int material, const glm::mat4& place, float height, int form);  // form 0, 1 or 2
void add_candle(Scene& scene, const Finishes& finishes, const glm::mat4& place, float height);

}  // namespace ods
