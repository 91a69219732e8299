// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/rays/first_hits.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace ods::first_hits_test {

FirstHit one_ray(const FirstHits& hits, vec3 from, vec3 direction) {
  FirstHit seen;
  hits.look(from, &direction, 1, &seen);
  return seen;
}

// A mirror 2 m ahead, and a triangle 3 m behind.
Scene mirror_ahead() {
  Scene scene;

  add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0), add_material(scene, metal(vec3(0.9f), 0.0f)));
  std::vector<Vertex> corners;
  for (const vec3& at : {vec3(0, 0, 3), vec3(0, 1, 3), vec3(1, 0, 3)}) {
    corners.push_back({at, vec3(0, 0, -1), vec4(0.0f), vec2(0.0f), vec2(0.0f), vec4(1.0f)});
  }
  const int red = add_material(scene, paint(vec3(1, 0, 0), 1.0f));
  add_instance(scene, add_mesh(scene, corners, {{0, 1, 2}}, red), glm::mat4(1.0f));
  return scene;
}

TEST(FirstHits, FollowOneReflection) {
  const Scene scene = mirror_ahead();
  FirstHits hits(scene);
  const vec3 direction = normalize(vec3(0.2f, 0.1f, -7.0f));
  EXPECT_EQ(one_ray(hits, vec3(0.0f), direction).instance, 0);
  hits.set_mirrors(find_mirrors(scene), 50.0f);
  const FirstHit seen = one_ray(hits, vec3(0.0f), direction);
  // The triangle's reflection lies at z = -7.
  EXPECT_EQ(seen.instance, hits.numbers().in_mirror(0, 1));
  EXPECT_EQ(hits.numbers().real(seen.instance), 1);
  EXPECT_EQ(hits.numbers().mirror_of(seen.instance), 0);
  EXPECT_EQ(seen.triangle, 0);
  EXPECT_TRUE(seen.front);
  EXPECT_NEAR(seen.distance, 7.0f / -direction.z, 1e-4f);
  EXPECT_EQ(seen.normal, vec3(0, 0, 1));
}

TEST(FirstHits, SeeTheSkyInAMirror) {
  const Scene scene = mirror_ahead();
  FirstHits hits(scene);
  hits.set_mirrors(find_mirrors(scene), 50.0f);
  const FirstHit seen = one_ray(hits, vec3(0.0f), normalize(vec3(-0.2f, 0.1f, -7.0f)));
  EXPECT_TRUE(hits.numbers().is_sky(seen.instance));
  EXPECT_EQ(hits.numbers().mirror_of(seen.instance), 0);
  EXPECT_EQ(seen.distance, 50.0f);
  EXPECT_LT(one_ray(hits, vec3(0.0f), vec3(0, 1, 0)).instance, 0);  // the sky itself
}

// The back of a mirror is a surface.
TEST(FirstHits, SeeAMirrorFromBehind) {
  const Scene scene = mirror_ahead();
  FirstHits hits(scene);
  hits.set_mirrors(find_mirrors(scene), 50.0f);
  const FirstHit seen = one_ray(hits, vec3(0, 0, -4), vec3(0, 0, 1));
  EXPECT_EQ(seen.instance, 0);
  EXPECT_FALSE(seen.front);
  EXPECT_NEAR(seen.distance, 2.0f, 1e-5f);
}

TEST(FirstHits, PassPanes) {
  const Scene scene = mirror_ahead();
  const FirstHits hits(scene, {1, 0});
  EXPECT_LT(one_ray(hits, vec3(0.0f), vec3(0, 0, -1)).instance, 0);
  EXPECT_EQ(one_ray(hits, vec3(0.2f, 0.1f, 0), vec3(0, 0, 1)).instance, 1);
}

}  // namespace ods::first_hits_test
