// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Each feature of scenes, cameras and options on a card, in a small scene, against the CPU.
#include <memory>

#include "ods/image/image.h"
#include "ods/render/cpu/render.h"
#include "ods/render/gpu/gpu_renderer.h"
#include "ods/scene/reduced_textures.h"
#include "tests/render/gpu/agreement.h"
#include "tests/support/layered_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/texels.h"

namespace ods::gpu_features_test {

Material colored(vec3 color, float roughness) {
  Material material = matte(color);
  material.roughness = roughness;
  return material;
}

// A box of 3 x 2.2 x 4 m around the viewer, with a glowing ball, and a rough and a smooth one.
Scene lit_box() {
  Scene scene;
  add_box(scene, vec3(-1.5f, -1.0f, -2.0f), vec3(1.5f, 1.2f, 2.0f), add_material(scene, matte(vec3(0.7f, 0.5f, 0.3f))));
  add_sphere(scene, vec3(0.6f, 0.8f, -0.8f), 0.2f, add_material(scene, glow(vec3(4, 3, 2))), 12);
  add_sphere(scene, vec3(-0.2f, 0.0f, -0.7f), 0.3f, add_material(scene, colored(vec3(0.5f, 0.2f, 0.6f), 0.25f)), 12);
  add_sphere(scene, vec3(0.0f, -0.1f, 0.8f), 0.3f, add_material(scene, metal(vec3(0.9f, 0.7f, 0.4f), 0.1f)), 12);
  return scene;
}

// A floor under a uniform sky.
Scene open_floor() {
  Scene scene;
  const int texture =
      add_texture(scene, 16, 16, [](vec2 uv) { return uv.x > uv.y ? vec3(0.8f) : vec3(0.2f, 0.4f, 0.1f); });
  const Material tiles = textured(matte(vec3(1.0f)), texture, vec2(1.0f));
  add_rectangle(scene, vec3(-9, -1, 9), vec3(18, 0, 0), vec3(0, 0, -18), add_material(scene, tiles));
  add_sphere(scene, vec3(0.5f, -0.5f, -1.5f), 0.5f, add_material(scene, colored(vec3(0.6f), 0.3f)), 12);
  scene.environment.radiance = vec3(0.4f, 0.5f, 0.7f);
  return scene;
}

void expect_same(const Scene& scene, const RenderOptions& options, const std::string& name,
                 const std::shared_ptr<GpuDevice>& card, const StereoCamera& camera = {}) {
  expect_agreement(sampled(CpuRenderer(scene), camera, options), sampled(GpuRenderer(scene, card), camera, options),
                   name);
}

class GpuFeatures : public OnCard {};

TEST_F(GpuFeatures, InstancesAndFacesThatAreThereTwice) {
  Scene scene = lit_box();
  const Shape box = make_box(vec3(0.25f));
  Material one_sided = matte(vec3(0.2f, 0.6f, 0.3f));
  one_sided.double_sided = 0;
  const int outside = add_material(scene, one_sided);
  one_sided.base_color = vec4(0.9f, 0.1f, 0.1f, 1.0f);
  const int inside = add_material(scene, one_sided);
  add(scene, box, outside, placed(vec3(-0.6f, -0.6f, -0.9f)));
  add(scene, inside_out(box), inside, placed(vec3(-0.6f, -0.6f, -0.9f)));
  const int mesh = scene.instances.back().mesh;
  for (int i = 1; i < 6; i++) {
    const float x = 0.3f * static_cast<float>(i);
    add_instance(scene, mesh, placed(vec3(x - 0.6f, -0.6f, -0.9f), 20.0f * x, vec3(i % 2 == 0 ? 1.0f : -1.0f, 1, 1)));
    add_instance(scene, mesh - 1,
                 placed(vec3(x - 0.6f, -0.6f, -0.9f), 20.0f * x, vec3(i % 2 == 0 ? 1.0f : -1.0f, 1, 1)));
  }
  expect_same(scene, small_options(), "instances", card);
}

TEST_F(GpuFeatures, AlphaMasksAndVeils) {
  Scene scene = lit_box();
  Material veil = matte(vec3(0.2f, 0.6f, 0.3f));
  veil.alpha_mode = kAlphaBlend;
  veil.base_color.w = 0.4f;
  add_rectangle(scene, vec3(0.7f, -0.6f, -0.9f), vec3(0.0f, 0.0f, 0.9f), vec3(0.0f, 0.9f, 0.0f),
                add_material(scene, veil));
  Material mask = matte(vec3(0.9f));
  mask.alpha_mode = kAlphaMask;
  mask.alpha_cutoff = 0.5f;
  const int holes =
      add_rectangle(scene, vec3(-1.0f, -0.6f, -1.2f), vec3(0.9f, 0, 0), vec3(0, 0.9f, 0), add_material(scene, mask));
  Vertex* corner = &scene.vertices[static_cast<size_t>(scene.meshes[static_cast<size_t>(holes)].first_vertex)];
  corner[0].color.w = corner[3].color.w = 0.0f;  // half of the rectangle is a hole
  expect_same(scene, small_options(), "alpha", card);
}

// Glass with colour inside, from outside and from within, refracted and straight.
TEST_F(GpuFeatures, VolumesAndTheViewerInOne) {
  Scene scene = lit_box();
  Material solid = glass(1.5f);
  solid.thickness = 1.0f;
  solid.attenuation_color = vec3(0.4f, 0.8f, 0.6f);
  solid.attenuation_distance = 0.3f;
  const int material = add_material(scene, solid);
  add_sphere(scene, vec3(0.5f, -0.2f, -0.9f), 0.3f, material, 16);
  RenderOptions options = small_options();
  expect_same(scene, options, "refracted", card);
  options.caustics = Caustics::kStraight;
  expect_same(scene, options, "straight", card);
  add_sphere(scene, vec3(0.0f), 0.2f, material, 16);
  expect_same(scene, options, "from within", card);
}

TEST_F(GpuFeatures, LayersOfMaterials) {
  skip_on_software();
  if (IsSkipped()) return;
  expect_same(layered_scene(), small_options(), "layers", card);
}

TEST_F(GpuFeatures, ShadowCatchers) {
  skip_on_software();
  if (IsSkipped()) return;
  Scene scene = open_floor();
  scene.instances.front().role = kCatcher;
  PunctualLight lamp;
  lamp.position = vec3(-1.0f, 2.0f, -1.0f);
  lamp.intensity = vec3(6.0f);
  scene.lights.push_back(lamp);
  RenderOptions options = small_options();
  options.transparent = true;
  expect_same(scene, options, "catchers", card);
}

TEST_F(GpuFeatures, LightsOfEveryKind) {
  Scene scene = open_floor();
  for (int kind : {kLightPoint, kLightSpot, kLightDirectional}) {
    PunctualLight light;
    light.kind = kind;
    light.position = vec3(static_cast<float>(kind) - 1.5f, 1.5f, -1.0f);
    light.direction = normalize(vec3(0.2f, -1.0f, -0.3f));
    light.intensity = vec3(1.0f + static_cast<float>(kind));
    light.size = 0.05f;
    scene.lights.push_back(light);
  }
  expect_same(scene, small_options(), "lights", card);
}

TEST_F(GpuFeatures, PicturesOfTheSkyAndOfTheBackground) {
  Scene scene = open_floor();
  Environment& sky = scene.environment;
  sky.width = 32, sky.height = 16;
  for (int i = 0; i < sky.width * sky.height; i++)
    sky.texels.push_back(i == 100 ? vec3(300.0f) : vec3(0.2f, 0.3f, 0.5f));
  expect_same(scene, small_options(), "sky", card);
  scene.background = Environment{vec3(0.1f, 0.6f, 0.2f), 0, 0, {}};
  expect_same(scene, small_options(), "background", card);
}

TEST_F(GpuFeatures, ManyLamps) {
  Scene scene = lit_box();
  Dice dice(11);
  for (int i = 0; i < 60; i++) {
    const vec3 at(dice.between(-1.3f, 1.3f), dice.between(0.2f, 1.1f), dice.between(-1.8f, 1.8f));
    const vec3 light(dice.between(1, 9), dice.between(1, 9), dice.between(1, 9));
    if (length(at) < 0.4f) continue;
    add(scene, make_box(vec3(0.05f)), add_material(scene, glow(light)), placed(at));
  }
  expect_same(scene, small_options(), "many lamps", card);
}

TEST_F(GpuFeatures, WhatOnlySomeRaysSee) {
  for (const int role : {kUnseen, kPureLight, kOutline, kDimmedLamp, kFadingGround}) {
    Scene scene = lit_box();
    add_sphere(scene, vec3(0.3f, 0.2f, -0.8f), 0.15f, add_material(scene, glow(vec3(3, 2, 6))), 12);
    scene.instances.back().role = role;
    expect_same(scene, small_options(), "role " + std::to_string(role), card);
  }
}

TEST_F(GpuFeatures, ReducedTextures) {
  Scene scene = open_floor();
  reduce_textures(scene);
  expect_same(scene, small_options(), "reduced textures", card);
}

TEST_F(GpuFeatures, TransparentBackgrounds) {
  RenderOptions options = small_options();
  options.transparent = true;
  expect_same(open_floor(), options, "transparent", card);
}

TEST_F(GpuFeatures, OptionsOfPaths) {
  const Scene scene = lit_box();
  RenderOptions options = small_options();
  options.clamp = 0.5f, options.bounces = 3, options.filter = PixelFilter::kBox, options.even_noise = false;
  expect_same(scene, options, "clamp", card);
  for (const LightSampling way : {LightSampling::kLightsOnly, LightSampling::kBsdfOnly}) {
    options.light_sampling = way;
    expect_same(scene, options, "light sampling", card);
  }
}

TEST_F(GpuFeatures, EyesAndTheirSharedPaths) {
  const Scene scene = lit_box();
  RenderOptions options = small_options();
  options.share_paths = false;
  expect_same(scene, options, "paths of their own", card);
  for (const Eyes eyes : {Eyes::kMonoEye, Eyes::kLeftEye, Eyes::kRightEye}) {
    options.eyes = eyes;
    expect_same(scene, options, "one eye", card);
  }
}

TEST_F(GpuFeatures, CamerasWithALensAndMaps) {
  const Scene scene = lit_box();
  StereoCamera camera;
  camera.lens_radius = 0.02f;
  expect_same(scene, small_options(), "lens", card, camera);
  camera = {};
  camera.yaw = 40.0f, camera.pitch = 10.0f, camera.neck = 0.05f, camera.convergence = kToeIn;
  camera.top = {kMergeMap, 0.0f, 90.0f, 1.0f};
  camera.merge_map = std::make_shared<const Image>([] {
    Image map(8, 4, 1);
    for (size_t i = 0; i < map.pixels.size(); i++) map.pixels[i] = static_cast<float>(i % 3) / 2.0f;
    return map;
  }());
  camera.head_tilt_map = camera.merge_map;
  expect_same(scene, small_options(), "maps", card, camera);
}

TEST_F(GpuFeatures, AProjectionWithEmptyCorners) {
  StereoCamera camera;
  camera.projection.kind = kFisheye;
  RenderOptions options = small_options();
  options.height = 0;
  expect_same(lit_box(), with_height(options, camera), "fisheye", card, camera);
}

TEST_F(GpuFeatures, RaysFromATable) {
  TexelRays texels = texels_of(StereoCamera{}, 32, 16);
  for (size_t i = 0; i < texels.rays.size(); i++) {
    texels.rays[i].across = vec3(0.2f, 0.0f, 0.1f), texels.rays[i].down = vec3(0.0f, 0.3f, 0.0f);
    if (i % 5 == 0) texels.rays[i].direction = vec3(0.0f);
  }
  expect_same(lit_box(), with_texels(small_options(), 32, 16), "texels", card, camera_of(texels));
}

// Blocks stop at their noise: about as many samples, and the same picture.
TEST_F(GpuFeatures, AdaptiveSampling) {
  const Scene scene = lit_box();
  RenderOptions options = small_options();
  options.samples = 64, options.noise = 0.15f;
  const StereoCamera camera;
  const PictureSamples cpu = sampled(CpuRenderer(scene), camera, options);
  const PictureSamples gpu = sampled(GpuRenderer(scene, card), camera, options);
  const auto all = static_cast<double>(2 * options.width * options.height * options.samples);
  EXPECT_LT(static_cast<double>(count_samples(cpu)), 0.95 * all) << "else this test shows nothing";
  EXPECT_NEAR(static_cast<double>(count_samples(gpu)), static_cast<double>(count_samples(cpu)), 0.05 * all);
  expect_same_light(cpu, gpu);
}

}  // namespace ods::gpu_features_test
