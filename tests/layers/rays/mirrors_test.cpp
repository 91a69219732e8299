// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/mirrors.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace ods::mirrors_test {

int silver(Scene& scene) {
  return add_material(scene, metal(vec3(0.9f), 0.05f));
}

TEST(FindMirrors, FindsSmoothFlatMetal) {
  Scene scene;
  const int glossy = silver(scene);
  const int found = add_rectangle(scene, vec3(-1, 0, -2), vec3(2, 0, 0), vec3(0, 1, 0), glossy);
  add_rectangle(scene, vec3(-1, 0, -3), vec3(2, 0, 0), vec3(0, 1, 0), add_material(scene, metal(vec3(0.9f), 0.2f)));
  add_rectangle(scene, vec3(-1, 0, -4), vec3(2, 0, 0), vec3(0, 1, 0), add_material(scene, paint(vec3(0.9f), 0.0f)));
  add_sphere(scene, vec3(0, 0, 3), 0.5f, glossy);  // curved
  Material scratched = metal(vec3(0.9f), 0.05f);
  scratched.normal_slot.texture = add_texture(scene, 4, 4, [](vec2) { return vec3(0.5f, 0.5f, 1.0f); });
  add_rectangle(scene, vec3(-1, 0, -5), vec3(2, 0, 0), vec3(0, 1, 0), add_material(scene, scratched));
  const std::vector<FlatMirror> mirrors = find_mirrors(scene);
  ASSERT_EQ(mirrors.size(), 1u);
  EXPECT_EQ(mirrors[0].instance, found);
  EXPECT_EQ(mirrors[0].triangles.size(), 2u);
  EXPECT_EQ(mirrors[0].normal, vec3(0, 0, 1));
  EXPECT_EQ(mirrors[0].height, -2.0f);
}

// A box has one for each face.
TEST(FindMirrors, SeparatesPlanes) {
  Scene scene;
  add(scene, make_box(vec3(1.0f, 2.0f, 0.02f)), silver(scene), placed(vec3(0.0f, 1.0f, -3.0f), 30.0f));
  const std::vector<FlatMirror> mirrors = find_mirrors(scene);
  EXPECT_EQ(mirrors.size(), 6u);
  for (const FlatMirror& mirror : mirrors) {
    EXPECT_EQ(mirror.triangles.size(), 2u);
    for (const vec3& corner : mirror.corners) EXPECT_NEAR(height_above(mirror, corner), 0.0f, 1e-5f);
  }
}

// The unit square at z = -2, with one side.
FlatMirror square() {
  Scene scene;
  add_rectangle(scene, vec3(0, 0, -2), vec3(1, 0, 0), vec3(0, 1, 0), silver(scene));
  scene.materials.back().double_sided = 0;
  return find_mirrors(scene).at(0);
}

TEST(FlatMirror, Reflects) {
  const FlatMirror mirror = square();
  EXPECT_EQ(reflected_point(mirror, vec3(3, 4, 5)), vec3(3, 4, -9));
  EXPECT_EQ(reflected_direction(mirror, vec3(1, 2, -3)), vec3(1, 2, 3));
  FlatMirror turned = mirror;
  EXPECT_TRUE(turn_to(turned, vec3(0.0f)));
  EXPECT_FALSE(turn_to(turned, vec3(0, 0, -5)));  // its back does not reflect
  turned = mirror;
  turned.has_two_sides = true;
  EXPECT_TRUE(turn_to(turned, vec3(0, 0, -5)));
  EXPECT_EQ(turned.normal, vec3(0, 0, -1));
  EXPECT_EQ(reflected_point(turned, vec3(3, 4, 5)), vec3(3, 4, -9));
}

TEST(FlatMirror, HasAnOutline) {
  const FlatMirror mirror = square();
  EXPECT_TRUE(is_in_outline(mirror, vec3(0.99f, 0.99f, -2), 0.0f));
  EXPECT_FALSE(is_in_outline(mirror, vec3(1.01f, 0.99f, -2), 0.0f));
  EXPECT_TRUE(is_in_outline(mirror, vec3(1.01f, 0.99f, -2), 0.02f));
}

// A triangle with one corner in front of the plane keeps a quadrangle, one with two a triangle.
TEST(FlatMirror, KeepsWhatIsBehind) {
  const FlatMirror mirror = square();
  std::vector<vec3> positions = {{0, 0, -4}, {2, 0, -4}, {0, 0, 0}, {2, 0, 0}};
  std::vector<uvec3> triangles = {{0, 1, 2}, {1, 3, 2}};
  keep_behind(mirror, vec3(0, 0, 1), positions, triangles);  // the plane is at z = -3
  double area = 0.0;
  for (const uvec3& corners : triangles) {
    const vec3 across = cross(positions[corners.y] - positions[corners.x], positions[corners.z] - positions[corners.x]);
    EXPECT_LT(across.y, 0.0f);
    area += 0.5 * static_cast<double>(length(across));
    for (int i = 0; i < 3; i++) EXPECT_LE(positions[corners[i]].z, -3.0f + 1e-5f);
  }
  EXPECT_NEAR(area, 2.0, 1e-5);
  EXPECT_EQ(triangles.size(), 3u);
  EXPECT_EQ(positions.size(), 7u);  // the cut through the common edge is one vertex
}

}  // namespace ods::mirrors_test
