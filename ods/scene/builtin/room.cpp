// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// "room": a living room at dusk. Warm lamps, a fire, cool light from the window; the viewer stands in the middle.
#include <cmath>

#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/decor.h"
#include "ods/scene/builtin/furniture.h"
#include "ods/scene/builtin/makers.h"
#include "ods/scene/builtin/patterns.h"

namespace ods {

// Inner faces of the walls.
static const float kLeftWall = -3.2f, kRightWall = 3.2f, kFrontWall = -3.0f, kBackWall = 2.8f, kCeiling = 2.75f;

namespace {

struct Opening {
  float left, right, bottom, top;
};

}  // namespace

static const Opening kWindow = {-1.25f, 1.25f, 0.88f, 2.38f};
static const Opening kFireplace = {-0.42f, 0.42f, 0.05f, 0.72f};
static const vec3 kHearth(2.86f, 0.0f, 0.15f);  // middle of the chimney's foot

static void add_block(Scene& scene, int material, const glm::mat4& place, vec3 low, vec3 high) {
  add(scene, make_box(high - low), material, place * placed(0.5f * (low + high)));
}

// A wall whose inner face is z = 0 of its own frame, the room towards +Z, around one opening.
static void add_wall(Scene& scene, int material, const glm::mat4& place, float width, float depth, Opening gap) {
  const float half = 0.5f * width;
  add_block(scene, material, place, {-half, 0.0f, -depth}, {gap.left, kCeiling, 0.0f});
  add_block(scene, material, place, {gap.right, 0.0f, -depth}, {half, kCeiling, 0.0f});
  add_block(scene, material, place, {gap.left, gap.top, -depth}, {gap.right, kCeiling, 0.0f});
  if (gap.bottom > 0.0f) add_block(scene, material, place, {gap.left, 0.0f, -depth}, {gap.right, gap.bottom, 0.0f});
}

static glm::mat4 on_front_wall(float x, float y) {
  return placed(vec3(x, y, kFrontWall));
}
static glm::mat4 on_back_wall(float x, float y) {
  return placed(vec3(x, y, kBackWall), 180.0f);
}
static glm::mat4 on_left_wall(float z, float y) {
  return placed(vec3(kLeftWall, y, z), -90.0f);
}
static glm::mat4 on_right_wall(float z, float y) {
  return placed(vec3(kRightWall, y, z), 90.0f);
}

static void add_shell(Scene& scene, const Finishes& f) {
  const int planks = add_texture(scene, 768, 768, wood_planks);
  const int rough = add_texture(scene, 512, 512, plaster);
  const int wall = add_material(scene, textured(paint(vec3(0.62f, 0.63f, 0.54f), 0.9f), rough, vec2(2.0f)));
  const int ceiling = add_material(scene, textured(paint(vec3(0.88f, 0.85f, 0.79f), 0.95f), rough, vec2(2.0f)));
  const int floor = add_material(scene, textured(paint(vec3(1.0f), 0.32f), planks, vec2(1.4f, 1.12f)));
  const float width = kRightWall - kLeftWall, depth = kBackWall - kFrontWall, middle = 0.5f * (kBackWall + kFrontWall);
  add(scene, make_floor(width + 0.4f, depth + 0.4f), floor, placed(vec3(0.0f, 0.0f, middle)));
  add_block(scene, ceiling, glm::mat4(1.0f), {kLeftWall - 0.3f, kCeiling, kFrontWall - 0.3f},
            {kRightWall + 0.3f, kCeiling + 0.1f, kBackWall + 0.3f});
  add_wall(scene, wall, on_front_wall(0.0f, 0.0f), width + 0.6f, 0.28f, kWindow);
  const auto solid = [&](const glm::mat4& place, float length) {
    add_block(scene, wall, place, {-0.5f * length - 0.3f, 0.0f, -0.2f}, {0.5f * length + 0.3f, kCeiling, 0.0f});
    add(scene, make_rounded_box(vec3(length, 0.13f, 0.036f), 0.012f, 2), f.white_paint,
        place * placed(vec3(0.0f, 0.065f, 0.0f)));
    const Shape cornice = make_prism({{0.0f, 0.0f},
                                      {0.0f, -0.10f},
                                      {0.018f, -0.10f},
                                      {0.018f, -0.075f},
                                      {0.05f, -0.035f},
                                      {0.09f, -0.015f},
                                      {0.09f, 0.0f}},
                                     length);
    add(scene, cornice, f.white_paint, place * placed(vec3(0.0f, kCeiling, 0.0f)) * turned(vec3(0, 1, 0), -90.0f));
  };
  solid(on_back_wall(0.0f, 0.0f), width);
  solid(on_left_wall(middle, 0.0f), depth);
  solid(on_right_wall(middle, 0.0f), depth);
  add(scene, make_rounded_box(vec3(width, 0.13f, 0.036f), 0.012f, 2), f.white_paint, on_front_wall(0.0f, 0.065f));
  for (int i = 0; i < 4; i++) {
    const float z = mix(kFrontWall + 0.75f, kBackWall - 0.65f, float(i) / 3.0f);
    add(scene, make_rounded_box(vec3(width, 0.17f, 0.14f), 0.014f, 2), f.walnut,
        placed(vec3(0.0f, kCeiling - 0.08f, z)));
  }
}

static void add_window(Scene& scene, const Finishes& f) {
  const float width = kWindow.right - kWindow.left, height = kWindow.top - kWindow.bottom,
              y = 0.5f * (kWindow.top + kWindow.bottom);
  Shape frame;
  const auto bar = [&](vec3 size, vec3 at) {
    append(frame, transformed(make_rounded_box(size, 0.006f, 2), placed(at)));
  };
  for (const float x : {-0.5f, -1.0f / 6.0f, 1.0f / 6.0f, 0.5f}) bar({0.05f, height, 0.06f}, {x * width, 0.0f, -0.17f});
  for (const float side : {-0.5f, 0.18f, 0.5f}) bar({width, 0.05f, 0.056f}, {0.0f, side * height, -0.17f});
  for (const float side : {-0.5f, 0.5f}) bar({0.09f, height + 0.18f, 0.04f}, {side * (width + 0.09f), 0.0f, 0.0f});
  bar({width + 0.18f, 0.10f, 0.044f}, {0.0f, 0.5f * (height + 0.09f), 0.0f});
  bar({width + 0.24f, 0.04f, 0.34f}, {0.0f, -0.5f * height - 0.01f, -0.06f});
  add(scene, frame, f.white_paint, on_front_wall(0.0f, y));
  add(scene, make_tube({{-1.95f, 2.5f, 0.12f}, {1.95f, 2.5f, 0.12f}}, 0.013f, 16), f.brass, on_front_wall(0.0f, 0.0f));
  for (const float side : {-1.0f, 1.0f}) {
    add(scene, make_sphere(0.028f, 24), f.brass, on_front_wall(side * 1.97f, 2.5f) * placed(vec3(0.0f, 0.0f, 0.12f)));
    add_curtain(scene, f.linen, on_front_wall(side * 1.57f, 2.49f) * placed(vec3(0.0f, 0.0f, 0.12f)), 0.68f, 2.45f,
                side);
  }
  const glm::mat4 sill = on_front_wall(0.0f, kWindow.bottom + 0.012f) * placed(vec3(0.0f, 0.0f, -0.03f));
  add_plant(scene, f, sill * placed(vec3(-0.85f, 0.0f, 0.0f)), 0.28f, 16, 4u);
  add_plant(scene, f, sill * placed(vec3(0.95f, 0.0f, 0.0f)), 0.22f, 14, 7u);
  add_vase(scene, f.dark_ceramic, sill * placed(vec3(0.62f, 0.0f, 0.0f)), 0.2f, 2);
}

// Flames: a few facets each, so that the fire costs few emissive triangles.
static void add_fire(Scene& scene, const glm::mat4& place) {
  const int bark = add_material(scene, paint(vec3(0.06f, 0.035f, 0.022f), 0.95f));
  const int flame = add_material(scene, glow(vec3(13.0f, 4.6f, 0.9f)));
  const int ember = add_material(scene, glow(vec3(3.0f, 0.5f, 0.05f)));
  const vec3 logs[][2] = {{{-0.28f, 0.09f, -0.12f}, {0.26f, 0.08f, -0.10f}},
                          {{-0.24f, 0.08f, -0.26f}, {0.28f, 0.10f, -0.24f}},
                          {{-0.2f, 0.17f, -0.26f}, {0.22f, 0.19f, -0.10f}}};
  for (const auto& log : logs) add(scene, make_tube({log[0], log[1]}, 0.05f, 14), bark, place);
  add(scene, make_disc(0.2f, 8), ember, place * placed(vec3(0.0f, 0.055f, -0.18f), 0.0f, vec3(1.4f, 1.0f, 0.5f)));
  const Shape tongue = make_lathe({{0.0f, 0.0f}, {0.55f, 0.12f}, {0.5f, 0.3f}, {0.22f, 0.68f}, {0.0f, 1.0f}}, 5);
  const vec4 tongues[] = {{-0.15f, 0.14f, -0.19f, 0.20f}, {0.0f, 0.16f, -0.2f, 0.30f}, {0.12f, 0.14f, -0.17f, 0.22f}};
  for (const vec4& t : tongues)
    add(scene, tongue, flame, place * placed(vec3(t), 40.0f * t.w, vec3(0.3f * t.w, t.w, 0.3f * t.w)));
}

static void add_fireplace(Scene& scene, const Finishes& f) {
  const glm::mat4 face = placed(kHearth, 90.0f);
  const int bricks = add_texture(scene, 512, 512, brick);
  const int veins = add_texture(scene, 512, 512, marble);
  const int clay = add_material(scene, textured(paint(vec3(1.0f), 0.9f), bricks, vec2(0.96f, 0.96f)));
  const int stone = add_material(scene, textured(paint(vec3(1.0f), 0.2f), veins, vec2(0.9f)));
  const int silver = add_material(scene, metal(vec3(0.93f), 0.0f));
  const float depth = kRightWall - kHearth.x;
  add_wall(scene, clay, face, 1.9f, depth, kFireplace);
  add_block(scene, clay, face, {-0.45f, 0.0f, -depth - 0.01f}, {0.45f, 0.8f, -depth + 0.02f});
  Shape surround;
  for (const float side : {-1.0f, 1.0f})
    append(surround, transformed(make_rounded_box(vec3(0.17f, 0.98f, 0.09f), 0.012f, 2),
                                 placed(vec3(side * 0.515f, 0.49f, 0.03f))));
  append(surround,
         transformed(make_rounded_box(vec3(1.2f, 0.24f, 0.088f), 0.012f, 2), placed(vec3(0.0f, 0.85f, 0.03f))));
  append(surround,
         transformed(make_rounded_box(vec3(1.5f, 0.05f, 0.42f), 0.012f, 2), placed(vec3(0.0f, 0.025f, 0.2f))));
  add(scene, surround, stone, face);
  add(scene, make_rounded_box(vec3(1.5f, 0.06f, 0.24f), 0.012f, 2), f.walnut, face * placed(vec3(0.0f, 1.02f, 0.10f)));
  add_fire(scene, face * placed(vec3(0.0f, 0.0f, 0.02f)));
  const glm::mat4 above = face * placed(vec3(0.0f, 1.68f, 0.03f)) * turned(vec3(1, 0, 0), 90.0f);
  add(scene, make_disc(0.38f, 96), silver, above);
  add(scene, make_torus(0.385f, 0.022f, 96, 16), f.brass, above);
  const glm::mat4 mantel = face * placed(vec3(0.0f, 1.051f, 0.10f));
  add_candle(scene, f, mantel * placed(vec3(-0.62f, 0.0f, 0.0f)), 0.30f);
  add_candle(scene, f, mantel * placed(vec3(-0.50f, 0.0f, 0.03f)), 0.22f);
  add_vase(scene, f.ceramic, mantel * placed(vec3(0.48f, 0.0f, 0.0f)), 0.24f, 0);
  add_vase(scene, f.brass, mantel * placed(vec3(0.63f, 0.0f, 0.02f)), 0.14f, 1);
}

static void add_door(Scene& scene, const Finishes& f) {
  const glm::mat4 place = on_back_wall(0.3f, 0.0f);
  const auto bar = [](vec3 size, vec3 at, float radius) {
    return transformed(make_rounded_box(size, radius, 2), placed(at));
  };
  Shape leaf = bar({0.86f, 2.06f, 0.04f}, {0.0f, 1.035f, 0.005f}, 0.004f);
  for (const float side : {-0.2f, 0.2f}) {
    append(leaf, bar({0.3f, 0.86f, 0.03f}, {side, 1.5f, 0.026f}, 0.014f));
    append(leaf, bar({0.3f, 0.74f, 0.03f}, {side, 0.55f, 0.026f}, 0.014f));
  }
  add(scene, leaf, add_material(scene, paint(vec3(0.07f, 0.13f, 0.12f), 0.35f)), place);
  Shape casing = bar({1.09f, 0.1f, 0.07f}, {0.0f, 2.13f, 0.01f}, 0.01f);
  for (const float side : {-0.48f, 0.48f}) append(casing, bar({0.09f, 2.12f, 0.06f}, {side, 1.06f, 0.01f}, 0.01f));
  add(scene, casing, f.white_paint, place);
  add(scene, make_sphere(0.03f, 32), f.brass, place * placed(vec3(0.36f, 1.0f, 0.085f)));
  add(scene, make_cylinder(0.012f, 0.07f, 20), f.brass,
      place * placed(vec3(0.36f, 1.0f, 0.05f)) * turned(vec3(1, 0, 0), 90.0f));
}

static void add_seating(Scene& scene, const Finishes& f) {
  const int pile = add_texture(scene, 1200, 800, rug);
  const int rug_material = add_material(scene, textured(paint(vec3(1.0f), 1.0f), pile, vec2(2.9f, 2.0f)));
  add(scene, make_rounded_box(vec3(2.9f, 0.014f, 2.0f), 0.006f, 1), rug_material, placed(vec3(0.0f, 0.007f, -1.2f)));
  add_sofa(scene, f, placed(vec3(0.0f, 0.0f, -2.42f)));
  const glm::mat4 coffee = placed(vec3(0.0f, 0.014f, -1.2f));
  add_coffee_table(scene, f, coffee);
  add_wine_and_fruit(scene, f, coffee * placed(vec3(0.0f, 0.4003f, 0.0f)));
  add_armchair(scene, f, f.leather, f.linen, placed(vec3(2.05f, 0.0f, -1.45f), 58.0f));
  add_floor_lamp(scene, f, placed(vec3(-1.5f, 0.0f, -2.5f)));
  add_lantern(scene, f, placed(vec3(0.0f, kCeiling, -1.45f)), 0.5f, 0.2f);
  const glm::mat4 side = placed(vec3(1.46f, 0.0f, -2.5f));
  add_side_table(scene, f, side);
  add_table_lamp(scene, f, side * placed(vec3(0.0f, 0.55f, 0.0f)));
  add_plant(scene, f, placed(vec3(-2.6f, 0.0f, -2.45f)), 1.55f, 22, 2u);
  add_plant(scene, f, placed(vec3(2.7f, 0.0f, -2.5f)), 1.2f, 18, 3u);
}

static void add_library_and_dining(Scene& scene, const Finishes& f) {
  for (int i = 0; i < 3; i++)
    add_bookcase(scene, f, on_left_wall(-1.4f + 0.96f * float(i), 0.0f) * placed(vec3(0.0f, 0.0f, 0.17f)),
                 uint(i) + 1u);
  add_plant(scene, f, placed(vec3(-3.0f, 2.24f, -1.4f)), 0.3f, 18, 11u);
  add_vase(scene, f.ceramic, placed(vec3(-3.0f, 2.24f, -0.35f)), 0.24f, 1);
  add_vase(scene, f.terracotta, placed(vec3(-3.0f, 2.24f, 0.5f)), 0.2f, 2);
  add_armchair(scene, f, f.sage, f.terracotta, placed(vec3(-2.25f, 0.0f, 1.35f), -125.0f));
  add_floor_lamp(scene, f, placed(vec3(-2.75f, 0.0f, 2.0f)));
  const glm::mat4 table = placed(vec3(1.95f, 0.0f, 1.65f));
  add_dining_table(scene, f, table);
  for (const float yaw : {20.0f, 140.0f, 255.0f})
    add_chair(scene, f, table * placed(vec3(0.0f), yaw) * placed(vec3(0.0f, 0.0f, -0.62f)));
  add_plant(scene, f, table * placed(vec3(0.05f, 0.74f, -0.05f)), 0.26f, 16, 9u);
  add_lantern(scene, f, placed(vec3(1.95f, kCeiling, 1.65f)), 0.95f, 0.25f);
  const glm::mat4 sideboard = placed(vec3(-1.35f, 0.0f, kBackWall - 0.25f), 180.0f);
  add_sideboard(scene, f, sideboard);
  const glm::mat4 top = sideboard * placed(vec3(0.0f, 0.7403f, 0.0f));
  add_table_lamp(scene, f, top * placed(vec3(0.62f, 0.0f, 0.0f)));
  add_vase(scene, f.terracotta, top * placed(vec3(-0.55f, 0.0f, -0.02f)), 0.34f, 0);
  add_vase(scene, f.dark_ceramic, top * placed(vec3(-0.32f, 0.0f, 0.04f)), 0.2f, 2);
  add_books(scene, f, top * placed(vec3(0.05f, 0.0f, 0.0f)), vec3(0.42f, 0.27f, 0.25f), 77u);
  add_plant(scene, f, placed(vec3(-0.28f, 0.0f, 2.5f)), 0.9f, 18, 6u);
}

static void add_pictures(Scene& scene, const Finishes& f) {
  struct Hung {
    glm::mat4 wall;
    vec2 size;
    int painting, frame;
  };
  const Hung pictures[] = {
      {on_back_wall(-1.35f, 1.62f), {1.1f, 0.8f}, 0, f.brass},
      {on_back_wall(2.1f, 1.6f), {0.62f, 0.8f}, 4, f.black_wood},
      {on_back_wall(1.3f, 1.6f), {0.62f, 0.8f}, 1, f.black_wood},
      {on_left_wall(1.75f, 1.65f), {0.95f, 0.7f}, 2, f.oak},
      {on_right_wall(2.0f, 1.6f), {0.7f, 0.9f}, 3, f.oak},
      {on_right_wall(-1.75f, 1.6f), {0.9f, 0.68f}, 2, f.brass},
      {on_front_wall(-2.55f, 1.75f), {0.55f, 0.72f}, 3, f.walnut},
      {on_front_wall(2.55f, 1.7f), {0.55f, 0.72f}, 1, f.walnut},
  };
  const glm::mat4 off_the_wall = placed(vec3(0.0f, 0.0f, 0.012f));
  int paintings[kPaintingCount];
  for (int i = 0; i < kPaintingCount; i++) paintings[i] = add_painting(scene, i);
  for (const Hung& p : pictures) add_picture(scene, p.wall * off_the_wall, p.size, paintings[p.painting], p.frame);
}

// The last light behind hills, a town's lamps below them, stars above. Only the part visible through the window is
// bright, so that a renderer that samples the sky sends its rays through the window.
static vec3 dusk(vec3 d) {
  const float azimuth = std::atan2(d.x, -d.z), height = d.y;
  const float ridge = 0.01f + 0.13f * noise(vec2(azimuth * 3.0f + 32.0f, 0.5f), 64, 5u) +
                      0.035f * noise(vec2(azimuth * 11.0f + 64.0f, 0.5f), 128, 6u);
  const float facing = smoothstep(0.0f, 0.35f, -d.z);
  if (height < ridge) {
    const vec2 street = floor(vec2(azimuth, height) * 163.0f);
    const bool lit = hash01(static_cast<int>(street.x), static_cast<int>(street.y), 8u) > 0.982f &&
                     height < 0.7f * ridge && height > -0.22f;
    const vec3 ground = mix(vec3(0.012f, 0.013f, 0.02f), vec3(0.05f, 0.04f, 0.06f), smoothstep(-0.1f, ridge, height));
    return facing * (lit ? vec3(1.6f, 1.0f, 0.45f) * hash01(static_cast<int>(street.y), static_cast<int>(street.x), 10u)
                         : ground);
  }
  const float t = clamp((height - ridge) / 0.65f, 0.0f, 1.0f);
  vec3 sky = mix(vec3(1.05f, 0.42f, 0.14f), vec3(0.34f, 0.20f, 0.32f), smoothstep(0.0f, 0.22f, t));
  sky = mix(sky, vec3(0.035f, 0.07f, 0.20f), smoothstep(0.1f, 0.75f, t));
  const float cloud = fractal_noise(vec2(azimuth * 2.0f + 16.0f, height * 14.0f + 16.0f), 64, 5, 9u);
  sky = mix(sky, vec3(0.75f, 0.24f, 0.16f),
            0.75f * smoothstep(0.52f, 0.75f, cloud) * (1.0f - smoothstep(0.15f, 0.6f, t)));
  return facing * sky;
}

Scene make_room() {
  Scene scene;
  const Finishes f = add_finishes(scene);
  add_shell(scene, f);
  add_window(scene, f);
  add_fireplace(scene, f);
  add_door(scene, f);
  add_seating(scene, f);
  add_library_and_dining(scene, f);
  add_pictures(scene, f);
  scene.environment = make_environment(1024, dusk);
  scene.view_points = {{"standing", vec3(0.0f, 1.5f, 0.1f)}};
  return scene;
}

}  // namespace ods
