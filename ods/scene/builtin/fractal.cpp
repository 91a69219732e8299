// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// "fractal": sphereflakes (after Eric Haines' Standard Procedural Databases) and Menger sponges on all sides: a handful
// of meshes, thousands of instances, millions of triangles.
#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/makers.h"
#include "ods/scene/builtin/patterns.h"

namespace ods {

static const int kLevels = 4;
using LevelMeshes = int[kLevels + 1];

namespace {

struct Frame {
  vec3 position, x, y, z;  // axes of unit length, y away from the parent
};

}  // namespace

static Frame frame_on(vec3 position, vec3 y) {
  const vec3 x = normalize(cross(abs(y.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), y));
  return {position, x, y, cross(x, y)};
}

// Adds a ball with nine smaller ones, six around its equator and three above; none at the point where it touches its
// parent.
static void add_flake(Scene& scene, const LevelMeshes& meshes, const Frame& frame, float radius, int level) {
  add_instance(scene, meshes[level], placed(frame.position, 0.0f, vec3(radius)));
  if (level == kLevels) return;
  const float child = radius / 3.0f;
  for (int i = 0; i < 9; i++) {
    const bool ring = i < 6;
    const float angle = glm::radians(ring ? 60.0f * float(i) : 120.0f * float(i) + 30.0f);
    const float rise = glm::radians(ring ? 0.0f : 54.7f);
    const vec3 away = cos(rise) * (cos(angle) * frame.x + sin(angle) * frame.z) + sin(rise) * frame.y;
    add_flake(scene, meshes, frame_on(frame.position + (radius + child) * away, away), child, level + 1);
  }
}

namespace {

struct Palette {
  vec3 colors[kLevels + 1];
  bool metallic[kLevels + 1];
};

}  // namespace

static const Palette kPalettes[] = {
    {{{1.0f, 0.71f, 0.29f}, {0.85f, 0.25f, 0.12f}, {1.0f, 0.78f, 0.42f}, {0.55f, 0.06f, 0.08f}, {1.0f, 0.85f, 0.6f}},
     {true, false, true, false, true}},
    {{{0.02f, 0.20f, 0.24f}, {0.9f, 0.9f, 0.88f}, {0.03f, 0.42f, 0.45f}, {0.93f, 0.6f, 0.45f}, {0.85f, 0.95f, 0.9f}},
     {false, true, false, true, false}},
    {{{0.94f, 0.94f, 0.93f}, {0.10f, 0.06f, 0.36f}, {0.75f, 0.30f, 0.55f}, {0.95f, 0.80f, 0.86f}, {0.5f, 0.2f, 0.6f}},
     {true, false, false, true, false}},
};

static void add_flakes(Scene& scene) {
  const Shape fine = make_sphere(1.0f, 48), coarse = make_sphere(1.0f, 16);
  LevelMeshes meshes[3];
  for (int p = 0; p < 3; p++) {
    for (int level = 0; level <= kLevels; level++) {
      const vec3 color = kPalettes[p].colors[level];
      const int material = add_material(scene, kPalettes[p].metallic[level] ? metal(color, 0.3f) : paint(color, 0.3f));
      const Shape& ball = level < 2 ? fine : coarse;
      meshes[p][level] = add_mesh(scene, ball.vertices, ball.triangles, material);
    }
  }
  struct Place {
    vec3 position;
    float radius;
    int palette;
  };
  const Place places[] = {
      {{0.0f, 1.6f, -2.9f}, 0.75f, 0}, {{3.4f, 1.1f, -1.6f}, 0.5f, 1}, {{-3.0f, 1.6f, -1.3f}, 0.55f, 2},
      {{2.0f, 1.7f, 3.4f}, 0.7f, 2},   {{-2.4f, 1.0f, 3.0f}, 0.5f, 0}, {{0.3f, 5.6f, 0.4f}, 0.9f, 1},
      {{9.0f, 3.0f, 4.0f}, 1.6f, 0},   {{-9.5f, 3.4f, 3.0f}, 1.7f, 1}, {{6.5f, 4.5f, -11.0f}, 2.2f, 2},
      {{-7.5f, 4.0f, -9.0f}, 1.9f, 0},
  };
  for (const Place& place : places) {
    const vec3 up(0.0f, place.position.y > 5.0f ? -1.0f : 1.0f, 0.0f);  // the one overhead shows its crown, too
    add_flake(scene, meshes[place.palette], frame_on(place.position, up), place.radius, 0);
  }
}

// Adds the 20 of 27 cubes that a Menger sponge keeps, level by level down to the mesh of one cube.
static void add_sponge(Scene& scene, int cube, const glm::mat4& place, vec3 corner, float size, int level) {
  if (level == 0) {
    add_instance(scene, cube, place * placed(corner + 0.5f * size, 0.0f, vec3(size)));
    return;
  }
  const float third = size / 3.0f;
  for (int i = 0; i < 27; i++) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    const int middles = (x == 1 ? 1 : 0) + (y == 1 ? 1 : 0) + (z == 1 ? 1 : 0);
    if (middles < 2) add_sponge(scene, cube, place, corner + third * vec3(x, y, z), third, level - 1);
  }
}

static void add_sponges(Scene& scene) {
  const Shape cube = make_rounded_box(vec3(1.0f), 0.05f);
  const vec3 colors[] = {{0.80f, 0.52f, 0.16f}, {0.12f, 0.32f, 0.36f}, {0.62f, 0.16f, 0.12f}, {0.72f, 0.70f, 0.66f}};
  struct Place {
    vec3 position;
    float yaw, size;
  };
  const Place places[] = {{{-4.4f, 0.9f, -4.6f}, 24.0f, 1.8f},
                          {{4.6f, 0.8f, -5.0f}, 50.0f, 1.6f},
                          {{5.2f, 1.0f, 1.6f}, 12.0f, 2.0f},
                          {{-5.0f, 1.1f, 0.9f}, 70.0f, 2.2f},
                          {{0.0f, 1.4f, 7.0f}, 35.0f, 2.8f}};
  for (int i = 0; i < 5; i++) {
    const int material =
        add_material(scene, i % 2 == 0 ? paint(colors[i % 4], 0.45f) : metal(colors[i % 4] * 0.5f + 0.45f, 0.3f));
    const int mesh = add_mesh(scene, cube.vertices, cube.triangles, material);
    const float size = places[i].size;
    add_sponge(scene, mesh, placed(places[i].position, places[i].yaw), vec3(-0.5f * size), size, 2);
  }
}

Scene make_fractal() {
  Scene scene;
  const int stone = add_texture(scene, 512, 512, [](vec2 p) {
    const vec2 t = abs(fract(p * 4.0f) - 0.5f);
    return max(t.x, t.y) > 0.492f ? vec3(0.05f) : 0.5f * marble(p);
  });
  add(scene, make_floor(80.0f, 80.0f), add_material(scene, textured(paint(vec3(0.9f), 0.18f), stone, vec2(4.0f))),
      placed(vec3(0.5f, 0.0f, 0.5f)));
  add_flakes(scene);
  add_sponges(scene);
  scene.environment = make_environment(512, [](vec3 d) {
    const float height = clamp(d.y, 0.0f, 1.0f);
    const vec3 sky = mix(vec3(1.25f, 0.82f, 0.58f), vec3(0.10f, 0.20f, 0.50f), pow(height, 0.5f));
    const float sun = max(dot(d, normalize(vec3(0.6f, 0.5f, -0.62f))), 0.0f);
    return sky + vec3(3.2f, 2.4f, 1.6f) * pow(sun, 60.0f) + vec3(0.5f, 0.3f, 0.15f) * pow(sun, 6.0f);
  });
  scene.lights = {make_sun(44.0f, 30.0f, vec3(2.4f, 1.95f, 1.5f))};
  scene.view_points = {{"middle", vec3(0.0f, 1.6f, 0.0f)}};
  return scene;
}

}  // namespace ods
