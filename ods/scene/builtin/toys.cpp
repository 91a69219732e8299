// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// "toys": every kind of animation, around the viewer, in a loop of eight seconds. Clockwise from the front: a snake
// with a skin over joints, a mobile, a ball with morph targets, carts on rails (one per interpolation), a banner with a
// scrolling picture, a windmill, a spotlight, a swinging lamp.
#include <cmath>

#include "ods/scene/builtin/decor.h"
#include "ods/scene/builtin/makers.h"
#include "ods/scene/builtin/moving.h"
#include "ods/scene/builtin/patterns.h"
#include "ods/scene/motion.h"

namespace ods {

static const float kLoop = 8.0f;  // seconds

// Places an object so that it faces the viewer.
static glm::mat4 facing(float azimuth, float distance, float height = 0.0f) {
  return placed(around(azimuth, distance, height), azimuth);
}

static float wave(float turns) {
  return sin(2.0f * kPi * turns);
}

static void add_ground(Scene& scene) {
  const int planks = add_texture(scene, 512, 512, wood_planks), bricks = add_texture(scene, 512, 256, brick);
  const int floor = add_material(scene, textured(paint(vec3(0.8f), 0.5f), planks, vec2(1.2f)), "floor");
  const int wall = add_material(scene, textured(paint(vec3(0.9f)), bricks, vec2(1.0f, 1.0f)), "wall");
  add(scene, make_floor(9.0f, 9.0f), floor);
  for (int side = 0; side < 4; side++) {
    add(scene, make_box(vec3(9.2f, 0.9f, 0.2f)), wall, facing(90.0f * float(side), 4.5f, 0.45f));
  }
}

// --- a skin

static void add_snake(Scene& scene, const Finishes& f) {
  constexpr int kJoints = 7;
  const float kBone = 0.2f, kPot = 0.35f;
  const glm::mat4 place = facing(0.0f, 2.1f);
  const std::vector<vec2> pot = {{0.0f, 0.0f}, {0.2f, 0.0f}, {0.3f, kPot}, {0.26f, kPot}, {0.2f, 0.1f}, {0.0f, 0.1f}};
  add(scene, make_lathe(pot, 48), f.terracotta, place);

  Animation& animation = scene.animation;
  Skin skin;
  const int base = add_node(scene, -1, vec3(place * vec4(0.0f, 0.15f, 0.0f, 1.0f)));
  for (int i = 0; i < kJoints; i++) {
    const int joint = add_node(scene, i == 0 ? base : skin.joints.back(), vec3(0.0f, i == 0 ? 0.0f : kBone, 0.0f));
    skin.joints.push_back(joint);
    glm::dmat4 unbound(1.0);
    unbound[3][1] = -static_cast<double>(kBone) * i;
    skin.inverse_bind.push_back(unbound);
    const float lag = 0.09f * float(i), size = 5.0f + 3.0f * float(i);
    add_keys(scene, Property::kRotation, joint, Interpolation::kLinear, kLoop, 49, [=](float s) {
      const vec3 tilt(0.5f * wave(s * 3.0f - lag), 0.0f, wave(s * 2.0f - lag));
      return quaternion(tilt + vec3(0.0f, 1e-3f, 0.0f), size * length(tilt));
    });
  }
  const float length = kBone * float(kJoints);
  std::vector<vec2> body = {{0.0f, 0.0f}};
  for (int i = 0; i <= 56; i++) {
    const float t = float(i) / 56.0f;
    const float head = 0.05f * std::exp(-80.0f * (t - 0.93f) * (t - 0.93f));
    const float round = sqrt(max(1.0f - std::pow(max(t - 0.9f, 0.0f) * 10.0f, 2.0f), 0.0f));
    body.push_back(vec2((0.085f - 0.03f * t + head) * round, 0.005f + t * length));
  }
  const int stripes = add_texture(scene, 256, 256, [](vec2 p) {
    const float band =
        smoothstep(0.45f, 0.55f, 0.5f + 0.5f * sin(2.0f * kPi * (p.y * 2.0f + 0.05f * sin(6.283f * p.x))));
    return mix(vec3(0.03f, 0.28f, 0.05f), vec3(0.75f, 0.6f, 0.04f), band);
  });
  hang(scene, make_lathe(body, 40), add_material(scene, textured(paint(vec3(1.0f), 0.35f), stripes, vec2(0.3f))), -1);
  Deformation& bent = bend_last(scene);
  bent.skin = static_cast<int>(animation.skins.size());
  bent.influences_per_vertex = 2;
  for (const Vertex& vertex : bent.rest) {
    const float at = clamp(vertex.position.y / kBone, 0.0f, float(kJoints - 1));
    const uint joint = min(static_cast<uint>(at), uint(kJoints - 2));
    const float share = smoothstep(0.0f, 1.0f, at - float(joint));
    bent.influences.push_back({joint, 1.0f - share});
    bent.influences.push_back({joint + 1u, share});
  }
  const int head = skin.joints.back();
  animation.skins.push_back(skin);
  const int white = add_material(scene, paint(vec3(0.9f), 0.2f)), black = add_material(scene, paint(vec3(0.01f), 0.1f));
  for (const float side : {-1.0f, 1.0f}) {
    hang(scene, make_sphere(0.035f, 32), white, head, placed(vec3(0.05f * side, 0.12f, 0.075f)));
    hang(scene, make_sphere(0.018f, 24), black, head, placed(vec3(0.053f * side, 0.125f, 0.1f)));
  }
}

// --- morph targets

// The position to which each target moves a point of the unit sphere.
static vec3 as_cube(vec3 d) {
  const vec3 a = abs(d);
  return d * (0.85f / max(a.x, max(a.y, a.z)));
}

static vec3 as_star(vec3 d) {
  const float around_y = std::atan2(d.x, d.z), level = sqrt(max(1.0f - d.y * d.y, 0.0f));
  return d * (1.0f + 0.4f * level * level * cos(5.0f * around_y));
}

static vec3 normal_of(const std::function<vec3(vec3)>& form, vec3 d) {
  const float step = 2e-3f;
  const vec3 side = normalize(cross(d, abs(d.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0))), up = cross(side, d);
  const auto at = [&](vec3 offset) { return form(normalize(d + offset)); };
  return normalize(cross(at(up * step) - at(-up * step), at(side * step) - at(-side * step)));
}

static void add_morphing_ball(Scene& scene, const Finishes& f) {
  const glm::mat4 place = facing(90.0f, 1.9f);
  const float radius = 0.28f;
  add(scene, make_cylinder(0.16f, 0.9f, 48), f.white_paint, place * placed(vec3(0.0f, 0.45f, 0.0f)));
  const int grain = add_texture(scene, 256, 256, checker);
  const int skin = add_material(scene, textured(paint(vec3(0.95f, 0.35f, 0.25f), 0.3f), grain, vec2(0.22f)));
  const int node = add_node(scene, -1, around(90.0f, 1.9f, 1.27f));
  hang(scene, make_sphere(radius, 96), skin, node);
  Deformation& bent = bend_last(scene);
  for (const auto& form : {as_cube, as_star}) {
    MorphTarget target;
    for (const Vertex& vertex : bent.rest) {
      const vec3 d = normalize(vertex.position);
      target.positions.push_back(form(d) * radius - vertex.position);
      target.normals.push_back(normal_of(form, d) - vertex.normal);
    }
    bent.targets.push_back(target);
  }
  bent.weights = static_cast<int>(scene.animation.weights.size());
  scene.animation.weights.push_back({0.0, 0.0});
  add_keys(scene, Property::kWeights, bent.weights, Interpolation::kLinear, {0, 1, 2, 3, 4, 5, 6, 7, 8},
           {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0.6f, 0.6f, 0, 0});
  add_keys(scene, Property::kRotation, node, Interpolation::kLinear, kLoop, 9,
           [](float s) { return quaternion(vec3(0, 1, 0), 360.0f * s); });
}

// --- nodes

static void add_mobile(Scene& scene, const Finishes& f) {
  const vec3 top = around(45.0f, 2.3f, 2.3f);
  const int hub = add_node(scene, -1, top);
  add(scene, make_cylinder(0.02f, 2.3f, 16), f.iron, placed(vec3(top.x * 1.25f, 1.15f, top.z * 1.25f)));
  add(scene, make_box(vec3(0.02f, 0.02f, 0.62f)), f.iron, facing(45.0f, 2.6f, 2.3f));
  add_keys(scene, Property::kRotation, hub, Interpolation::kLinear, kLoop, 9,
           [](float s) { return quaternion(vec3(0, 1, 0), -360.0f * s); });
  hang(scene, make_box(vec3(0.9f, 0.015f, 0.015f)), f.brass, hub, placed(vec3(0.0f, -0.3f, 0.0f)));
  hang(scene, make_cylinder(0.004f, 0.3f, 8), f.iron, hub, placed(vec3(0.0f, -0.15f, 0.0f)));
  const int planets[] = {f.mustard, f.sage};
  for (int i = 0; i < 2; i++) {
    const float side = i == 0 ? -1.0f : 1.0f;
    const int arm = add_node(scene, hub, vec3(0.44f * side, -0.3f, 0.0f));
    add_keys(scene, Property::kRotation, arm, Interpolation::kLinear, kLoop, 25,
             [=](float s) { return quaternion(vec3(0, 1, 0), 720.0f * side * s); });
    hang(scene, make_cylinder(0.004f, 0.5f, 8), f.iron, arm, placed(vec3(0.0f, -0.25f, 0.0f)));
    hang(scene, make_box(vec3(0.4f, 0.012f, 0.012f)), f.brass, arm, placed(vec3(0.0f, -0.5f, 0.0f)));
    hang(scene, make_sphere(0.09f, 40), planets[i], arm, placed(vec3(0.2f, -0.6f, 0.0f)));
    hang(scene, make_torus(0.07f, 0.03f, 40, 20), f.brass, arm,
         placed(vec3(-0.2f, -0.58f, 0.0f)) * turned(vec3(1, 0, 0), 90.0f));
  }
}

static void add_carts(Scene& scene, const Finishes& f) {
  struct Cart {
    const char* name;
    Interpolation interpolation;
    float height;
    int finish;
  };
  const Cart carts[] = {{"STEP", Interpolation::kStep, 0.55f, f.terracotta},
                        {"LINEAR", Interpolation::kLinear, 1.0f, f.mustard},
                        {"CUBIC", Interpolation::kCubicSpline, 1.45f, f.sage}};
  const float azimuth = 135.0f, distance = 2.4f;
  const glm::mat4 rack = facing(azimuth, distance);
  for (const float side : {-1.0f, 1.0f}) {
    add(scene, make_box(vec3(0.06f, 1.9f, 0.06f)), f.walnut, rack * placed(vec3(0.85f * side, 0.95f, -0.1f)));
  }
  const std::vector<float> stops = {-0.6f, 0.6f, 0.0f, 0.6f, -0.6f};
  for (const Cart& cart : carts) {
    add(scene, make_box(vec3(1.7f, 0.03f, 0.2f)), f.walnut, rack * placed(vec3(0.0f, cart.height, 0.0f)));
    add(scene, make_text(cart.name, 0.1f, 0.015f), f.cream, rack * placed(vec3(0.0f, cart.height + 0.33f, -0.05f)));
    const int rail = add_node(scene, -1, around(azimuth, distance, cart.height));
    scene.animation.nodes.back().rotation =
        glm::dvec4(0.0, std::sin(glm::radians(-0.5 * 135.0)), 0.0, std::cos(glm::radians(-0.5 * 135.0)));
    const int wagon = add_node(scene, rail, vec3(0.0f));
    std::vector<float> times, values;
    for (size_t i = 0; i < stops.size(); i++) {
      times.push_back(2.0f * float(i));
      if (cart.interpolation == Interpolation::kCubicSpline) values.insert(values.end(), {0, 0, 0});
      values.insert(values.end(), {stops[i], 0.0f, 0.0f});
      if (cart.interpolation == Interpolation::kCubicSpline) values.insert(values.end(), {0, 0, 0});
    }
    add_keys(scene, Property::kTranslation, wagon, cart.interpolation, times, values);
    hang(scene, make_rounded_box(vec3(0.3f, 0.12f, 0.14f), 0.02f, 3), cart.finish, wagon,
         placed(vec3(0.0f, 0.115f, 0.0f)));
    for (const float side : {-1.0f, 1.0f}) {
      hang(scene, make_cylinder(0.04f, 0.16f, 32), f.black_wood, wagon,
           placed(vec3(0.09f * side, 0.055f, 0.0f)) * turned(vec3(1, 0, 0), 90.0f));
    }
  }
}

static void add_windmill(Scene& scene, const Finishes& f) {
  const glm::mat4 place = facing(-135.0f, 2.6f);
  const std::vector<vec2> tower = {{0.0f, 0.0f}, {0.4f, 0.0f}, {0.24f, 1.5f}, {0.27f, 1.5f}, {0.0f, 1.85f}};
  add(scene, make_lathe(tower, 48), f.cream, place);
  const int hub = add_node(scene, -1, vec3(place * vec4(0.0f, 1.45f, 0.38f, 1.0f)));
  hang(scene, make_sphere(0.07f, 32), f.brass, hub);
  for (int blade = 0; blade < 4; blade++) {
    const glm::mat4 turn = placed(vec3(0.0f), -135.0f) * turned(vec3(0, 0, 1), 90.0f * float(blade));
    hang(scene, make_box(vec3(0.2f, 0.6f, 0.012f)), blade % 2 == 0 ? f.terracotta : f.linen, hub,
         turn * placed(vec3(0.06f, 0.4f, 0.03f)));
  }
  const vec3 axis(around(-135.0f, 1.0f));
  add_keys(scene, Property::kRotation, hub, Interpolation::kLinear, kLoop, 49,
           [=](float s) { return quaternion(axis, 360.0f * 6.0f * s); });
}

// --- lights and materials

static void add_swinging_lamp(Scene& scene, const Finishes& f) {
  const vec3 top = around(-45.0f, 2.0f, 2.4f);
  add(scene, make_cylinder(0.025f, 2.4f, 16), f.iron, placed(vec3(top.x * 1.3f, 1.2f, top.z * 1.3f)));
  add(scene, make_box(vec3(0.03f, 0.03f, 0.65f)), f.iron, facing(-45.0f, 2.3f, 2.4f));
  const int pivot = add_node(scene, -1, top);
  const vec3 axis = around(-45.0f, 1.0f);
  add_keys(scene, Property::kRotation, pivot, Interpolation::kLinear, kLoop, 65,
           [=](float s) { return quaternion(axis, 32.0f * wave(4.0f * s)); });
  const int bulb = add_material(scene, glow(vec3(70.0f, 48.0f, 26.0f)));
  hang(scene, make_cylinder(0.006f, 0.9f, 12), f.iron, pivot, placed(vec3(0.0f, -0.45f, 0.0f)));
  hang(scene, make_sphere(0.1f, 40), bulb, pivot, placed(vec3(0.0f, -0.98f, 0.0f)));
  const int row = add_moving_material(scene, bulb);
  add_keys(scene, Property::kEmissionStrength, row, Interpolation::kLinear, {0, 2, 4, 6, 8}, {1, 0.4f, 1, 2, 1});
}

static void add_spotlight(Scene& scene, const Finishes& f) {
  const vec3 head = around(-90.0f, 2.2f, 1.7f);
  add(scene, make_cylinder(0.02f, 1.6f, 16), f.iron, placed(vec3(head.x, 0.8f, head.z)));
  const int node = add_node(scene, -1, head);
  const std::vector<vec2> hood = {{0.13f, -0.2f},  {0.06f, 0.0f},  {0.0f, 0.0f},
                                  {0.05f, -0.01f}, {0.12f, -0.2f}, {0.13f, -0.2f}};
  hang(scene, make_lathe(hood, 40), f.brass, node, turned(vec3(1, 0, 0), 90.0f));
  add_keys(scene, Property::kRotation, node, Interpolation::kLinear, kLoop, 33, [](float s) {
    const glm::dvec3 angles(-38.0 + 8.0 * static_cast<double>(wave(2.0f * s)),
                            -90.0 + 40.0 * static_cast<double>(wave(s)), 0.0);
    const std::vector<float> yaw = quaternion(vec3(0, 1, 0), static_cast<float>(angles.y)),
                             pitch = quaternion(vec3(1, 0, 0), static_cast<float>(angles.x));
    return std::vector<float>{yaw[3] * pitch[0], yaw[1] * pitch[3], -yaw[1] * pitch[0], yaw[3] * pitch[3]};
  });
  PunctualLight light;
  light.kind = kLightSpot;
  scene.animation.lamps.push_back({glm::dvec3(1.0, 0.4, 0.9), 40.0, 0.0, 0.2, 0.35});
  scene.animation.lights.push_back({static_cast<int>(scene.lights.size()), node, 0});
  scene.lights.push_back(light);
  add_keys(scene, Property::kLampColor, 0, Interpolation::kLinear, {0, 4, 8},
           {1, 0.4f, 0.9f, 0.3f, 0.8f, 1, 1, 0.4f, 0.9f});
}

static void add_banner(Scene& scene, const Finishes& f) {
  const glm::mat4 place = facing(180.0f, 2.2f);
  const int picture = add_texture(scene, 256, 256, [](vec2 p) {
    const float ring = length(p - 0.5f);
    const vec3 ground = mix(vec3(0.05f, 0.15f, 0.5f), vec3(0.1f, 0.4f, 0.6f), p.y);
    return ring < 0.3f && ring > 0.18f ? vec3(0.85f, 0.8f, 0.3f) : ring <= 0.18f ? vec3(0.75f, 0.15f, 0.1f) : ground;
  });
  const int cloth = add_material(scene, textured(paint(vec3(1.0f)), picture, vec2(0.6f)));
  add(scene, make_box(vec3(1.9f, 0.04f, 0.04f)), f.walnut, place * placed(vec3(0.0f, 1.72f, 0.0f)));
  for (const float side : {-1.0f, 1.0f}) {
    add(scene, make_box(vec3(0.04f, 1.72f, 0.04f)), f.walnut, place * placed(vec3(0.93f * side, 0.86f, 0.0f)));
  }
  add(scene, make_quad(vec3(-0.9f, 1.1f, 0.0f), vec3(1.8f, 0.0f, 0.0f), vec3(0.0f, 0.6f, 0.0f)), cloth, place);
  const int row = add_moving_material(scene, cloth);
  scene.animation.materials.back().placed[kBaseColorSlot] = true;
  add_keys(scene, Property::kUvOffset, kSlotCount * row + kBaseColorSlot, Interpolation::kLinear, {0, kLoop},
           {0, 0, 4, 0});
}

// Uniform light, dim enough for the lamps to matter.
static vec3 evening(vec3 d) {
  const float azimuth = std::atan2(d.x, -d.z) / (2.0f * kPi);
  const vec3 sky = mix(vec3(0.5f, 0.3f, 0.2f), vec3(0.07f, 0.11f, 0.24f), smoothstep(0.0f, 0.5f, d.y));
  const float cloud = fractal_noise(vec2(azimuth * 16.0f + 16.0f, d.y * 12.0f + 16.0f), 16, 5, 3u);
  const vec3 above = mix(sky, vec3(0.55f, 0.35f, 0.3f), 0.6f * smoothstep(0.5f, 0.75f, cloud));
  return 2.2f * (d.y > 0.0f ? above : vec3(0.05f, 0.06f, 0.05f));
}

Scene make_toys() {
  Scene scene;
  const Finishes f = add_finishes(scene);
  add_ground(scene);
  add_snake(scene, f);
  add_mobile(scene, f);
  add_morphing_ball(scene, f);
  add_carts(scene, f);
  add_banner(scene, f);
  add_windmill(scene, f);
  add_spotlight(scene, f);
  add_swinging_lamp(scene, f);
  scene.environment = make_environment(256, evening);
  const int dolly = add_node(scene, -1, vec3(0.0f, 1.5f, 0.0f));
  add_keys(scene, Property::kTranslation, dolly, Interpolation::kLinear, kLoop, 65, [](float s) {
    return std::vector<float>{0.3f * wave(s), 1.5f + 0.1f * wave(2.0f * s), 0.3f * (wave(s + 0.25f) - 1.0f)};
  });
  scene.view_points = {{"dolly", vec3(0.0f, 1.5f, 0.0f)}};
  scene.animation.views = {{0, dolly}};
  set_time(scene, 0.0);
  return scene;
}

}  // namespace ods
