// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/doubled_faces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "tests/support/scenes.h"

namespace ods::doubled_faces_test {

Material one_sided(vec3 color) {
  Material material = matte(color);
  material.double_sided = 0;
  return material;
}

// The same square as make_quad() makes, divided along the other diagonal.
Shape other_diagonal(Shape quad) {
  const uvec3 a = quad.triangles[0], b = quad.triangles[1];
  for (const uint lone : {b.x, b.y, b.z}) {
    if (lone == a.x || lone == a.y || lone == a.z) continue;
    // a without its corner opposite the common edge, and the other way round
    for (int i = 0; i < 3; i++) {
      const uint corner = a[i], next = a[(i + 1) % 3], last = a[(i + 2) % 3];
      const bool shared = corner != b.x && corner != b.y && corner != b.z;
      if (shared) quad.triangles = {{corner, next, lone}, {corner, lone, last}};
    }
  }
  return quad;
}

std::vector<std::vector<char>> doubled(const Shape& front, const Shape& back, const glm::mat4& at = glm::mat4(1.0f),
                                       const Material& of_back = one_sided(vec3(0.5f))) {
  Scene scene;
  add(scene, front, add_material(scene, one_sided(vec3(0.5f))), at);
  add(scene, back, add_material(scene, of_back), at);
  return find_doubled_faces(scene);
}

using Flags = std::vector<std::vector<char>>;

TEST(DoubledFaces, AreThoseThatCoverEachOther) {
  const Shape square = make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
  const Flags both = {{1, 1}, {1, 1}}, none = {{}, {}};
  EXPECT_EQ(doubled(square, inside_out(square)), both);
  EXPECT_EQ(doubled(square, inside_out(other_diagonal(square))), both);
  EXPECT_EQ(doubled(square, inside_out(square), placed(vec3(3, 1, 2), 30.0f, vec3(-1, 2, 1))), both) << "mirrored";
  EXPECT_EQ(doubled(square, square), none) << "both face one way";
  EXPECT_EQ(doubled(square, inside_out(square), glm::mat4(1.0f), matte(vec3(0.5f))), none) << "double-sided";
  EXPECT_EQ(doubled(square, inside_out(make_quad(vec3(1, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)))), none) << "beside it";
  EXPECT_EQ(doubled(make_box(vec3(1.0f)), inside_out(make_box(vec3(2.0f)))), none);
  const Flags all = {std::vector<char>(12, 1), std::vector<char>(12, 1)};
  EXPECT_EQ(doubled(make_box(vec3(1.0f)), inside_out(make_box(vec3(1.0f)))), all);
}

// A room of walls 1 m away, each there twice: green from inside, black from outside. shared: the walls are instances in
// Embree's tree.
void expect_green(bool mirrored, bool shared) {
  Scene scene;
  const Shape walls = make_box(vec3(2.0f));
  const glm::mat4 at = placed(vec3(0), 0.0f, vec3(mirrored ? -1 : 1, 1, 1));
  const int outside = add(scene, walls, add_material(scene, one_sided(vec3(0.0f))), at);
  const int inside = add(scene, inside_out(walls), add_material(scene, one_sided(vec3(0, 1, 0))), at);
  for (const int mesh : {outside, inside}) add_instance(scene, mesh, placed(vec3(10, 0, 0)));
  const LightTable lights = make_lights(scene);
  const EmbreeScene tree(scene, shared ? 0 : EmbreeScene::kMaxCopiedTriangles);
  PathTracer tracer;
  set_scene(tracer, scene, lights);
  for (int i = 0; i < 500; i++) {
    const float turn = 0.37f * static_cast<float>(i), up = -0.95f + 0.0038f * static_cast<float>(i);
    const vec3 way = normalize(vec3(std::cos(turn), up, std::sin(turn)));
    const Ray ray{vec3(0.1f, 0.2f, 0.3f), way};
    for (const int kind : {kPathRay, kShadowRay}) {
      tracer.start_path(ray, no_media(), 0u, 0u);
      const Hit hit = tree.closest_hit(tracer, ray, kind);
      ASSERT_EQ(scene.instances[static_cast<size_t>(hit.instance)].mesh, inside)
          << i << (mirrored ? ", mirrored" : "") << (shared ? ", shared" : "");
    }
  }
}

TEST(DoubledFaces, RaysMeetTheSideThatFacesThem) {
  for (const bool mirrored : {false, true}) {
    for (const bool shared : {false, true}) expect_green(mirrored, shared);
  }
}

}  // namespace ods::doubled_faces_test
