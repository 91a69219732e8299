// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/lamp.h"

#include <gtest/gtest.h>

#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builder.h"
#include "ods/stage/scene_rays.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

Clearance clearance_in(const SceneRays& rays) {
  return [&rays](vec3 from, vec3 direction) { return rays.distance(from, direction); };
}

// A closed box with its fronts inside.
void add_room(Scene& scene, vec3 low, vec3 high, int material) {
  add(scene, inside_out(make_box(high - low)), material, placed(0.5f * (low + high)));
}

int white(Scene& scene) {
  return add_material(scene, matte(vec3(1.0f)));
}

// The mean radiance that a camera sees straight below itself.
double seen_below(const Scene& scene, vec3 eye, int bounces) {
  StereoCamera camera;
  camera.position = eye;
  camera.pitch = -90.0f;
  camera.projection.kind = kPerspective;
  camera.projection.fov = 4.0f;
  RenderOptions options = small_render(16, 256);
  options.bounces = bounces;
  return mean_of(render_cpu(scene, camera, options).eyes[0].radiance).value();
}

TEST(Lamp, HangsInTheMiddleBelowTheCeilingWhereverOneStands) {
  Scene scene;
  add_room(scene, vec3(-2.0f, 0.0f, -3.0f), vec3(4.0f, 2.5f, 2.0f), white(scene));
  const SceneRays rays(scene);
  for (const vec3 eye : {vec3(1.0f, 1.6f, -0.5f), vec3(-1.4f, 1.6f, 1.4f), vec3(3.3f, 1.0f, -2.5f)}) {
    const std::optional<CeilingLamp> lamp = place_lamp(eye, clearance_in(rays));
    ASSERT_TRUE(lamp);
    EXPECT_NEAR(lamp->position.x, 1.0f, 0.15f);
    EXPECT_NEAR(lamp->position.z, -0.5f, 0.15f);
    EXPECT_NEAR(lamp->position.y, 2.4f, 1e-3f);
    EXPECT_NEAR(lamp->height, 2.4f, 1e-3f);
    EXPECT_NEAR(lamp->radius, 0.24f, 1e-3f);
  }
}

TEST(Lamp, LightsAWhiteFloorToARadianceOfFourTenths) {
  for (const vec3 size : {vec3(6.0f, 2.5f, 5.0f), vec3(40.0f, 12.0f, 30.0f), vec3(1.2f, 3.0f, 1.0f)}) {
    Scene scene;
    add_room(scene, vec3(-0.5f * size.x, 0.0f, -0.5f * size.z), vec3(0.5f * size.x, size.y, 0.5f * size.z),
             white(scene));
    const SceneRays rays(scene);
    const std::optional<CeilingLamp> lamp = place_lamp(vec3(0.0f, 1.0f, 0.0f), clearance_in(rays));
    ASSERT_TRUE(lamp);
    add_lamp(scene, *lamp);
    EXPECT_NEAR(seen_below(scene, vec3(0.0f, 0.5f, 0.0f), 1), 0.4 / 0.9641, 0.02) << size.x;
  }
}

// The luminance that a camera below the lamp sees straight above itself.
double seen_above(const Scene& scene) {
  StereoCamera camera;
  camera.pitch = 90.0f;
  camera.projection.kind = kPerspective;
  camera.projection.fov = 4.0f;
  const Picture picture = render_cpu(scene, camera, small_render(4, 1));
  const float* pixel = picture.eyes[0].radiance.at(2, 2);
  return 0.2126 * double{pixel[0]} + 0.7152 * double{pixel[1]} + 0.0722 * double{pixel[2]};
}

TEST(Lamp, ShinesOnlyDown) {
  Scene scene;
  add_lamp(scene, {vec3(0.0f, 2.0f, 0.0f), 0.5f, 2.0f});
  EXPECT_EQ(seen_below(scene, vec3(0.0f, 3.0f, 0.0f), 1), 0.0) << "invisible from above";
}

// 0.4 x 4.25 / 0.25 without the limit, which other lamps do not have.
TEST(Lamp, TheCameraSeesItNoBrighterThanDisplayWhite) {
  Scene scene;
  add_lamp(scene, {vec3(0.0f, 2.0f, 0.0f), 0.5f, 2.0f});
  EXPECT_NEAR(seen_above(scene), double{kSeenLamp}, 1e-3);
  scene.instances.back().role = kOrdinary;
  EXPECT_NEAR(seen_above(scene), 6.8, 1e-3);
  Scene wide;
  add_lamp(wide, {vec3(0.0f, 2.0f, 0.0f), 4.0f, 2.0f});
  EXPECT_NEAR(seen_above(wide), 0.5, 1e-3) << "a dim one as it is";
}

TEST(Lamp, MirrorsShowItInFull) {
  Scene scene;
  add_lamp(scene, {vec3(0.0f, 2.0f, 0.0f), 0.5f, 2.0f});
  Material mirror = metal(vec3(1.0f), 0.0f);
  add(scene, make_floor(4.0f, 4.0f), add_material(scene, mirror));
  EXPECT_GT(seen_below(scene, vec3(0.0f, 1.0f, 0.0f), 2), 6.0);
}

// A beam across the ceiling's middle, a room with two wings, a slanted roof.
TEST(Lamp, HangsInFreeSpace) {
  Scene beam, wings, roof;
  add_room(beam, vec3(-2, 0, -2), vec3(2, 2.5f, 2), white(beam));
  add(beam, make_box(vec3(4.0f, 0.3f, 0.3f)), 0, placed(vec3(0.0f, 2.35f, 0.0f)));
  add_room(wings, vec3(-5, 0, -5), vec3(5, 2.5f, 5), white(wings));
  add(wings, make_box(vec3(6.0f, 2.5f, 6.0f)), 0, placed(vec3(-2.0f, 1.25f, -2.0f)));
  add_room(roof, vec3(-2, 0, -2), vec3(2, 5, 2), white(roof));
  add_rectangle(roof, vec3(-2, 1.8f, 2), vec3(0, 0, -4), vec3(4, 2.5f, 0), 0);
  const std::pair<const Scene*, vec3> kCases[] = {
      {&beam, vec3(0.3f, 1.6f, 1.0f)}, {&wings, vec3(3.0f, 1.6f, 3.0f)}, {&roof, vec3(0.2f, 1.0f, 0.0f)}};
  for (const auto& [scene, eye] : kCases) {
    const SceneRays rays(*scene);
    const std::optional<CeilingLamp> lamp = place_lamp(eye, clearance_in(rays));
    ASSERT_TRUE(lamp);
    for (int i = 0; i < 16; i++) {
      const float angle = 6.2831853f * float(i) / 16.0f;
      const vec3 out(cos(angle), 0.0f, sin(angle));
      EXPECT_GT(rays.distance(lamp->position, out), lamp->radius);
      EXPECT_GT(rays.distance(lamp->position + out * lamp->radius, vec3(0, -1, 0)), 0.3f);
    }
    EXPECT_EQ(surroundings(rays, lamp->position).backs, 0.0f) << "not inside of anything";
    EXPECT_GT(lamp->radius, 0.05f);
  }
}

TEST(Lamp, NeedsACeilingAndAFloor) {
  Scene scene;
  add_rectangle(scene, vec3(-2, 0, 2), vec3(4, 0, 0), vec3(0, 0, -4), white(scene));
  const SceneRays rays(scene);
  EXPECT_FALSE(place_lamp(vec3(0, 1, 0), clearance_in(rays)));
  const CeilingLamp lamp = lamp_at(vec3(0, 2, 0), clearance_in(rays));
  EXPECT_NEAR(lamp.height, 2.0f, 1e-4f);
  EXPECT_NEAR(lamp_at(vec3(0, -1, 0), clearance_in(rays)).height, 2.5f, 1e-4f);
}

}  // namespace
}  // namespace ods
