// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of different kinds, as in files: objects, rooms, places, in right and wrong units.
#pragma once
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ods/scene/builtin/builder.h"
#include "ods/scene/placement.h"

namespace ods {

inline Scene with_materials() {
  Scene scene;
  add_material(scene, matte(vec3(0.6f)));
  add_material(scene, matte(vec3(0.5f, 0.3f, 0.2f)));
  return scene;
}

inline void add_block(Scene& scene, vec3 low, vec3 high, int material = 1) {
  add(scene, make_box(high - low), material, placed(0.5f * (low + high)));
}

// The whole scene, scaled.
inline Scene resized(Scene scene, float factor) {
  for (Instance& instance : scene.instances) {
    instance.row0 *= factor, instance.row1 *= factor, instance.row2 *= factor;
  }
  return scene;
}

inline Scene moved(Scene scene, vec3 way) {
  for (Instance& instance : scene.instances) {
    instance.row0.w += way.x, instance.row1.w += way.y, instance.row2.w += way.z;
  }
  return scene;
}

// Rotates a scene as a program with z up writes it: y becomes z, and z becomes -y.
inline Scene laid_down(Scene scene) {
  for (Instance& instance : scene.instances) {
    const vec4 y = instance.row1;
    instance.row1 = -instance.row2, instance.row2 = y;
  }
  return scene;
}

// A chair, 1 m high, at the origin.
inline Scene make_chair() {
  Scene scene = with_materials();
  for (const float x : {-0.22f, 0.18f}) {
    for (const float z : {-0.22f, 0.18f}) add_block(scene, vec3(x, 0, z), vec3(x + 0.04f, 0.45f, z + 0.04f));
  }
  add_block(scene, vec3(-0.25f, 0.45f, -0.25f), vec3(0.25f, 0.5f, 0.25f));
  add_block(scene, vec3(-0.25f, 0.5f, -0.25f), vec3(0.25f, 1.0f, -0.2f));
  return scene;
}

inline Scene make_ball(float radius) {
  Scene scene = with_materials();
  add(scene, make_sphere(radius, 48), 0, placed(vec3(0, radius, 0)));
  return scene;
}

// A car with a hollow body and seats inside.
inline Scene make_car() {
  Scene scene = with_materials();
  add_block(scene, vec3(-0.9f, 0.4f, -2.2f), vec3(0.9f, 0.5f, 2.2f));
  add_block(scene, vec3(-0.9f, 0.5f, -2.2f), vec3(-0.8f, 0.9f, 2.2f));
  add_block(scene, vec3(0.8f, 0.5f, -2.2f), vec3(0.9f, 0.9f, 2.2f));
  add_block(scene, vec3(-0.9f, 0.5f, -2.2f), vec3(0.9f, 0.9f, -1.2f));
  add_block(scene, vec3(-0.8f, 1.4f, -0.9f), vec3(0.8f, 1.45f, 1.6f));
  for (const float x : {-0.8f, 0.7f}) {
    for (const float z : {-0.9f, 1.5f}) add_block(scene, vec3(x, 0.9f, z), vec3(x + 0.1f, 1.4f, z + 0.1f));
  }
  for (const float x : {-0.5f, 0.1f}) add_block(scene, vec3(x, 0.5f, -0.2f), vec3(x + 0.4f, 0.7f, 0.3f));
  for (const float x : {-0.9f, 0.7f}) {
    for (const float z : {-1.4f, 1.4f}) {
      add(scene, make_cylinder(0.33f, 0.2f, 24), 1, placed(vec3(x + 0.1f, 0.33f, z)) * turned(vec3(0, 0, 1), 90.0f));
    }
  }
  return scene;
}

inline void add_furniture(Scene& scene, vec3 at) {
  add_block(scene, at + vec3(-0.6f, 0.7f, -0.4f), at + vec3(0.6f, 0.75f, 0.4f));
  for (const float x : {-0.55f, 0.5f}) {
    for (const float z : {-0.35f, 0.3f}) {
      add_block(scene, at + vec3(x, 0, z), at + vec3(x + 0.05f, 0.7f, z + 0.05f));
    }
  }
  add(scene, make_sphere(0.15f, 24), 1, placed(at + vec3(0.1f, 0.9f, 0)));
}

// A room of single walls that face inwards, 6 x 2.6 x 5 m, with furniture at its -X end.
inline Scene make_simple_room() {
  Scene scene = with_materials();
  add(scene, inside_out(make_box(vec3(6, 2.6f, 5))), 0, placed(vec3(0, 1.3f, 0)));
  add_furniture(scene, vec3(-2.0f, 0, -0.5f));
  add_block(scene, vec3(-2.9f, 0, 1.0f), vec3(-2.4f, 2.0f, 2.2f));
  return scene;
}

// The same room with walls 20 cm thick, and optionally a window.
inline Scene make_walled_room(bool window = false) {
  Scene scene = with_materials();
  add_block(scene, vec3(-3.2f, -0.2f, -2.7f), vec3(3.2f, 0, 2.7f), 0);
  add_block(scene, vec3(-3.2f, 2.6f, -2.7f), vec3(3.2f, 2.8f, 2.7f), 0);
  add_block(scene, vec3(-3.2f, 0, -2.7f), vec3(3.2f, 2.6f, -2.5f), 0);
  add_block(scene, vec3(-3.2f, 0, 2.5f), vec3(3.2f, 2.6f, 2.7f), 0);
  add_block(scene, vec3(-3.2f, 0, -2.5f), vec3(-3.0f, 2.6f, 2.5f), 0);
  if (window) {
    add_block(scene, vec3(3.0f, 0, -2.5f), vec3(3.2f, 2.6f, -0.5f), 0);
    add_block(scene, vec3(3.0f, 0, 0.5f), vec3(3.2f, 2.6f, 2.5f), 0);
    add_block(scene, vec3(3.0f, 0, -0.5f), vec3(3.2f, 1.0f, 0.5f), 0);
    add_block(scene, vec3(3.0f, 2.0f, -0.5f), vec3(3.2f, 2.6f, 0.5f), 0);
  } else {
    add_block(scene, vec3(3.0f, 0, -2.5f), vec3(3.2f, 2.6f, 2.5f), 0);
  }
  add_furniture(scene, vec3(-2.0f, 0, -0.5f));
  return scene;
}

// Houses around a yard of 14 x 12 m, with a roof over their rim.
inline Scene make_courtyard() {
  Scene scene = with_materials();
  add_block(scene, vec3(-11, -0.3f, -10), vec3(11, 0, 10), 0);
  add_block(scene, vec3(-11, 0, -10), vec3(-7, 8, 10), 0);
  add_block(scene, vec3(7, 0, -10), vec3(11, 8, 10), 0);
  add_block(scene, vec3(-7, 0, -10), vec3(7, 8, -6), 0);
  add_block(scene, vec3(-7, 0, 6), vec3(7, 8, 10), 0);
  for (const float x : {-4.0f, 4.0f}) add(scene, make_cylinder(0.3f, 4.0f, 24), 1, placed(vec3(x, 2, -3)));
  return scene;
}

// Hills of up to `relief` metres on a square of this width, with rocks.
inline Scene make_landscape(float width, float relief = 30.0f) {
  Scene scene = with_materials();
  const auto height = [=](float x, float z) {
    return relief * (0.5f + 0.5f * std::sin(x * 9.0f / width) * std::cos(z * 7.0f / width));
  };
  add(scene,
      make_surface(120, 120, vec2(1.0f),
                   [=](float s, float t) {
                     const float x = width * (s - 0.5f), z = width * (0.5f - t);
                     return vec3(x, height(x, z), z);
                   }),
      0);
  for (int i = 0; i < 40; i++) {
    const float x = width * (std::fmod(0.618f * static_cast<float>(i), 1.0f) - 0.5f);
    const float z = width * (std::fmod(0.414f * static_cast<float>(i), 1.0f) - 0.5f);
    add(scene, make_sphere(1.5f, 16), 1, placed(vec3(x, height(x, z) + 1.0f, z)));
  }
  return scene;
}

// A crooked cave: a closed, bumpy shell seen from inside, 20 m long, with a rough floor.
inline Scene make_cave() {
  Scene scene = with_materials();
  add(scene,
      make_surface(96, 48, vec2(1.0f),
                   [](float s, float t) {
                     const float a = 6.2831853f * s, e = 3.14159265f * (t - 0.5f);
                     const float bump = 1.0f + 0.12f * std::sin(5.0f * a) * std::cos(7.0f * e) +
                                        0.05f * std::sin(11.0f * a + 3.0f * e);
                     const vec3 p(10.0f * std::cos(e) * std::cos(a), 3.5f * std::sin(e),
                                  7.0f * std::cos(e) * std::sin(a));
                     return vec3(p.x * bump, std::max(p.y * bump, -1.8f), p.z * bump);
                   }),
      0);
  for (int i = 0; i < 6; i++) {
    const float a = static_cast<float>(i);
    add(scene, make_cone(0.4f, 2.0f, 16), 1, placed(vec3(5.0f * std::cos(a), -1.8f, 3.5f * std::sin(a))));
  }
  return scene;
}

// Rocks floating in a cube of 60 m, the nearest to its middle 8 m away.
inline Scene make_space() {
  Scene scene = with_materials();
  for (int i = 0; i < 300; i++) {
    const float k = static_cast<float>(i);
    const vec3 p = 60.0f * (vec3(std::fmod(0.7548776f * k, 1.0f), std::fmod(0.5698403f * k, 1.0f),
                                 std::fmod(0.3247180f * k, 1.0f)) -
                            0.5f);
    if (length(p) > 8.0f) add(scene, make_sphere(0.5f + std::fmod(0.37f * k, 1.5f), 12), i % 2, placed(p));
  }
  return scene;
}

}  // namespace ods
