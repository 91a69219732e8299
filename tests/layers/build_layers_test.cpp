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

constexpr float kMirrorAt = -2.98f, kReflectedAt = 2.0f * kMirrorAt - 2.0f;  // z, of a rectangle at z = 2

// A mirror on a wall, and a red rectangle behind the viewer; the rest of the mirror shows the sky.
Scene mirror_on_wall() {
  Scene scene;
  add_painted(scene, vec3(-2, -2, -3), vec3(4, 0, 0), vec3(0, 4, 0), unlit(scene));
  const int silver = add_material(scene, metal(vec3(0.8f), 0.0f));
  add_rectangle(scene, vec3(-0.5f, -0.5f, kMirrorAt), vec3(1, 0, 0), vec3(0, 1, 0), silver);
  const int red = unlit(scene);
  scene.materials[static_cast<size_t>(red)].base_color = vec4(1, 0, 0, 1);
  add_rectangle(scene, vec3(-0.6f, -0.6f, 2), vec3(0, 1.2f, 0), vec3(1.2f, 0, 0), red);
  scene.environment.radiance = vec3(0, 0, 1);
  return scene;
}

// The reflection has its place behind the mirror, for every eye, and the light that the mirror leaves of it.
TEST(BuildLayers, PutsReflectionsBehindMirrors) {
  const Scene scene = mirror_on_wall();
  HeadBox box;
  box.size = vec3(0.4f);
  const LayeredScene layers = layers_of(scene, box);
  vec2 low(1.0f), high(-1.0f);
  for (const LayerMesh& mesh : layers.meshes) {
    for (const vec3& at : mesh.positions) {
      if (mesh.kind == LayerKind::kSky || abs(at.z - kReflectedAt) > 1e-4f) continue;
      low = min(low, vec2(at.x, at.y)), high = max(high, vec2(at.x, at.y));
    }
  }
  EXPECT_LT(length(low + 0.6f) + length(high - 0.6f), 1e-5f);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-0.5f, 0.5f);
  int reds = 0, skies = 0, walls = 0;
  for (int i = 0; i < 8000; i++) {
    const vec3 eye = box.size * vec3(any(random), any(random), any(random));
    const vec3 direction = normalize(vec3(0.8f * any(random), 0.8f * any(random), -1.0f));
    const vec3 at_mirror = eye + direction * ((kMirrorAt - eye.z) / direction.z);
    const vec3 at_red = eye + direction * ((kReflectedAt - eye.z) / direction.z);
    const vec3 at_wall = eye + direction * ((-3.0f - eye.z) / direction.z);
    const float outside = std::max(std::abs(at_mirror.x), std::abs(at_mirror.y)) - 0.5f;
    const float beside = std::max(std::abs(at_red.x), std::abs(at_red.y)) - 0.6f;
    if (std::abs(outside) < 0.15f || std::abs(beside) < 0.3f) continue;   // four pixels of an outline, three of another
    const float left = 0.8f + 0.2f * std::pow(1.0f + direction.z, 5.0f);  // Schlick's reflectance
    const vec3 wanted = outside > 0.0f ? painted(at_wall) : left * (beside < 0.0f ? vec3(1, 0, 0) : vec3(0, 0, 1));
    (outside > 0.0f ? walls : beside < 0.0f ? reds : skies)++;
    ASSERT_LT(length(look(layers, eye, direction).colour - wanted), 0.01f)
        << at_mirror.x << " " << at_mirror.y << " from " << eye.x << " " << eye.y << " " << eye.z;
  }
  EXPECT_GT(reds, 10);
  EXPECT_GT(skies, 100);
  EXPECT_GT(walls, 300);
}

// A pane of thin glass before the wall, whose colour is that of the sky that it reflects.
TEST(BuildLayers, BlendsGlassOverWhatIsBehind) {
  Scene scene;
  add_painted(scene, vec3(-2, -2, -3), vec3(4, 0, 0), vec3(0, 4, 0), unlit(scene));
  Material sheet = glass(1.5f);
  sheet.thickness = 0.0f;
  add_rectangle(scene, vec3(-0.5f, -0.5f, -1.5f), vec3(1, 0, 0), vec3(0, 1, 0), add_material(scene, sheet));
  scene.environment.radiance = vec3(0, 0, 0.5f);
  LayeredScene layers = layers_of(scene, {});
  std::vector<LayerMesh> panes;
  for (LayerMesh& mesh : layers.meshes) {
    if (mesh.kind == LayerKind::kBlended) panes.push_back(mesh);
  }
  std::erase_if(layers.meshes, [](const LayerMesh& mesh) { return mesh.kind == LayerKind::kBlended; });
  ASSERT_EQ(panes.size(), 1u);
  EXPECT_LT(length(look(layers, vec3(0.05f), vec3(0, 0, -1)).colour - painted(vec3(0.05f, 0.05f, -3))), 0.01f);
  // At normal incidence, 4 % are reflected: the rest of the pane's light is from behind.
  int found = 0;
  for (const uvec3& corners : panes[0].triangles) {
    for (int i = 0; i < 3; i++) {
      const vec3 at = panes[0].positions[corners[i]];
      EXPECT_NEAR(at.z, -1.5f, 1e-5f);
      if (length(vec2(at.x, at.y)) > 0.1f) continue;
      const Image& texture = panes[0].texture;
      const vec2 uv = panes[0].uvs[corners[i]] * vec2(texture.width, texture.height);
      const float* const texel = texture.at(static_cast<int>(uv.x), static_cast<int>(uv.y));
      EXPECT_NEAR(texel[3], 0.04f, 1e-4f);
      EXPECT_NEAR(srgb_decode(texel[2]), 0.5f, 2e-3f);
      EXPECT_EQ(texel[0], 0.0f);
      found++;
    }
  }
  EXPECT_GT(found, 0);
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
