// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/panes.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace ods::panes_test {

Material sheet(float ior) {
  Material material = glass(ior);
  material.thickness = 0.0f;
  return material;
}

// At normal incidence, ((n - 1) / (n + 1))^2 is reflected.
TEST(Panes, ReflectAsFresnelSays) {
  EXPECT_NEAR(pane_reflectance(sheet(1.5f), 1.0f), 0.04f, 1e-6f);
  EXPECT_NEAR(pane_alpha(sheet(1.5f), 1.0f), 0.04f, 1e-6f);
  EXPECT_NEAR(pane_reflectance(sheet(2.0f), 1.0f), 1.0f / 9.0f, 1e-6f);
  EXPECT_NEAR(pane_alpha(sheet(1.5f), 1e-6f), 1.0f, 1e-3f);  // grazing
  Material tinted = sheet(1.5f);
  tinted.base_color = vec4(0.2f, 0.5f, 0.8f, 1.0f);
  tinted.transmission = 0.96f;
  EXPECT_NEAR(pane_alpha(tinted, 1.0f), 1.0f - 0.5f * 0.96f * 0.96f, 1e-6f);
  EXPECT_NEAR(pane_reflectance(tinted, 1.0f), 0.04f * 0.96f, 1e-6f);
}

TEST(Panes, AreSmoothClearSheets) {
  Scene scene;
  const auto add_sheet = [&](const Material& material, float z) {
    add_rectangle(scene, vec3(-1, -1, z), vec3(2, 0, 0), vec3(0, 2, 0), add_material(scene, material));
  };
  add_sheet(sheet(1.5f), -2.0f);
  add_sheet(glass(1.5f), -3.0f);  // with a volume
  Material rough = sheet(1.5f);
  rough.roughness = 0.3f;
  add_sheet(rough, -4.0f);
  Material milky = sheet(1.5f);
  milky.transmission = 0.5f;
  add_sheet(milky, -5.0f);
  add_sheet(sheet(1.5f), -0.2f);  // in the way of a head
  add_sheet(sheet(1.5f), -0.3f);
  EXPECT_EQ(find_panes(scene, vec3(0.0f), 0.25f), (std::vector<char>{1, 0, 0, 0, 0, 1}));
}

// A sheet shows one side to a place; its back only if the material has two sides.
TEST(Panes, FaceThePlace) {
  Scene scene;
  Material one = sheet(1.5f), two = sheet(1.5f);
  one.double_sided = 0, two.double_sided = 1;
  add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0), add_material(scene, one));
  add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0), add_material(scene, two));
  const vec3 behind(0, 0, -5);
  const size_t whole = 2;
  EXPECT_EQ(pane_triangles(scene, 0, false, vec3(0.0f)).triangles.size(), whole);
  EXPECT_EQ(pane_triangles(scene, 0, true, vec3(0.0f)).triangles.size(), 0u);
  EXPECT_EQ(pane_triangles(scene, 0, false, behind).triangles.size(), 0u);
  EXPECT_EQ(pane_triangles(scene, 0, true, behind).triangles.size(), 0u);
  const PaneTriangles back = pane_triangles(scene, 1, true, behind);
  ASSERT_EQ(back.triangles.size(), whole);
  EXPECT_NEAR(back.nearest, 3.0f, 1e-5f);
  for (const uvec3& corners : back.triangles) {
    const vec3 a = back.positions[corners.x];
    EXPECT_LT(dot(cross(back.positions[corners.y] - a, back.positions[corners.z] - a), a), 0.0f);
  }
}

}  // namespace ods::panes_test
