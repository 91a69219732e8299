// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/portals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/light.h"
#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

Material glass() {
  Material material = default_material();
  material.transmission = 1.0f;
  material.roughness = 0.0f;
  return material;
}

float area_of(const Portal& portal) {
  return length(cross(portal.along, portal.across));
}

TEST(Portals, ArePanesOfAnyMake) {
  Scene scene;
  const int pane = add_material(scene, glass());
  add_rectangle(scene, vec3(3, 0, 0), vec3(0, 1, 0), vec3(0, 0, 2), pane);  // a sheet
  add_box(scene, vec3(-3.01f, 0, 0), vec3(-3, 1.5f, 2), pane);              // six sheets of a thin box
  add_sphere(scene, vec3(0, 5, 0), 1.0f, pane);                             // a vase
  add_rectangle(scene, vec3(0, 0, 9), vec3(2, 0, 0), vec3(0, 1, 0), add_material(scene, default_material()));
  const std::vector<Portal> portals = find_portals(scene);
  ASSERT_EQ(portals.size(), 3u);  // the sheet and two faces of the box, whose edges are too small to count
  EXPECT_NEAR(area_of(portals[0]), 3.0f, 1e-4f);
  EXPECT_NEAR(area_of(portals.back()), 2.0f, 1e-4f);
}

// A room that sees the sky through a pane, and the same without the pane.
Scene room(bool with_pane) {
  Scene scene;
  Material white = default_material();
  white.double_sided = 1;
  white.ior = 1.0f;
  const int wall = add_material(scene, white);
  add_rectangle(scene, vec3(-2, -1, -3), vec3(4, 0, 0), vec3(0, 0, 6), wall);
  add_rectangle(scene, vec3(-2, 2, -3), vec3(4, 0, 0), vec3(0, 0, 6), wall);
  add_rectangle(scene, vec3(-2, -1, -3), vec3(0, 3, 0), vec3(0, 0, 6), wall);
  add_rectangle(scene, vec3(-2, -1, -3), vec3(4, 0, 0), vec3(0, 3, 0), wall);
  add_rectangle(scene, vec3(-2, -1, 3), vec3(4, 0, 0), vec3(0, 3, 0), wall);
  // The east wall has a window from z -1 to 1, y 0 to 1.
  add_rectangle(scene, vec3(2, -1, -3), vec3(0, 1, 0), vec3(0, 0, 6), wall);
  add_rectangle(scene, vec3(2, 1, -3), vec3(0, 1, 0), vec3(0, 0, 6), wall);
  add_rectangle(scene, vec3(2, 0, -3), vec3(0, 1, 0), vec3(0, 0, 2), wall);
  add_rectangle(scene, vec3(2, 0, 1), vec3(0, 1, 0), vec3(0, 0, 2), wall);
  Material clear = glass();
  clear.ior = 1.0f;
  if (with_pane) add_rectangle(scene, vec3(2.05f, 0, -1), vec3(0, 1, 0), vec3(0, 0, 2), add_material(scene, clear));
  scene.environment = {vec3(1.0f), 32, 16, {}};
  for (int i = 0; i < 512; i++) scene.environment.texels.push_back(vec3(i < 256 ? 4.0f : 1.0f));
  scene.environment.texels[100] = vec3(900.0f);  // a sun
  return scene;
}

double mean_light(const Picture& picture) {
  return mean_of(picture.eyes[0].radiance).value();
}

// Glass of index 1 changes nothing but how the light is found: with less noise, and as much of it.
TEST(Portals, BringTheSameLightWithLessNoise) {
  RenderOptions options = small_render(64, 256);
  options.statistics = true;
  const Picture open = render_cpu(room(false), StereoCamera{}, options);
  const Picture glazed = render_cpu(room(true), StereoCamera{}, options);
  EXPECT_NEAR(mean_light(glazed) / mean_light(open), 1.0, 0.01);
  EXPECT_LT(mean_of(glazed.eyes[0].variance).value(), 0.7 * mean_of(open.eyes[0].variance).value());
}

TEST(Portals, CountWhereTheSkyIsSeenThroughThem) {
  const Scene scene = room(true);
  const std::vector<Portal> portals = find_portals(scene);
  ASSERT_EQ(portals.size(), 1u);
  LightSampler sampler;
  const auto by_pane = [&](vec3 d) { return sampler.portal_distance(portals[0], vec3(0.0f), d) > 0.0f; };
  EXPECT_TRUE(show_the_sky(portals, vec3(0.0f), by_pane));
  EXPECT_FALSE(show_the_sky(portals, vec3(0.0f), [&](vec3 d) { return by_pane(d) || d.y > 0.9f; }));  // a skylight
  EXPECT_FALSE(show_the_sky(portals, vec3(9.0f, 0, 0), [](vec3 d) { return d.x > 0.0f; }));           // outdoors
  EXPECT_FALSE(show_the_sky({}, vec3(0.0f), [](vec3) { return true; }));
}

}  // namespace
}  // namespace ods
