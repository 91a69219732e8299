// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// "mirrors": reflections in stereo. Objects appear at their real distance behind flat mirrors, smaller and closer in
// convex ones, and floating in the air in concave ones.
#include <algorithm>
#include <iterator>

#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/makers.h"
#include "ods/scene/builtin/patterns.h"

namespace ods {

static const vec3 kSilver(0.95f, 0.95f, 0.94f), kGold(1.0f, 0.72f, 0.30f), kCopper(0.95f, 0.55f, 0.40f);

static void add_floor(Scene& scene) {
  const int tiles = add_texture(scene, 256, 256, checker);
  add(scene, make_floor(60.0f, 60.0f), add_material(scene, textured(paint(vec3(1.0f), 0.25f), tiles, vec2(1.6f))));
}

namespace {

struct Ball {
  float azimuth, distance, radius;
  vec3 color;
  float roughness;
};

}  // namespace
// Mirrors are perfect or clearly rough: anything between scatters the sun into fireflies.
static const Ball kBalls[] = {
    {-14.0f, 2.4f, 0.75f, kSilver, 0.0f},  {19.0f, 1.6f, 0.32f, kGold, 0.0f},    {8.0f, 4.6f, 1.2f, kCopper, 0.3f},
    {-52.0f, 3.6f, 0.9f, kGold, 0.0f},     {75.0f, 3.2f, 0.7f, kSilver, 0.0f},   {118.0f, 1.9f, 0.45f, kCopper, 0.0f},
    {152.0f, 3.0f, 0.85f, kSilver, 0.0f},  {-128.0f, 2.2f, 0.5f, kSilver, 0.0f}, {-160.0f, 4.5f, 1.3f, kGold, 0.3f},
    {-88.0f, 1.7f, 0.28f, kCopper, 0.25f}, {45.0f, 7.0f, 1.6f, kSilver, 0.0f},   {-32.0f, 8.0f, 1.8f, kSilver, 0.0f},
};

static void add_balls(Scene& scene) {
  const Shape ball = make_sphere(1.0f, 96);
  for (const Ball& b : kBalls) {
    add(scene, ball, add_material(scene, metal(b.color, b.roughness)),
        placed(around(b.azimuth, b.distance, b.radius), 0.0f, vec3(b.radius)));
  }
}

static void add_flat_mirrors(Scene& scene) {
  const int silver = add_material(scene, metal(kSilver, 0.0f));
  const int frame = add_material(scene, paint(vec3(0.05f, 0.028f, 0.018f), 0.3f));
  const vec2 size(1.5f, 2.2f);
  const float border = 0.09f;
  Shape bars;
  for (const float side : {-1.0f, 1.0f}) {
    append(bars, transformed(make_rounded_box(vec3(border, size.y + border, 0.09f), 0.015f, 2),
                             placed(vec3(0.5f * side * size.x, 0.0f, 0.0f))));
    append(bars, transformed(make_rounded_box(vec3(size.x - border, border, 0.08f), 0.015f, 2),
                             placed(vec3(0.0f, 0.5f * side * size.y, 0.0f))));
  }
  struct Place {
    float azimuth, distance, turn;
  };
  for (const Place& at :
       {Place{44.0f, 3.4f, -12.0f}, Place{-78.0f, 3.8f, 14.0f}, Place{98.0f, 3.6f, 8.0f}, Place{180.0f, 5.6f, 0.0f}}) {
    const glm::mat4 place = placed(around(at.azimuth, at.distance, 1.25f), at.azimuth + at.turn);
    add(scene, make_box(vec3(size, 0.02f)), silver, place);
    add(scene, bars, frame, place);
  }
}

// Part of a sphere with a rim, seen from inside (concave) or from outside (convex).
static void add_curved_mirrors(Scene& scene) {
  const int silver = add_material(scene, metal(kSilver, 0.0f));
  const int rim = add_material(scene, metal(kGold, 0.3f));
  const float curvature = 1.7f, half_angle = 0.48f;
  std::vector<vec2> profile;  // a bowl around the axis, turned to the viewer below
  for (int i = 0; i <= 48; i++) {
    const float angle = half_angle * float(i) / 48.0f;
    profile.push_back(curvature * vec2(i == 0 ? 0.0f : sin(angle), 1.0f - cos(angle)));
  }
  const Shape outside = make_lathe(profile, 128);
  const Shape edge = make_torus(profile.back().x, 0.035f, 96, 16);
  const auto stand = [&](float azimuth, float distance, bool hollow) {
    const float tilt = hollow ? 90.0f : -90.0f;
    const glm::mat4 place = placed(around(azimuth, distance, 1.35f), azimuth) * turned(vec3(1, 0, 0), tilt);
    add(scene, hollow ? inside_out(outside) : outside, silver, place);
    add(scene, edge, rim, place * placed(vec3(0.0f, profile.back().y, 0.0f)));
  };
  stand(-33.0f, 2.9f, true);
  stand(132.0f, 3.6f, false);
}

static void add_colored_things(Scene& scene) {
  const Shape things[] = {
      make_rounded_box(vec3(0.5f), 0.05f, 3),
      transformed(make_cone(0.3f, 0.7f, 64), placed(vec3(0.0f, -0.25f, 0.0f))),
      transformed(make_torus(0.3f, 0.1f, 64, 24), placed(vec3(0.0f, -0.15f, 0.0f))),
      make_cylinder(0.22f, 0.5f, 48),
  };
  const vec3 colors[] = {{0.70f, 0.05f, 0.04f}, {0.04f, 0.22f, 0.62f}, {0.80f, 0.42f, 0.02f}, {0.04f, 0.42f, 0.16f},
                         {0.45f, 0.06f, 0.42f}, {0.02f, 0.42f, 0.45f}, {0.75f, 0.72f, 0.66f}};
  for (int i = 0; i < 34; i++) {
    const float azimuth = float(i) * 137.5f, distance = 1.35f + 0.23f * float(i);
    const vec3 place = around(azimuth, distance, 0.25f);
    const bool hits_ball = std::any_of(std::begin(kBalls), std::end(kBalls), [&](const Ball& b) {
      return glm::distance(place, around(b.azimuth, b.distance, 0.25f)) < b.radius + 0.42f;
    });
    if (hits_ball) continue;
    const int material = add_material(scene, paint(colors[i % 7], i % 3 == 0 ? 0.15f : 0.5f));
    add(scene, things[i % 4], material, placed(place, 31.0f * float(i)));
  }
}

Scene make_mirrors() {
  Scene scene;
  add_floor(scene);
  add_balls(scene);
  add_flat_mirrors(scene);
  add_curved_mirrors(scene);
  add_colored_things(scene);
  // A clear evening: warm towards the sun, violet overhead, a few long clouds.
  scene.environment = make_environment(512, [](vec3 d) {
    const float height = clamp(d.y, 0.0f, 1.0f);
    vec3 sky = mix(vec3(0.75f, 0.62f, 0.55f), vec3(0.10f, 0.20f, 0.48f), pow(height, 0.45f));
    const vec3 sun = normalize(vec3(-0.75f, 0.42f, -0.5f));
    sky += vec3(0.5f, 0.28f, 0.1f) * pow(max(dot(d, sun), 0.0f), 6.0f);
    const vec2 flat = vec2(d.x, d.z) / (height + 0.15f);
    const float cloud = smoothstep(0.5f, 0.75f, fractal_noise(flat * vec2(0.9f, 2.2f) + 64.0f, 128, 5, 7u));
    sky = mix(sky, vec3(0.9f, 0.75f, 0.68f), 0.7f * cloud * smoothstep(0.0f, 0.2f, height));
    return d.y < 0.0f ? vec3(0.35f, 0.31f, 0.29f) : sky;
  });
  scene.lights = {make_sun(-56.0f, 25.0f, vec3(1.9f, 1.5f, 1.1f))};
  scene.view_points = {{"middle", vec3(0.0f, 1.4f, 0.0f)}};
  return scene;
}

}  // namespace ods
