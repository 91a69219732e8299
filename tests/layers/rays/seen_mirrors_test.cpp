// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/seen_mirrors.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace ods::seen_mirrors_test {

constexpr vec3 kBox(0.3f);

void add_mirror(Scene& scene, vec3 corner, float size) {
  const int silver = add_material(scene, metal(vec3(0.9f), 0.0f));
  add_rectangle(scene, corner, vec3(size, 0, 0), vec3(0, size, 0), silver);
}

// A wall 3 m ahead.
Scene wall() {
  Scene scene;
  add_rectangle(scene, vec3(-4, -4, -3), vec3(8, 0, 0), vec3(0, 8, 0), add_material(scene, matte(vec3(0.5f))));
  return scene;
}

TEST(SeenMirrors, HangOnWalls) {
  Scene scene = wall();
  add_mirror(scene, vec3(-0.5f, -0.5f, -2.97f), 1.0f);
  EXPECT_EQ(seen_mirrors(FirstHits(scene), vec3(0.0f), kBox).size(), 1u);
  EXPECT_TRUE(seen_mirrors(FirstHits(scene), vec3(0, 0, -3.5f), kBox).empty());  // from behind
}

// Beside it, eyes would see the world that it shows.
TEST(SeenMirrors, DoNotStandFree) {
  Scene scene = wall();
  add_mirror(scene, vec3(-0.5f, -0.5f, -2.0f), 1.0f);
  EXPECT_TRUE(seen_mirrors(FirstHits(scene), vec3(0.0f), kBox).empty());
}

// 0.1 square degrees are a square of 0.316 degrees: 16 mm here.
TEST(SeenMirrors, HaveASize) {
  Scene scene = wall();
  add_mirror(scene, vec3(0, 0, -2.97f), 0.014f);
  EXPECT_TRUE(seen_mirrors(FirstHits(scene), vec3(0.0f), kBox).empty());
  add_mirror(scene, vec3(0.1f, 0, -2.97f), 0.018f);
  EXPECT_EQ(seen_mirrors(FirstHits(scene), vec3(0.0f), kBox).size(), 1u);
}

TEST(SeenMirrors, AreTheLargest) {
  Scene scene = wall();
  for (int i = 0; i < 10; i++) {
    add_mirror(scene, vec3(-1.5f + 0.3f * static_cast<float>(i), 0, -2.97f), 0.1f + 0.01f * static_cast<float>(i));
  }
  const std::vector<FlatMirror> mirrors = seen_mirrors(FirstHits(scene), vec3(0.0f), kBox);
  ASSERT_EQ(mirrors.size(), kMostMirrors);
  for (size_t i = 1; i < mirrors.size(); i++) {
    EXPECT_LT(mirrors[i].instance, mirrors[i - 1].instance);
  }
}

}  // namespace ods::seen_mirrors_test
