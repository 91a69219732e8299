// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/build_layers.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "ods/base/error.h"
#include "ods/layers/light/light_layers.h"
#include "ods/render/cpu/render.h"
#include "tests/support/scenes.h"

namespace ods::build_layers_test {

constexpr int kWidth = 512;

int unlit(Scene& scene) {
  Material material = default_material();
  material.unlit = 1;
  return add_material(scene, material);
}

// A rectangle whose colour is a linear function of the position.
void add_painted(Scene& scene, vec3 corner, vec3 right, vec3 up, int material) {
  std::vector<Vertex> vertices;
  for (const vec3& p : {corner, corner + right, corner + right + up, corner + up}) {
    const vec3 colour = 0.5f + p * vec3(0.1f, 0.15f, 0.05f);
    vertices.push_back({p, normalize(cross(right, up)), vec4(0.0f), vec2(0.0f), vec2(0.0f), vec4(colour, 1.0f)});
  }
  add_instance(scene, add_mesh(scene, vertices, {{0, 1, 2}, {0, 2, 3}}, material), glm::mat4(1.0f));
}

vec3 painted(vec3 p) {
  return 0.5f + p * vec3(0.1f, 0.15f, 0.05f);
}

// A wall 3 m ahead, a red pillar 1 m ahead, and the sky.
Scene pillar() {
  Scene scene;
  add_painted(scene, vec3(-2, -2, -3), vec3(4, 0, 0), vec3(0, 4, 0), unlit(scene));
  const int red = unlit(scene);
  scene.materials[static_cast<size_t>(red)].base_color = vec4(1, 0, 0, 1);
  add_rectangle(scene, vec3(-0.1f, -1, -1), vec3(0.2f, 0, 0), vec3(0, 2, 0), red);
  scene.environment.radiance = vec3(0, 0, 1);
  return scene;
}

struct Shown {
  vec3 colour{0.0f};
  int layers = 0;  // that the ray meets from the front
};

// The colour that a viewer of a layered scene sees: nearest triangle, bilinear texture.
Shown look(const LayeredScene& scene, vec3 eye, vec3 direction) {
  Shown shown;
  float nearest = 1e30f;
  for (const LayerMesh& mesh : scene.meshes) {
    const bool is_sky = mesh.kind == LayerKind::kSky;
    for (const uvec3& corners : mesh.triangles) {
      const vec3 a = mesh.positions[corners.x] + (is_sky ? eye : vec3(0.0f));
      const vec3 ab = mesh.positions[corners.y] - mesh.positions[corners.x];
      const vec3 ac = mesh.positions[corners.z] - mesh.positions[corners.x];
      const vec3 normal = cross(ab, ac);
      const float facing = dot(normal, direction);
      if (facing >= 0.0f) continue;
      const float t = dot(normal, a - eye) / facing;
      const vec3 to = eye + t * direction - a;
      const float v = dot(cross(ab, to), normal) / dot(normal, normal),
                  u = dot(cross(to, ac), normal) / dot(normal, normal);
      if (t <= 0.0f || u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
      if (!is_sky) shown.layers++;
      const float depth = is_sky ? 1e20f : t;
      if (depth >= nearest) continue;
      nearest = depth;
      const vec2 uv = (1 - u - v) * mesh.uvs[corners.x] + u * mesh.uvs[corners.y] + v * mesh.uvs[corners.z];
      const Image& texture = mesh.texture;
      const vec2 at = uv * vec2(texture.width, texture.height) - 0.5f;
      const vec2 base = floor(at), part = at - base;
      shown.colour = vec3(0.0f);
      for (int i = 0; i < 4; i++) {
        const int x = std::clamp(static_cast<int>(base.x) + i % 2, 0, texture.width - 1);
        const int y = std::clamp(static_cast<int>(base.y) + i / 2, 0, texture.height - 1);
        const float weight = (i % 2 ? part.x : 1 - part.x) * (i / 2 ? part.y : 1 - part.y);
        for (int c = 0; c < 3; c++) shown.colour[c] += weight * texture.at(x, y)[c];
      }
    }
  }
  for (int c = 0; c < 3; c++) shown.colour[c] = srgb_decode(shown.colour[c]);
  return shown;
}

LayeredScene layers_of(const Scene& scene, const HeadBox& box) {
  LayerLight light;
  light.bake.render.samples = 1;
  light.bake.is_denoised = false;
  light.tone = ToneCurve::kLinear;
  return light_layers(build_layers(scene, box, kWidth), scene, CpuRenderer(scene), light);
}

// Eyes in the box see wall, pillar and sky where geometry says, also the parts of the wall that the middle does not
// see.
TEST(BuildLayers, ShowsEveryEyeWhatItSees) {
  const Scene scene = pillar();
  HeadBox box;
  box.size = vec3(0.4f);
  const LayeredScene layers = layers_of(scene, box);
  const float pixel = 6.2832f / kWidth;
  std::mt19937 random(6);
  std::uniform_real_distribution<float> any(-0.5f, 0.5f);
  int walls = 0, hidden = 0, pillars = 0, skies = 0;
  for (int i = 0; i < 20000; i++) {
    const vec3 eye = box.size * vec3(any(random), any(random), any(random));
    const vec3 direction = normalize(vec3(3.0f * any(random), 3.0f * any(random), -1.0f));
    const vec3 at_pillar = eye + direction * ((-1.0f - eye.z) / direction.z);
    const vec3 at_wall = eye + direction * ((-3.0f - eye.z) / direction.z);
    // Not within two pixels of a silhouette.
    const float aside = std::max(std::abs(at_pillar.x) - 0.1f, std::abs(at_pillar.y) - 1.0f) / pixel;
    const float beyond = std::max(std::abs(at_wall.x), std::abs(at_wall.y)) - 2.0f;
    if (std::abs(aside) < 2.0f || std::abs(beyond) < 2.0f * 3.0f * pixel) continue;
    const vec3 wanted = aside < 0.0f ? vec3(1, 0, 0) : beyond < 0.0f ? painted(at_wall) : vec3(0, 0, 1);
    const Shown shown = look(layers, eye, direction);
    ASSERT_LT(length(shown.colour - wanted), 0.02f)
        << at_wall.x << " " << at_wall.y << " from " << eye.x << " " << eye.y << " " << eye.z;
    (aside < 0.0f ? pillars : beyond < 0.0f ? walls : skies)++;
    // From the middle, the pillar hides this part of the wall.
    if (aside >= 0.0f && beyond < 0.0f && std::abs(at_wall.x) < 0.25f && std::abs(at_wall.y) < 2.0f) hidden++;
  }
  EXPECT_GT(walls, 2000);
  EXPECT_GT(hidden, 20);
  EXPECT_GT(pillars, 500);
  EXPECT_GT(skies, 500);
}

TEST(BuildLayers, LeavesOutWhatNobodySees) {
  Scene scene = pillar();
  const int unseen = unlit(scene);
  add_rectangle(scene, vec3(-1, -1, -4), vec3(2, 0, 0), vec3(0, 2, 0), unseen);  // behind the wall
  LayerCounts counts;
  const LayerGeometry geometry = build_layers(scene, {}, kWidth, &counts);
  EXPECT_EQ(counts.seen_triangles, 4u);
  EXPECT_TRUE(geometry.sees_sky);
  for (const LayerMesh& mesh : geometry.scene.meshes) {
    for (const vec3& position : mesh.positions) EXPECT_GT(position.z, -3.01f);
  }
  // The part of the wall that the pillar hides from every eye is dropped, so the charts are smaller than the pillar's
  // shadow on the wall: 0.6 m x 3 m.
  size_t texels = 0;
  for (const int owner : geometry.rays.owners) texels += owner >= 2 * static_cast<int>(scene.instances.size()) ? 1 : 0;
  EXPECT_GT(texels, 100u);
  EXPECT_LT(texels, 6000u);
}

TEST(BuildLayers, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = pillar();
  const LayerGeometry many = build_layers(scene, {}, kWidth);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LayerGeometry few = build_layers(scene, {}, kWidth);
  ASSERT_EQ(many.scene.meshes.size(), few.scene.meshes.size());
  for (size_t i = 0; i < few.scene.meshes.size(); i++) {
    EXPECT_EQ(many.scene.meshes[i].positions, few.scene.meshes[i].positions);
    EXPECT_EQ(many.scene.meshes[i].uvs, few.scene.meshes[i].uvs);
    EXPECT_EQ(many.scene.meshes[i].triangles, few.scene.meshes[i].triangles);
  }
  EXPECT_EQ(many.rays.owners, few.rays.owners);
}

// The message names the largest box that fits.
TEST(BuildLayers, RefusesABoxThatCutsASurface) {
  const Scene scene = pillar();
  HeadBox box;
  box.size = vec3(2.5f);
  try {
    build_layers(scene, box, 256);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("at most 1."), std::string::npos) << error.what();
  }
  box.size = vec3(0.3f);
  box.center = vec3(0, 0, -0.96f);
  EXPECT_THROW(build_layers(scene, box, 256), Error);
}

TEST(BuildLayers, StopsWhenCancelled) {
  EXPECT_THROW(build_layers(pillar(), {}, kWidth, nullptr, {{}, [] { return true; }}), Error);
}

}  // namespace ods::build_layers_test
