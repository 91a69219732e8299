// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Light found by sampling lights, by scattered rays, and by both together is the same light.
#include <gtest/gtest.h>

#include <cmath>

#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

// Pictures of independent samples: their pixels' differences have mean zero.
void expect_same_light(const Scene& scene, int samples = 64, int bounces = 3) {
  RenderOptions options = small_render(32, samples);
  options.bounces = bounces;
  std::vector<Image> images;
  for (LightSampling sampling : {LightSampling::kBoth, LightSampling::kLightsOnly, LightSampling::kBsdfOnly}) {
    options.light_sampling = sampling;
    options.seed++;
    images.push_back(render_cpu(scene, StereoCamera{}, options).eyes[0].radiance);
  }
  const double level = mean_of(images[0]).value();
  EXPECT_GT(level, 0.001);
  for (size_t other : {size_t{1}, size_t{2}}) {
    Mean difference;
    for (size_t i = 0; i < images[0].pixels.size(); i += 3) {
      difference.add(double{images[0].pixels[i]} - double{images[other].pixels[i]});
    }
    EXPECT_LT(std::abs(difference.value()) / std::sqrt(difference.variance()), 4.0)
        << (other == 1 ? "lights only, " : "scattered rays only, ") << difference.value() / level;
    EXPECT_LT(std::sqrt(difference.variance()), 0.02 * level) << "too noisy to tell";
  }
}

Material glowing(vec3 radiance) {
  Material material = matte(vec3(0.3f));
  material.emission = radiance;
  return material;
}

// A room with one kind of wall and a lamp under its ceiling.
Scene room(const Material& wall, const Material& lamp) {
  Scene scene;
  add_box(scene, vec3(-2.0f, -1.0f, -2.0f), vec3(2.0f, 1.5f, 2.0f), add_material(scene, wall));
  add_rectangle(scene, vec3(-1, 1.2f, -1.5f), vec3(1.5f, 0, 0), vec3(0, 0, 1.2f), add_material(scene, lamp));
  return scene;
}

Scene sky(const Material& floor) {
  Scene scene;
  add_rectangle(scene, vec3(-9, -1, 9), vec3(18, 0, 0), vec3(0, 0, -18), add_material(scene, floor));
  add_sphere(scene, vec3(0, 0, -2), 0.7f, 0, 8);
  scene.environment = {vec3(1.0f), 16, 8, {}};
  Dice dice(1);
  for (int i = 0; i < 128; i++) scene.environment.texels.push_back(vec3(dice.next() < 0.1f ? 8.0f : 0.2f));
  return scene;
}

Material rough(float metallic, float roughness, float transmission, bool volume) {
  Material material = default_material();
  material.base_color = vec4(0.7f, 0.7f, 0.7f, 1.0f);
  material.metallic = metallic;
  material.roughness = roughness;
  material.transmission = transmission;
  material.thickness = volume ? 1.0f : 0.0f;
  return material;
}

TEST(SameLight, DiffuseRoom) {
  expect_same_light(room(matte(vec3(0.6f)), glowing(vec3(3.0f))));
}

TEST(SameLight, MetalRoom) {
  expect_same_light(room(rough(1.0f, 0.4f, 0.0f, false), glowing(vec3(3.0f))), 128);
}

TEST(SameLight, RoomWithALampThatIsHalfThere) {
  Material lamp = glowing(vec3(3.0f));
  lamp.alpha_mode = kAlphaBlend;
  lamp.base_color.w = 0.4f;
  expect_same_light(room(matte(vec3(0.6f)), lamp), 128);
  lamp.alpha_mode = kAlphaMask;
  expect_same_light(room(glowing(vec3(0.5f)), lamp));
}

TEST(SameLight, SingleSidedMirroredLamp) {
  Material lamp = glowing(vec3(3.0f));
  lamp.double_sided = 0;
  Scene scene = room(matte(vec3(0.6f)), lamp);
  glm::mat4 mirrored(1.0f);
  mirrored[1][1] = -1.0f;
  mirrored[3][1] = 1.0f;
  add_instance(scene, 6, mirrored);
  expect_same_light(scene);
}

// Lamps all over a room: balls, of which the backs are dark or not seen, and panels that shine to one side. A tree
// picks among their triangles.
TEST(SameLight, ManyLamps) {
  Material ball = glowing(vec3(3.0f)), panel = glowing(vec3(5.0f));
  panel.double_sided = 0;
  Scene scene = room(matte(vec3(0.6f)), glowing(vec3(0.5f)));
  const int balls = add_material(scene, ball), panels = add_material(scene, panel);
  Dice dice(3);
  for (int i = 0; i < 12; i++) {
    const vec3 at(dice.between(-1.8f, 1.8f), dice.between(-0.8f, 1.0f), dice.between(-1.8f, 1.8f));
    if (i % 2 == 0) add_sphere(scene, at, 0.1f, balls, 4);
    if (i % 2 == 1) add_rectangle(scene, at, vec3(0.2f, 0.1f, 0), vec3(0, 0.1f, 0.2f), panels);
  }
  expect_same_light(scene, 256);
}

TEST(SameLight, SkyOverAPlasticFloor) {
  expect_same_light(sky(rough(0.0f, 0.5f, 0.0f, false)), 128);
}

TEST(SameLight, SkyOverAMetalFloor) {
  expect_same_light(sky(rough(1.0f, 0.5f, 0.0f, false)), 128);
}

TEST(SameLight, SkyThroughThinFrostedGlass) {
  expect_same_light(sky(rough(0.0f, 0.5f, 1.0f, false)), 128);
}

TEST(SameLight, SkyThroughFrostedGlass) {
  expect_same_light(sky(rough(0.0f, 0.5f, 1.0f, true)), 256);
}

// The inner sphere's surface does not count; rays go through it, shadow rays do not.
TEST(SameLight, SkyThroughGlassThatHoldsALesserVolume) {
  Material inner = rough(0.0f, 0.0f, 1.0f, true);
  inner.ior = 1.1f;
  Scene scene = sky(rough(0.0f, 0.5f, 1.0f, true));
  add_sphere(scene, vec3(0, 0, -2), 0.75f, add_material(scene, inner), 8);
  add_sphere(scene, vec3(0, 0, 2), 0.75f, 0, 8);
  add_sphere(scene, vec3(0, 0, 2), 0.70f, 1, 8);
  Material lamp = glowing(vec3(20.0f));
  add_sphere(scene, vec3(0, 0, 2), 0.4f, add_material(scene, lamp), 6);
  expect_same_light(scene, 512, 6);
}

TEST(SameLight, LampsAndSkyTogether) {
  Scene scene = sky(rough(0.3f, 0.6f, 0.0f, false));
  add_sphere(scene, vec3(1.5f, -0.5f, -2), 0.4f, add_material(scene, glowing(vec3(4.0f))), 6);
  expect_same_light(scene, 128);
}

// Every lobe with width that layers add, on one floor and ball.
TEST(SameLight, SkyOverLayers) {
  Scene scene = sky(rough(0.0f, 0.5f, 0.0f, false));
  MaterialLayers layers = default_layers();
  layers.clearcoat = 0.8f;
  layers.clearcoat_roughness = 0.3f;
  layers.sheen_color = vec3(0.5f);
  layers.sheen_roughness = 0.5f;
  layers.anisotropy = 0.6f;
  layers.iridescence = 0.5f;
  layers.diffuse_transmission = 0.4f;
  scene.materials[0].layers = 0;
  scene.material_layers.push_back(layers);
  expect_same_light(scene, 128);
}

TEST(SameLight, LampUnderACoat) {
  Scene scene = room(matte(vec3(0.6f)), glowing(vec3(3.0f)));
  MaterialLayers layers = default_layers();
  layers.clearcoat = 1.0f;
  scene.materials[1].layers = 0;
  scene.material_layers.push_back(layers);
  expect_same_light(scene);
}

TEST(SameLight, SkyThroughFrostedGlassThatSplitsColours) {
  Scene scene = sky(rough(0.0f, 0.5f, 1.0f, true));
  MaterialLayers layers = default_layers();
  layers.dispersion = 3.0f;
  layers.specular = 0.7f;
  scene.materials[0].layers = 0;
  scene.material_layers.push_back(layers);
  expect_same_light(scene, 1024);
}

// Diffuse transmission into a volume: what is inside is lit, and seen, through its boundary.
TEST(SameLight, SkyIntoATranslucentVolume) {
  Scene scene = sky(rough(0.0f, 0.5f, 0.0f, true));
  MaterialLayers layers = default_layers();
  layers.diffuse_transmission = 0.7f;
  scene.materials[0].layers = 0;
  scene.materials[0].attenuation_color = vec3(0.5f);
  scene.materials[0].attenuation_distance = 1.0f;
  scene.material_layers.push_back(layers);
  expect_same_light(scene, 256, 6);
}

}  // namespace
}  // namespace ods
