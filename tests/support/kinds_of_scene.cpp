// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/kinds_of_scene.h"

#include <cmath>

#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/decor.h"
#include "ods/scene/builtin/patterns.h"
#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

const glm::mat4 kHere(1.0f);

Scene make_dining_chair() {
  Scene scene;
  add_chair(scene, add_finishes(scene), kHere);
  return scene;
}

// 2.2 cm wide, with a stone.
Scene make_ring() {
  Scene scene;
  const int gold = add_material(scene, metal(vec3(1.0f, 0.76f, 0.34f), 0.12f));
  const int stone = add_material(scene, glass(1.76f));
  Material& ruby = scene.materials.back();
  ruby.attenuation_color = vec3(0.75f, 0.02f, 0.06f), ruby.attenuation_distance = 0.004f;
  add(scene, make_torus(0.010f, 0.0013f, 96, 24), gold, placed(vec3(0, 0.0113f, 0)) * turned(vec3(1, 0, 0), 90.0f));
  add(scene, make_lathe({{0, -0.0024f}, {0.0035f, 0.0004f}, {0.0022f, 0.0018f}, {0, 0.0018f}}, 12), stone,
      placed(vec3(0, 0.0251f, 0)));
  add(scene, make_torus(0.0034f, 0.0005f, 48, 12), gold, placed(vec3(0, 0.0250f, 0)));
  add(scene,
      make_lathe({{0, 0}, {0.0012f, 0}, {0.0034f, 0.0026f}, {0.0031f, 0.0026f}, {0.0009f, 0.0004f}, {0, 0.0004f}}, 48),
      gold, placed(vec3(0, 0.0224f, 0)));
  return scene;
}

// 40 m high.
Scene make_lighthouse() {
  Scene scene;
  const int stripes = add_texture(
      scene, 8, 64, [](vec2 p) { return p.y < 0.5f ? vec3(0.75f, 0.06f, 0.04f) : vec3(0.85f, 0.84f, 0.8f); });
  const int tower = add_material(scene, textured(paint(vec3(1.0f), 0.5f), stripes, vec2(8.0f, 12.0f)));
  const int rock = add_material(scene, paint(vec3(0.23f, 0.21f, 0.19f), 0.9f));
  const int iron = add_material(scene, metal(vec3(0.12f), 0.4f));
  const int pane = add_material(scene, glass(1.5f));
  add(scene, make_lathe({{0, 0}, {9, 0}, {8, 1.5f}, {6.2f, 2.2f}, {5.4f, 3.4f}, {0, 3.4f}}, 9), rock);
  add(scene, make_lathe({{0, 3.4f}, {4, 3.4f}, {3.3f, 16}, {2.8f, 31}, {0, 31}}, 64), tower);
  add(scene, make_cylinder(3.6f, 0.5f, 64), iron, placed(vec3(0, 31.2f, 0)));
  add(scene, make_cylinder(2.0f, 4.0f, 48), pane, placed(vec3(0, 33.5f, 0)));
  add(scene, make_cone(2.6f, 2.6f, 48), tower, placed(vec3(0, 35.5f, 0)));
  for (int i = 0; i < 24; i++) {
    const float a = 2.0f * kPi * static_cast<float>(i) / 24.0f;
    add(scene, make_cylinder(0.06f, 1.1f, 8), iron, placed(vec3(3.4f * std::cos(a), 32.0f, 3.4f * std::sin(a))));
  }
  add(scene, make_torus(3.4f, 0.08f, 64, 8), iron, placed(vec3(0, 32.55f, 0)));
  return scene;
}

// A still life of several objects on the ground.
Scene make_still_life() {
  Scene scene;
  const Finishes f = add_finishes(scene);
  const int chrome = add_material(scene, metal(vec3(0.9f), 0.05f));
  const int copper = add_material(scene, metal(vec3(0.95f, 0.6f, 0.46f), 0.3f));
  const int plastic = add_material(scene, paint(vec3(0.02f, 0.28f, 0.6f), 0.15f));
  const int check = add_texture(scene, 64, 64, checker);
  const int ball = add_material(scene, textured(paint(vec3(1.0f), 0.4f), check, vec2(0.2f)));
  add_vase(scene, f.dark_ceramic, placed(vec3(-0.35f, 0, -0.15f)), 0.55f, 0);
  add_vase(scene, f.ceramic, placed(vec3(0.38f, 0, -0.25f)), 0.4f, 1);
  add(scene, make_sphere(0.16f, 64), chrome, placed(vec3(0.02f, 0.16f, -0.1f)));
  add(scene, make_sphere(0.09f, 48), plastic, placed(vec3(-0.12f, 0.09f, 0.2f)));
  add(scene, make_torus(0.09f, 0.035f, 48, 24), copper, placed(vec3(0.28f, 0.035f, 0.15f)));
  add(scene, make_rounded_box(vec3(0.2f), 0.02f, 3), ball, placed(vec3(0.52f, 0.1f, 0.02f), 30.0f));
  add_candle(scene, f, placed(vec3(-0.5f, 0, 0.12f)), 0.22f);
  return scene;
}

void add_hollow_glass(Scene& scene, int material, const std::vector<vec2>& outside, float wall, vec3 at) {
  std::vector<vec2> profile = outside;
  profile.insert(profile.begin(), vec2(0.0f, outside.front().y));
  for (auto point = outside.rbegin(); point != outside.rend(); ++point) {
    profile.push_back({point->x - wall, std::max(point->y, outside.front().y + 2.0f * wall)});
  }
  profile.push_back({0.0f, outside.front().y + 2.0f * wall});
  add(scene, make_lathe(profile, 72), material, placed(at));
}

// A bottle and two tumblers.
Scene make_glasses() {
  Scene scene;
  const int clear = add_material(scene, glass(1.5f)), green = add_material(scene, glass(1.5f));
  scene.materials.back().attenuation_color = vec3(0.2f, 0.6f, 0.25f);
  scene.materials.back().attenuation_distance = 0.006f;
  add_hollow_glass(scene, green, {{0.037f, 0.0f}, {0.038f, 0.18f}, {0.03f, 0.215f}, {0.014f, 0.245f}, {0.0135f, 0.3f}},
                   0.003f, vec3(0, 0, -0.04f));
  for (const float x : {-0.11f, 0.1f}) {
    add_hollow_glass(scene, clear, {{0.032f, 0.0f}, {0.038f, 0.1f}}, 0.003f, vec3(x, 0, 0.05f));
  }
  return scene;
}

struct RoomLook {
  bool lamps = false;
  bool window = false;  // a small one
  bool pictures = true;
  bool thick = true;  // walls with an outside
};

// 5.2 x 2.6 x 4.4 m with furniture.
Scene make_living_room(const RoomLook& look) {
  Scene scene;
  const Finishes f = add_finishes(scene);
  const int boards = add_texture(scene, 512, 512, wood_planks), rough = add_texture(scene, 256, 256, plaster);
  const int floor = add_material(scene, textured(paint(vec3(1.0f), 0.4f), boards, vec2(1.4f, 1.12f)));
  const int wall = add_material(scene, textured(paint(vec3(0.66f, 0.66f, 0.58f), 0.9f), rough, vec2(2.0f)));
  const int ceiling = add_material(scene, paint(vec3(0.85f), 0.9f));
  const vec3 half(2.6f, 2.6f, 2.2f);
  const auto slab = [&](int material, vec3 low, vec3 high) { add_block(scene, low, high, material); };
  if (look.thick) {
    slab(floor, {-2.8f, -0.2f, -2.4f}, {2.8f, 0, 2.4f});
    slab(ceiling, {-2.8f, 2.6f, -2.4f}, {2.8f, 2.8f, 2.4f});
    slab(wall, {-2.8f, 0, -2.4f}, {2.8f, 2.6f, -2.2f});
    slab(wall, {-2.8f, 0, 2.2f}, {2.8f, 2.6f, 2.4f});
    slab(wall, {-2.8f, 0, -2.2f}, {-2.6f, 2.6f, 2.2f});
  } else {
    add(scene, make_floor(5.2f, 4.4f), floor, placed(vec3(0, 0.002f, 0)));
    add(scene, inside_out(make_box(vec3(5.2f, 2.6f, 4.4f))), wall, placed(vec3(0, 1.3f, 0)));
    scene.materials[static_cast<size_t>(wall)].double_sided = 0;
    scene.materials[static_cast<size_t>(floor)].double_sided = 0;
  }
  if (look.window) {
    slab(wall, {2.6f, 0, -2.2f}, {2.8f, 2.6f, -0.4f});
    slab(wall, {2.6f, 0, 0.4f}, {2.8f, 2.6f, 2.2f});
    slab(wall, {2.6f, 0, -0.4f}, {2.8f, 1.1f, 0.4f});
    slab(wall, {2.6f, 2.0f, -0.4f}, {2.8f, 2.6f, 0.4f});
  } else if (look.thick) {
    slab(wall, {2.6f, 0, -2.2f}, {2.8f, 2.6f, 2.2f});
  }
  add_sofa(scene, f, placed(vec3(0, 0, -1.7f)));
  add_coffee_table(scene, f, placed(vec3(0, 0, -0.6f)));
  add_wine_and_fruit(scene, f, placed(vec3(0, 0.4f, -0.6f)));
  add_bookcase(scene, f, placed(vec3(-2.4f, 0, 0.4f), -90.0f), 3u);
  add_armchair(scene, f, f.leather, f.cream, placed(vec3(1.9f, 0, 1.3f), 125.0f));
  add_plant(scene, f, placed(vec3(-2.2f, 0, -1.8f)), 1.1f, 24, 5u);
  if (look.pictures) {
    add_picture(scene, placed(vec3(-0.6f, 1.6f, -2.18f)), vec2(0.7f, 0.5f), 1, f.black_wood);
    add_picture(scene, placed(vec3(0.6f, 1.6f, -2.18f)), vec2(0.7f, 0.5f), 3, f.black_wood);
  }
  if (look.lamps) {
    add_floor_lamp(scene, f, placed(vec3(2.2f, 0, -1.7f)));
    add_lantern(scene, f, placed(vec3(0, half.y, 0.9f)), 0.5f, 0.2f);
  }
  return scene;
}

Scene make_lit_room() {
  return make_living_room({.lamps = true});
}

Scene make_dark_room() {
  return make_living_room({});
}

Scene make_room_with_a_small_window() {
  return make_living_room({.window = true, .pictures = false});
}

// A room of 5.2 mm: it is in kilometres.
Scene make_tiny_room() {
  return resized(make_living_room({.thick = false}), 0.001f);
}

// A gallery of 10 x 4 x 7 m, in millimetres.
Scene make_huge_room() {
  Scene scene;
  const Finishes f = add_finishes(scene);
  const int stone = add_texture(scene, 512, 512, marble), rough = add_texture(scene, 256, 256, plaster);
  const int floor = add_material(scene, textured(paint(vec3(0.9f), 0.25f), stone, vec2(1.8f)));
  const int wall = add_material(scene, textured(paint(vec3(0.72f, 0.7f, 0.66f), 0.9f), rough, vec2(2.0f)));
  add_block(scene, vec3(-5.2f, -0.2f, -3.7f), vec3(5.2f, 0, 3.7f), floor);
  add_block(scene, vec3(-5.2f, 4, -3.7f), vec3(5.2f, 4.2f, 3.7f), wall);
  for (const float side : {-1.0f, 1.0f}) {
    add(scene, make_box(vec3(10.4f, 4, 0.2f)), wall, placed(vec3(0, 2, side * 3.6f)));
    add(scene, make_box(vec3(0.2f, 4, 7.0f)), wall, placed(vec3(side * 5.1f, 2, 0)));
    for (int i = 0; i < 3; i++) {
      const float x = 3.0f * static_cast<float>(i - 1);
      add_picture(scene, placed(vec3(x, 1.7f, side * 3.48f), side < 0.0f ? 0.0f : 180.0f), vec2(1.3f, 0.9f),
                  (i + (side < 0.0f ? 0 : 2)) % 5, f.black_wood);
    }
    add(scene, make_cylinder(0.28f, 4.0f, 48), wall, placed(vec3(side * 2.2f, 2, 0)));
    add_block(scene, vec3(side * 4.2f - 0.25f, 0, -0.25f), vec3(side * 4.2f + 0.25f, 1.0f, 0.25f), wall);
    add_vase(scene, f.dark_ceramic, placed(vec3(side * 4.2f, 1.0f, 0)), 0.5f, side < 0.0f ? 0 : 2);
  }
  add(scene, make_rounded_box(vec3(1.6f, 0.42f, 0.5f), 0.04f, 3), f.leather, placed(vec3(0, 0.21f, 1.6f)));
  return resized(std::move(scene), 1000.0f);
}

// Lighting as painted by a baking program: from a lamp in the middle, darker in corners.
vec3 baked(vec3 color, vec3 p, vec3 normal, vec3 half) {
  const vec3 lamp(0.0f, half.y - 0.1f, 0.0f), way = lamp - p;
  const float direct = std::max(dot(normal, normalize(way)), 0.0f) / (0.6f + 0.35f * dot(way, way));
  const vec3 off = half - glm::abs(p);
  const float corner = smoothstep(-0.3f, 0.8f, off.x + (normal.x != 0.0f ? 1.0f : 0.0f)) *
                       smoothstep(-0.3f, 0.8f, off.z + (normal.z != 0.0f ? 1.0f : 0.0f)) *
                       smoothstep(-0.4f, 0.8f, off.y + (normal.y != 0.0f ? 1.0f : 0.0f));
  return color * (vec3(1.0f, 0.9f, 0.75f) * (1.1f * direct) + vec3(0.2f, 0.22f, 0.26f)) * corner;
}

// A room of 6 x 2.8 x 5 m with its lighting in the textures of its six sides and of its boxes.
Scene make_baked_room() {
  Scene scene;
  const vec3 half(3.0f, 1.4f, 2.5f);
  const auto side = [&](vec3 corner, vec3 right, vec3 up, const std::function<vec3(vec2)>& color) {
    const vec3 normal = normalize(cross(right, up));
    const int texture = add_texture(scene, 192, 192, [&](vec2 p) {
      return baked(color(p), corner + right * p.x + up * (1.0f - p.y), normal, half);
    });
    const int material =
        add_material(scene, textured(paint(vec3(1.0f), 1.0f), texture, vec2(length(right), length(up))), "Side_baked");
    add(scene, make_quad(corner, right, up), material);
  };
  const auto block = [&](vec3 low, vec3 high, vec3 color) {
    const vec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
    const auto plain = [=](vec2) { return color; };
    side(low + z, x, y, plain);
    side(high - y, -z, y, plain);
    side(low + x, -x, y, plain);
    side(low, z, y, plain);
    side(low + y + z, x, -z, plain);
  };
  const auto wall = [](vec2) { return vec3(0.7f, 0.66f, 0.6f); };
  const auto boards = [](vec2 p) { return wood_planks(fract(p * 4.0f)); };
  const vec3 l = -half, h = half;
  side({l.x, l.y, h.z}, {6, 0, 0}, {0, 0, -5}, boards);
  side({l.x, h.y, l.z}, {6, 0, 0}, {0, 0, 5}, [](vec2) { return vec3(0.8f); });
  side({l.x, l.y, l.z}, {6, 0, 0}, {0, 2.8f, 0}, [](vec2 p) { return brick(fract(p * vec2(6, 3))); });
  side({h.x, l.y, h.z}, {-6, 0, 0}, {0, 2.8f, 0}, wall);
  side({l.x, l.y, h.z}, {0, 0, -5}, {0, 2.8f, 0}, wall);
  side({h.x, l.y, l.z}, {0, 0, 5}, {0, 2.8f, 0}, wall);
  block({-2.6f, -1.4f, -2.3f}, {-0.6f, -0.6f, -1.5f}, vec3(0.2f, 0.35f, 0.45f));
  block({1.6f, -1.4f, -2.3f}, {2.8f, 0.6f, -1.9f}, vec3(0.45f, 0.25f, 0.12f));
  block({-0.6f, -1.4f, 1.3f}, {1.0f, -0.95f, 2.1f}, vec3(0.6f, 0.2f, 0.15f));
  return scene;
}

// A closed, bumpy shell, 20 m long, with dripstones.
Scene make_dripstone_cave() {
  Scene scene;
  const int rock = add_material(scene, paint(vec3(0.42f, 0.33f, 0.25f), 0.85f));
  const int drip = add_material(scene, paint(vec3(0.55f, 0.46f, 0.36f), 0.35f));
  const auto shell = [](float s, float t) {
    const float a = 2.0f * kPi * s, e = 0.998f * kPi * (t - 0.5f);
    const vec3 out(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
    const vec3 cell = 3.0f * out + 16.0f;
    const float rough =
        (fractal_noise(vec2(cell.x, cell.z), 64, 6, 9u) + fractal_noise(vec2(cell.y, cell.x), 64, 6, 3u) +
         fractal_noise(vec2(cell.z, cell.y), 64, 6, 5u)) /
        3.0f;
    const vec3 p = out * vec3(10.0f, 3.8f, 7.0f) * (0.65f + 0.7f * rough);
    return vec3(p.x, std::max(p.y, -1.9f + 0.5f * rough), p.z);
  };
  add(scene, make_surface(360, 180, vec2(1.0f), shell), rock);
  for (int i = 0; i < 40; i++) {
    const float a = 2.4f * static_cast<float>(i), r = 0.25f + 0.5f * hash01(i, 2, 1u),
                size = 0.8f + 1.6f * hash01(i, 2, 2u);
    const vec3 at(8.0f * r * std::cos(a), 0.0f, 5.5f * r * std::sin(a));
    const Shape cone =
        make_lathe(smooth_profile({{0.6f, 0.0f}, {0.28f, 0.3f * size}, {0.13f, 0.7f * size}, {0.0f, size}}, 6), 24);
    const float up = 3.7f * std::sqrt(1.0f - r * r);
    if (i % 2 == 0) add(scene, cone, drip, placed(at + vec3(0, -1.8f, 0)));
    if (i % 2 == 1) add(scene, cone, drip, placed(at + vec3(0, up, 0)) * turned(vec3(1, 0, 0), 180.0f));
  }
  return scene;
}

// Hills, 400 m wide, with a wood of cones and a lake.
Scene make_hills() {
  Scene scene;
  const int grass = add_texture(scene, 512, 512, [](vec2 p) {
    return mix(vec3(0.07f, 0.14f, 0.03f), vec3(0.24f, 0.26f, 0.09f), fractal_noise(p * 16.0f, 16, 6, 5u));
  });
  const int meadow = add_material(scene, textured(paint(vec3(1.0f), 1.0f), grass, vec2(20.0f)));
  const int needle = add_material(scene, paint(vec3(0.03f, 0.09f, 0.035f), 0.9f));
  const int bark = add_material(scene, paint(vec3(0.12f, 0.07f, 0.04f), 0.9f));
  const int water = add_material(scene, paint(vec3(0.01f, 0.03f, 0.04f), 0.03f));
  const auto height = [](float x, float z) {
    return 46.0f * fractal_noise(vec2(x, z) / 100.0f + 8.0f, 16, 4, 21u) - 18.0f;
  };
  add(scene,
      make_surface(160, 160, vec2(400.0f),
                   [=](float s, float t) {
                     const float x = 400.0f * (s - 0.5f), z = 400.0f * (0.5f - t);
                     return vec3(x, height(x, z), z);
                   }),
      meadow);
  add(scene, make_floor(400.0f, 400.0f), water);
  const Shape crown = make_cone(1.6f, 6.0f, 10), trunk = make_cylinder(0.2f, 1.6f, 8);
  const int crowns = add_mesh(scene, crown.vertices, crown.triangles, needle);
  const int trunks = add_mesh(scene, trunk.vertices, trunk.triangles, bark);
  for (int i = 0; i < 900; i++) {
    const float x = 390.0f * (hash01(i, 0, 1u) - 0.5f), z = 390.0f * (hash01(i, 0, 2u) - 0.5f), y = height(x, z);
    if (y < 0.8f || hash01(i, 0, 3u) > 1.6f * noise(vec2(x, z) / 40.0f + 10.0f, 32, 4u)) continue;
    const vec3 size(0.7f + 0.6f * hash01(i, 0, 5u));
    add_instance(scene, trunks, placed(vec3(x, y + 0.6f, z)));
    add_instance(scene, crowns, placed(vec3(x, y + 1.2f, z), 0.0f, size));
  }
  return scene;
}

// Rocks and a planet, without ground.
Scene make_asteroids() {
  Scene scene;
  const int dust = add_texture(scene, 256, 256, [](vec2 p) {
    return mix(vec3(0.12f, 0.11f, 0.1f), vec3(0.5f, 0.46f, 0.42f), fractal_noise(p * 8.0f, 8, 5, 2u));
  });
  const int rock = add_material(scene, textured(paint(vec3(1.0f), 0.9f), dust, vec2(1.0f)));
  const int storm = add_texture(scene, 8, 256, [](vec2 p) {
    return mix(vec3(0.7f, 0.45f, 0.25f), vec3(0.85f, 0.78f, 0.65f), fractal_noise(vec2(0.5f, p.y * 16.0f), 16, 3, 6u));
  });
  const int planet = add_material(scene, textured(paint(vec3(1.0f), 1.0f), storm, vec2(40.0f, 62.8f)));
  std::vector<int> rocks;
  for (uint kind = 0; kind < 4; kind++) {
    const auto lump = [=](float s, float t) {
      const float a = 2.0f * kPi * s, e = 0.998f * kPi * (t - 0.5f);
      const float r = 0.7f + 0.6f * fractal_noise(vec2(8.0f * s, 4.0f * t), 8, 4, 30u + kind) * std::cos(e);
      return r * vec3(std::cos(e) * std::cos(a), std::sin(e), -std::cos(e) * std::sin(a));
    };
    const Shape shape = make_surface(48, 24, vec2(4.0f, 2.0f), lump);
    rocks.push_back(add_mesh(scene, shape.vertices, shape.triangles, rock));
  }
  for (int i = 0; i < 400; i++) {
    const vec3 p = 70.0f * (vec3(hash01(i, 1, 1u), hash01(i, 1, 2u), hash01(i, 1, 3u)) - 0.5f);
    if (length(p) < 6.0f) continue;
    add_instance(scene, rocks[static_cast<size_t>(i % 4)],
                 placed(p, 360.0f * hash01(i, 1, 4u), vec3(0.4f + 1.8f * hash01(i, 1, 5u))));
  }
  add(scene, make_sphere(20.0f, 96), planet, placed(vec3(0, 2, -75)));
  return scene;
}

// A courtyard, 2 km from the origin.
Scene make_far_courtyard() {
  Scene scene;
  const int bricks = add_texture(scene, 512, 512, brick),
            stones = add_texture(scene, 256, 256, [](vec2 p) {
              const vec2 cell = floor(p * 4.0f), in = fract(p * 4.0f);
              const float joint =
                  smoothstep(0.0f, 0.06f, std::min(std::min(in.x, 1.0f - in.x), std::min(in.y, 1.0f - in.y)));
              return vec3(0.42f, 0.4f, 0.36f) * (0.35f + 0.65f * joint) *
                     (0.75f + 0.4f * hash01(static_cast<int>(cell.x), static_cast<int>(cell.y), 8u));
            });
  const int wall = add_material(scene, textured(paint(vec3(1.0f), 0.9f), bricks, vec2(0.96f)));
  const int ground = add_material(scene, textured(paint(vec3(1.0f), 0.8f), stones, vec2(2.4f)));
  const int trim = add_material(scene, paint(vec3(0.75f, 0.72f, 0.66f), 0.7f));
  const int pane = add_material(scene, paint(vec3(0.02f, 0.03f, 0.04f), 0.05f));
  const Finishes f = add_finishes(scene);
  add_block(scene, vec3(-11, -0.3f, -10), vec3(11, 0, 10), ground);
  for (const float side : {-1.0f, 1.0f}) {
    add(scene, make_box(vec3(4, 8, 20)), wall, placed(vec3(side * 9.0f, 4, 0)));
    add(scene, make_box(vec3(14, 8, 4)), wall, placed(vec3(0, 4, side * 8.0f)));
    for (int i = 0; i < 8; i++) {
      const float along = 3.4f * (static_cast<float>(i % 4) - 1.5f), y = i < 4 ? 1.9f : 5.4f;
      add(scene, make_box(vec3(0.1f, 1.9f, 1.3f)), trim, placed(vec3(side * 7.0f, y, along * 0.85f)));
      add(scene, make_box(vec3(0.12f, 1.6f, 1.0f)), pane, placed(vec3(side * 7.0f, y, along * 0.85f)));
      add(scene, make_box(vec3(1.3f, 1.9f, 0.1f)), trim, placed(vec3(along, y, side * 6.0f)));
      add(scene, make_box(vec3(1.0f, 1.6f, 0.12f)), pane, placed(vec3(along, y, side * 6.0f)));
    }
  }
  add(scene,
      make_lathe({{0, 0},
                  {1.6f, 0},
                  {1.6f, 0.5f},
                  {1.4f, 0.5f},
                  {1.3f, 0.15f},
                  {0.15f, 0.15f},
                  {0.12f, 1.2f},
                  {0.6f, 1.3f},
                  {0.65f, 1.4f},
                  {0, 1.35f}},
                 64),
      trim, placed(vec3(0, 0, -2)));
  for (const float x : {-5.5f, 5.5f}) add_plant(scene, f, placed(vec3(x, 0, -4.8f)), 1.6f, 40, 2u);
  return moved(std::move(scene), vec3(2000, 0, 300));
}

// A street at night, lit by its signs.
Scene make_neon_street() {
  Scene scene;
  const int bricks = add_texture(scene, 512, 512, brick);
  const int wall = add_material(scene, textured(paint(vec3(0.7f), 0.8f), bricks, vec2(0.96f)));
  const int asphalt = add_material(scene, paint(vec3(0.05f, 0.05f, 0.055f), 0.25f));
  const int dark = add_material(scene, paint(vec3(0.02f), 0.4f));
  add_block(scene, vec3(-4, -0.3f, -16), vec3(4, 0, 16), asphalt);
  for (const float side : {-1.0f, 1.0f}) {
    add(scene, make_box(vec3(4, 9, 32)), wall, placed(vec3(side * 6.0f, 4.5f, 0)));
  }
  add(scene, make_box(vec3(8, 9, 1)), wall, placed(vec3(0, 4.5f, -16.5f)));
  add(scene, make_box(vec3(8, 9, 1)), wall, placed(vec3(0, 4.5f, 16.5f)));
  const char* const words[] = {"HOTEL", "BAR", "CINEMA", "OPEN", "JAZZ", "NOODLES", "24H", "PARKING"};
  const vec3 colors[] = {{9, 0.6f, 2.2f}, {0.5f, 4, 9}, {9, 4, 0.5f}, {0.8f, 9, 2}};
  for (int i = 0; i < 8; i++) {
    const float side = i % 2 == 0 ? -1.0f : 1.0f;
    const glm::mat4 face =
        placed(vec3(side * 3.9f, 2.6f + 0.7f * static_cast<float>(i % 3), -10.5f + 3.0f * static_cast<float>(i)),
               side < 0.0f ? -90.0f : 90.0f);
    add(scene, make_box(vec3(3.2f, 1.1f, 0.08f)), dark, face);
    add(scene, make_text(words[i], 0.6f, 0.07f), add_material(scene, glow(colors[i % 4])),
        face * placed(vec3(0, 0, 0.1f)));
  }
  return scene;
}

}  // namespace

const std::vector<KindOfScene>& kinds_of_scene() {
  static const std::vector<KindOfScene> kinds = {
      {"chair", make_dining_chair, SceneKind::kObject, "a studio lights it"},
      {"ring", make_ring, SceneKind::kObject, "shown as a model"},
      {"lighthouse", make_lighthouse, SceneKind::kObject, "shown as a model"},
      {"still-life", make_still_life, SceneKind::kObject, "a studio lights it"},
      {"glasses", make_glasses, SceneKind::kObject, "a studio lights it"},
      {"room-with-lamps", make_lit_room, SceneKind::kClosedRoom, ""},
      {"room-without-a-lamp", make_dark_room, SceneKind::kClosedRoom, "a lamp hangs"},
      {"small-window", make_room_with_a_small_window, SceneKind::kClosedRoom, "sun and sky light it from outside"},
      {"baked-room", make_baked_room, SceneKind::kClosedRoom, "named as baked"},
      {"tiny-room", make_tiny_room, SceneKind::kClosedRoom, "so its unit is taken for"},
      {"huge-room", make_huge_room, SceneKind::kClosedRoom, "taken for millimetres"},
      {"cave", make_dripstone_cave, SceneKind::kClosedRoom, "a lamp hangs"},
      {"hills", make_hills, SceneKind::kOpenPlace, "sun and sky light it"},
      {"asteroids", make_asteroids, SceneKind::kOpenPlace, "a studio lights them"},
      {"far-courtyard", make_far_courtyard, SceneKind::kOpenPlace, "sun and sky light it"},
      {"neon-street", make_neon_street, SceneKind::kOpenPlace, ""},
  };
  return kinds;
}

}  // namespace ods
