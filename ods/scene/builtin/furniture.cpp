// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/furniture.h"

#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/decor.h"
#include "ods/scene/builtin/patterns.h"

namespace ods {

Finishes add_finishes(Scene& scene) {
  const int grain = add_texture(scene, 512, 512, wood_grain);
  const int weave = add_texture(scene, 256, 256, fabric);
  const int hide = add_texture(scene, 512, 512, leather);
  const auto wood = [&](vec3 color, float roughness) {
    return add_material(scene, textured(paint(color, roughness), grain, vec2(0.9f, 0.45f)));
  };
  const auto cloth = [&](vec3 color) { return add_material(scene, textured(paint(color, 0.95f), weave, vec2(0.1f))); };
  const auto plain = [&](vec3 color, float roughness) { return add_material(scene, paint(color, roughness)); };
  Finishes f;
  f.oak = wood(vec3(0.64f, 0.40f, 0.20f), 0.35f);
  f.walnut = wood(vec3(0.32f, 0.16f, 0.075f), 0.32f);
  f.black_wood = wood(vec3(0.05f, 0.035f, 0.028f), 0.35f);
  f.white_paint = plain(vec3(0.76f, 0.73f, 0.67f), 0.4f);
  f.sofa = cloth(vec3(0.09f, 0.26f, 0.31f));
  f.leather = add_material(scene, textured(paint(vec3(0.36f, 0.13f, 0.045f), 0.42f), hide, vec2(0.5f)));
  f.linen = cloth(vec3(0.75f, 0.66f, 0.52f));
  f.mustard = cloth(vec3(0.72f, 0.40f, 0.05f));
  f.terracotta = cloth(vec3(0.58f, 0.17f, 0.08f));
  f.cream = cloth(vec3(0.80f, 0.72f, 0.58f));
  f.sage = cloth(vec3(0.30f, 0.36f, 0.24f));
  f.brass = add_material(scene, metal(vec3(0.92f, 0.66f, 0.30f), 0.22f));
  f.iron = add_material(scene, metal(vec3(0.12f, 0.11f, 0.10f), 0.45f));
  f.ceramic = plain(vec3(0.78f, 0.74f, 0.67f), 0.18f);
  f.dark_ceramic = plain(vec3(0.04f, 0.10f, 0.14f), 0.15f);
  f.glass = add_material(scene, glass(1.5f));
  f.pages = plain(vec3(0.72f, 0.64f, 0.48f), 0.9f);
  f.leaf = plain(vec3(0.09f, 0.27f, 0.07f), 0.4f);
  f.soil = plain(vec3(0.04f, 0.025f, 0.018f), 1.0f);
  f.stem = plain(vec3(0.14f, 0.16f, 0.05f), 0.6f);
  Material light = glow(vec3(14.5f, 12.0f, 8.8f));
  f.shade = add_material(scene, light);
  light.double_sided = 0;
  f.lantern = add_material(scene, light);
  f.books = add_book_meshes(scene, f.pages);
  return f;
}

static void add_legs(Scene& scene, int material, const glm::mat4& place, vec2 half, float height, float radius) {
  const Shape leg = make_lathe({{0.0f, 0.0f}, {0.6f * radius, 0.0f}, {radius, height}, {0.0f, height}}, 20);
  const int mesh = add_mesh(scene, leg.vertices, leg.triangles, material);
  for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(1, 1)}) {
    add_instance(scene, mesh, place * placed(vec3(corner.x * half.x, 0.0f, corner.y * half.y)));
  }
}

// Two arms, a back, and seat and back cushions: the common parts of sofas and armchairs.
static void add_upholstery(Scene& scene, int material, const glm::mat4& place, vec3 size, int seats) {
  const float arm = 0.17f, back = 0.2f, base = 0.14f, seat_top = 0.32f;
  const auto part = [&](vec3 extent, vec3 center, float radius) {
    add(scene, make_rounded_box(extent, radius, 4), material, place * placed(center));
  };
  part({size.x, seat_top - base, size.z}, {0.0f, 0.5f * (base + seat_top), 0.0f}, 0.03f);
  part({size.x, size.y - base, back}, {0.0f, 0.5f * (size.y + base), 0.5f * (back - size.z)}, 0.07f);
  for (const float side : {-1.0f, 1.0f}) {
    part({arm, 0.6f - base, size.z}, {side * 0.5f * (size.x - arm), 0.5f * (0.6f + base), 0.0f}, 0.06f);
  }
  const float width = (size.x - 2.0f * arm) / float(seats), depth = size.z - back;
  for (int i = 0; i < seats; i++) {
    const float x = (float(i) - 0.5f * float(seats - 1)) * width;
    part({width - 0.01f, 0.16f, depth + 0.02f}, {x, seat_top + 0.075f, 0.5f * back + 0.01f}, 0.06f);
    const glm::mat4 lean = placed(vec3(x, 0.63f, back - 0.5f * size.z + 0.07f)) * turned(vec3(1, 0, 0), -12.0f);
    add(scene, make_rounded_box(vec3(width - 0.02f, 0.42f, 0.17f), 0.08f, 4), material, place * lean);
  }
}

void add_sofa(Scene& scene, const Finishes& f, const glm::mat4& place) {
  add_upholstery(scene, f.sofa, place, vec3(2.2f, 0.8f, 0.95f), 3);
  add_legs(scene, f.walnut, place, vec2(1.0f, 0.38f), 0.15f, 0.025f);
  struct Cushion {
    float x, z, turn, lean;
    int material;
  };
  const Cushion cushions[] = {{-0.78f, 0.02f, 16.0f, 22.0f, f.mustard},
                              {-0.52f, 0.06f, -8.0f, 28.0f, f.cream},
                              {0.80f, 0.02f, -20.0f, 24.0f, f.terracotta},
                              {0.50f, 0.07f, 6.0f, 30.0f, f.sage}};
  const Shape pillow = make_cushion(vec3(0.46f, 0.17f, 0.46f), 20);
  for (const Cushion& c : cushions) {
    add(scene, pillow, c.material,
        place * placed(vec3(c.x, 0.68f, c.z), c.turn) * turned(vec3(1, 0, 0), 90.0f - c.lean) *
            turned(vec3(0, 1, 0), c.turn * 0.5f));
  }
  // A throw over the left arm, hanging down on both sides.
  const Shape blanket = make_surface(24, 40, vec2(0.55f, 1.2f), [](float s, float t) {
    const float along = 1.3f * (t - 0.5f), top = 0.09f;
    const float over = max(std::abs(along) - top, 0.0f);
    const float x = along < 0.0f ? -min(-along, top + 0.012f) : min(along, top + 0.012f);
    return vec3(x + 0.006f * sin(19.0f * s) * over, 0.612f - over + 0.004f * sin(25.0f * s + 9.0f * t),
                0.55f * (0.5f - s) + 0.02f * sin(8.0f * t));
  });
  add(scene, blanket, f.cream, place * placed(vec3(-1.015f, 0.0f, 0.12f)));
}

void add_armchair(Scene& scene, const Finishes& f, int cover, int cushion, const glm::mat4& place) {
  add_upholstery(scene, cover, place, vec3(0.88f, 0.88f, 0.86f), 1);
  add_legs(scene, f.black_wood, place, vec2(0.36f, 0.34f), 0.15f, 0.022f);
  add(scene, make_cushion(vec3(0.4f, 0.15f, 0.4f), 20), cushion,
      place * placed(vec3(0.03f, 0.62f, 0.02f)) * turned(vec3(1, 0, 0), 64.0f));
}

void add_coffee_table(Scene& scene, const Finishes& f, const glm::mat4& place) {
  add(scene, make_rounded_box(vec3(1.2f, 0.035f, 0.6f), 0.012f, 3), f.oak, place * placed(vec3(0.0f, 0.3825f, 0.0f)));
  add(scene, make_rounded_box(vec3(1.05f, 0.02f, 0.46f), 0.006f, 2), f.oak, place * placed(vec3(0.0f, 0.14f, 0.0f)));
  add_legs(scene, f.oak, place, vec2(0.52f, 0.23f), 0.37f, 0.024f);
}

void add_side_table(Scene& scene, const Finishes& f, const glm::mat4& place) {
  const Shape top = make_lathe({{0.0f, 0.525f},
                                {0.215f, 0.525f},
                                {0.224f, 0.531f},
                                {0.226f, 0.54f},
                                {0.22f, 0.549f},
                                {0.21f, 0.55f},
                                {0.0f, 0.55f}},
                               64);
  add(scene, mapped_from_above(top), f.walnut, place);
  const Shape foot = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                {0.15f, 0.0f},
                                                {0.152f, 0.012f},
                                                {0.04f, 0.03f},
                                                {0.018f, 0.08f},
                                                {0.016f, 0.46f},
                                                {0.05f, 0.525f},
                                                {0.0f, 0.526f}},
                                               5),
                                40);
  add(scene, foot, f.brass, place);
}

void add_dining_table(Scene& scene, const Finishes& f, const glm::mat4& place) {
  const Shape top = make_lathe({{0.0f, 0.705f},
                                {0.52f, 0.705f},
                                {0.545f, 0.718f},
                                {0.55f, 0.728f},
                                {0.545f, 0.737f},
                                {0.535f, 0.74f},
                                {0.0f, 0.74f}},
                               96);
  add(scene, mapped_from_above(top), f.oak, place);
  const Shape foot = make_lathe(smooth_profile({{0.0f, 0.0f},
                                                {0.30f, 0.0f},
                                                {0.305f, 0.02f},
                                                {0.12f, 0.05f},
                                                {0.055f, 0.14f},
                                                {0.05f, 0.5f},
                                                {0.09f, 0.66f},
                                                {0.2f, 0.704f},
                                                {0.0f, 0.706f}},
                                               6),
                                64);
  add(scene, foot, f.oak, place);
}

void add_chair(Scene& scene, const Finishes& f, const glm::mat4& place) {
  add(scene, make_rounded_box(vec3(0.44f, 0.05f, 0.43f), 0.02f, 3), f.sage, place * placed(vec3(0.0f, 0.455f, 0.0f)));
  add_legs(scene, f.walnut, place, vec2(0.18f, 0.18f), 0.44f, 0.02f);
  Shape back;
  for (const float side : {-1.0f, 1.0f}) {
    append(back,
           make_tube({{side * 0.19f, 0.43f, -0.19f}, {side * 0.195f, 0.65f, -0.205f}, {side * 0.2f, 0.87f, -0.25f}},
                     0.014f, 12));
  }
  for (const float height : {0.62f, 0.73f, 0.84f}) {
    std::vector<vec3> rail;
    for (int i = 0; i <= 12; i++) {
      const float s = float(i) / 6.0f - 1.0f;
      rail.push_back({0.195f * s, height, -0.205f - 0.18f * (height - 0.62f) - 0.035f * (1.0f - s * s)});
    }
    append(back, make_tube(rail, 0.013f, 12));
  }
  add(scene, back, f.walnut, place);
}

void add_sideboard(Scene& scene, const Finishes& f, const glm::mat4& place) {
  add(scene, make_rounded_box(vec3(1.8f, 0.56f, 0.44f), 0.012f, 2), f.walnut, place * placed(vec3(0.0f, 0.46f, 0.0f)));
  add_legs(scene, f.walnut, place, vec2(0.8f, 0.16f), 0.2f, 0.022f);
  for (int i = 0; i < 4; i++) {
    const float x = 0.44f * (float(i) - 1.5f);
    add(scene, make_rounded_box(vec3(0.42f, 0.5f, 0.02f), 0.006f, 2), f.walnut, place * placed(vec3(x, 0.46f, 0.222f)));
    const float side = i % 2 == 0 ? 0.17f : -0.17f;
    add(scene, make_sphere(0.013f, 20), f.brass, place * placed(vec3(x + side, 0.5f, 0.245f)));
  }
}

void add_bookcase(Scene& scene, const Finishes& f, const glm::mat4& place, uint seed) {
  const float width = 0.95f, depth = 0.32f, height = 2.2f, board = 0.028f;
  const auto part = [&](vec3 size, vec3 center) {
    add(scene, make_rounded_box(size, 0.004f, 1), f.walnut, place * placed(center));
  };
  for (const float side : {-1.0f, 1.0f})
    part({board, height, depth}, {side * 0.5f * (width - board), 0.5f * height, 0.0f});
  part({width, height, 0.012f}, {0.0f, 0.5f * height, -0.5f * depth});
  part({width + 0.03f, 0.04f, depth + 0.03f}, {0.0f, height + 0.01f, 0.0f});
  part({width - board, 0.1f, depth - 0.02f}, {0.0f, 0.05f, -0.01f});
  const int shelves = 6;
  const float first = 0.12f, gap = (height - first) / float(shelves);
  for (int i = 0; i < shelves; i++) {
    const float y = first + gap * float(i);
    part({width - 2.0f * board, board, depth - 0.02f}, {0.0f, y - 0.5f * board, -0.005f});
    add_books(scene, f, place * placed(vec3(0.0f, y + 0.0005f, 0.0f)), vec3(width - 2.0f * board, gap - board, depth),
              seed * 16u + uint(i));
  }
}

}  // namespace ods
