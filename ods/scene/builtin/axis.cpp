// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// "axis": a labelled reference. The labels read correctly only if the picture is neither mirrored nor rotated.
#include <fmt/format.h>

#include <cmath>

#include "ods/kernel/camera/camera.h"
#include "ods/scene/builtin/builder.h"
#include "ods/scene/builtin/makers.h"

namespace ods {

static const float kEyeHeight = 1.6f, kRadius = 5.0f;

// A matrix that places an object at an azimuth and elevation (degrees) and a distance from the eyes, facing them.
static glm::mat4 facing_viewer(float azimuth, float elevation, float distance) {
  return placed(vec3(0.0f, kEyeHeight, 0.0f), azimuth) * turned(vec3(1, 0, 0), elevation) *
         placed(vec3(0.0f, 0.0f, -distance));
}

static void add_label(Scene& scene, const std::string& text, float height, int material, const glm::mat4& place) {
  add(scene, make_text(text, height, 0.14f * height), material, place);
}

static void add_directions(Scene& scene) {
  struct Direction {
    const char* text;
    float azimuth, elevation;
    vec3 color;
  };
  const Direction directions[] = {
      {"FRONT", 0.0f, 9.0f, {0.05f, 0.15f, 0.75f}}, {"RIGHT", 90.0f, 9.0f, {0.75f, 0.05f, 0.04f}},
      {"BACK", 180.0f, 9.0f, {0.6f, 0.4f, 0.02f}},  {"LEFT", -90.0f, 9.0f, {0.02f, 0.4f, 0.4f}},
      {"UP", 0.0f, 80.0f, {0.05f, 0.5f, 0.08f}},    {"DOWN", 0.0f, -70.0f, {0.45f, 0.05f, 0.45f}},
  };
  for (const Direction& d : directions) {
    const bool pole = abs(d.elevation) > 45.0f;
    const float distance = d.elevation < 0.0f ? 1.2f : kRadius;
    const float height = pole ? 0.06f * distance : 0.13f * distance;
    add_label(scene, d.text, height, add_material(scene, paint(d.color)),
              facing_viewer(d.azimuth, d.elevation, distance));
  }
}

// Ticks every 2 degrees on the horizon, longer every 10, numbers every 30: the azimuth clockwise from the front.
static void add_horizon(Scene& scene) {
  const int black = add_material(scene, paint(vec3(0.02f)));
  const int orange = add_material(scene, paint(vec3(0.8f, 0.2f, 0.01f)));
  const Shape fine = make_box(vec3(0.006f, 0.06f, 0.006f)), coarse = make_box(vec3(0.016f, 0.22f, 0.016f));
  const int fine_mesh = add_mesh(scene, fine.vertices, fine.triangles, black);
  const int coarse_mesh = add_mesh(scene, coarse.vertices, coarse.triangles, orange);
  for (int degree = 0; degree < 360; degree += 2) {
    const float azimuth = float(degree);
    add_instance(scene, degree % 10 == 0 ? coarse_mesh : fine_mesh, facing_viewer(azimuth, 0.0f, kRadius));
    if (degree % 30 == 0)
      add_label(scene, fmt::format("{}", degree), 0.2f, black, facing_viewer(azimuth, -3.2f, kRadius));
  }
}

// A ring every 30 degrees of elevation, labelled in the four directions.
static void add_elevations(Scene& scene) {
  for (const int elevation : {-15, 0, 30, 60}) {
    const float phi = glm::radians(float(elevation));
    const vec3 color = mix(vec3(0.02f, 0.25f, 0.6f), vec3(0.7f, 0.05f, 0.3f), float(elevation + 15) / 75.0f);
    const int material = add_material(scene, paint(color));
    const Shape ring = make_torus(kRadius * cos(phi), 0.008f, 180, 8);
    add(scene, ring, material, placed(vec3(0.0f, kEyeHeight + kRadius * sin(phi), 0.0f)));
    for (int azimuth = 0; azimuth < 360 && elevation != 0; azimuth += 90) {
      const std::string text = fmt::format("{:+}", elevation);
      add_label(scene, text, 0.2f, material, facing_viewer(float(azimuth), float(elevation) + 2.6f, kRadius));
    }
  }
}

// Balls of equal apparent size, whose distance only stereo reveals, labelled in metres.
static void add_distances(Scene& scene) {
  struct Ball {
    float distance, azimuth;
    const char* text;
    vec3 color;
  };
  const Ball balls[] = {{0.6f, -40.0f, "0.6", {0.75f, 0.03f, 0.03f}},
                        {1.0f, -20.0f, "1.0", {0.8f, 0.3f, 0.01f}},
                        {2.0f, 20.0f, "2.0", {0.7f, 0.55f, 0.02f}},
                        {3.5f, 40.0f, "3.5", {0.05f, 0.45f, 0.08f}},
                        {10.0f, 60.0f, "10", {0.03f, 0.15f, 0.7f}}};
  for (const Ball& ball : balls) {
    for (const float turn : {0.0f, 180.0f}) {
      const int material = add_material(scene, paint(ball.color, 0.35f));
      const float elevation = 21.0f;
      add(scene, make_sphere(0.04f * ball.distance, 48), material,
          facing_viewer(ball.azimuth + turn, elevation, ball.distance));
      add_label(scene, ball.text, 0.05f * ball.distance, material,
                facing_viewer(ball.azimuth + turn, elevation - 5.0f, ball.distance));
    }
  }
}

// +X red, +Y green, +Z blue, with an arrow head on each positive half. The centre of the floor stays free for the pole.
static void add_axes(Scene& scene) {
  const vec3 colors[] = {{0.8f, 0.02f, 0.02f}, {0.02f, 0.6f, 0.04f}, {0.02f, 0.06f, 0.85f}};
  const glm::mat4 turns[] = {turned(vec3(0, 0, 1), -90.0f), glm::mat4(1.0f), turned(vec3(1, 0, 0), 90.0f)};
  const char* names[] = {"+X", "+Y", "+Z"};
  const vec3 foot(0.0f, 0.03f, 0.0f), post(0.75f, 0.0f, -3.1f);
  for (int axis = 0; axis < 3; axis++) {
    const int material = add_material(scene, paint(colors[axis], 0.4f));
    const bool upwards = axis == 1;
    const glm::mat4 base = placed(upwards ? post : foot) * turns[axis];
    const auto rod = [&](float from, float to) {
      add(scene, make_cylinder(0.025f, to - from, 24), material, base * placed(vec3(0.0f, 0.5f * (from + to), 0.0f)));
    };
    const float end = upwards ? 1.0f : 3.0f;
    rod(upwards ? 0.0f : 1.3f, end);
    if (!upwards) rod(-3.0f, -1.3f);
    add(scene, make_cone(0.07f, 0.2f, 32), material, base * placed(vec3(0.0f, end, 0.0f)));
    const vec3 tip = vec3(base * vec4(0.0f, end, 0.0f, 1.0f)) + vec3(0.0f, upwards ? 0.36f : 0.25f, 0.0f);
    add_label(scene, names[axis], 0.24f, material, placed(tip, glm::degrees(std::atan2(tip.x, -tip.z))));
  }
}

// The exact poles: a cross and two rings straight above and below the eyes.
static void add_poles(Scene& scene) {
  const int up = add_material(scene, paint(vec3(0.05f, 0.5f, 0.08f)));
  const int down = add_material(scene, paint(vec3(0.45f, 0.05f, 0.45f)));
  for (const int side : {1, -1}) {
    const int material = side > 0 ? up : down;
    const float distance = side > 0 ? kRadius : kEyeHeight - 0.05f;
    const glm::mat4 place = placed(vec3(0.0f, kEyeHeight + float(side) * distance, 0.0f));
    const float unit = 0.012f * distance;
    for (const float degrees : {2.0f, 5.0f}) {
      add(scene, make_torus(distance * tan(glm::radians(degrees)), 0.3f * unit, 96, 8), material, place);
    }
    add(scene, make_box(vec3(8.0f * unit, 0.4f * unit, 0.4f * unit)), material, place);
    add(scene, make_box(vec3(0.4f * unit, 0.4f * unit, 8.0f * unit)), material, place);
  }
}

Scene make_axis() {
  Scene scene;
  // One square per metre, lines through the origin.
  const int tiles = add_texture(scene, 128, 128, [](vec2 p) {
    const vec2 t = abs(fract(p + 0.5f) - 0.5f);
    return min(t.x, t.y) < 0.012f ? vec3(0.25f) : vec3(0.62f, 0.64f, 0.66f);
  });
  add(scene, make_floor(40.0f, 40.0f), add_material(scene, textured(paint(vec3(1.0f)), tiles, vec2(1.0f))));
  add_directions(scene);
  add_horizon(scene);
  add_elevations(scene);
  add_distances(scene);
  add_axes(scene);
  add_poles(scene);
  scene.environment = make_environment(
      128, [](vec3 d) { return mix(vec3(0.75f, 0.80f, 0.85f), vec3(0.30f, 0.45f, 0.75f), clamp(d.y, 0.0f, 1.0f)); });
  scene.lights = {make_sun(-35.0f, 55.0f, vec3(1.4f, 1.3f, 1.15f))};
  scene.view_points = {{"middle", vec3(0.0f, kEyeHeight, 0.0f)}};
  return scene;
}

}  // namespace ods
