// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The path step where precision or bookkeeping could fail it: covers close to lamps, small triangles far away, cameras
// inside a medium, depths of surfaces that are half there.
#include "ods/kernel/path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ods/render/cpu/render.h"
#include "ods/render/lights.h"
#include "tests/support/scenes.h"

namespace ods {
namespace {

RenderOptions small_mono() {
  RenderOptions options;
  options.width = 32;
  options.samples = 16;
  options.eyes = Eyes::kMonoEye;
  return options;
}

Vertex facing_back(vec3 position) {
  Vertex v{};
  v.position = position;
  v.normal = vec3(0.0f, 0.0f, 1.0f);
  v.color = vec4(1.0f);
  return v;
}

// A panel 6 m below the ceiling glows upwards; a black sheet lies half a millimetre above it.
TEST(Path, CoverCloseToALampHidesIt) {
  Scene scene;
  Material white = default_material(), black = white, lamp = white;
  black.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  black.ior = 1.0f;
  lamp.base_color = black.base_color;
  lamp.ior = 1.0f;
  lamp.emission = vec3(10.0f);
  scene.materials = {white, black, lamp};
  const vec3 x(2.0f, 0.0f, 0.0f), z(0.0f, 0.0f, 2.0f);
  add_rectangle(scene, vec3(-1.0f, -3.0f, -1.0f), z, x, 2);
  add_rectangle(scene, vec3(-1.1f, -2.9995f, -1.1f), 1.1f * z, 1.1f * x, 1);
  add_rectangle(scene, vec3(-10.0f, 3.0f, -10.0f), 10.0f * x, 10.0f * z, 0);
  for (LightSampling way : {LightSampling::kBoth, LightSampling::kLightsOnly, LightSampling::kBsdfOnly}) {
    RenderOptions options = small_mono();
    options.light_sampling = way;
    const Picture picture = render_cpu(scene, {}, options);
    for (int y = 0; y < 3; y++) {
      for (int i = 0; i < 32; i++) EXPECT_EQ(*picture.eyes[0].radiance.at(i, y), 0.0f) << static_cast<int>(way);
    }
  }
}

TEST(Path, SmallTriangleFarAwayKeepsItsShape) {
  Scene scene;
  scene.materials = {default_material()};
  const int mesh =
      add_mesh(scene, {facing_back(vec3(0.0f)), facing_back(vec3(2e-3f, 0, 0)), facing_back(vec3(0, 2e-3f, 0))},
               {uvec3(0, 1, 2)}, 0);
  glm::mat4 far_away(1.0f);
  far_away[3] = vec4(1e5f, 0.0f, -7.0f, 1.0f);
  add_instance(scene, mesh, far_away);
  const LightTable lights = make_lights(scene);
  PathTracer tracer;
  set_scene(tracer, scene, lights);
  const Hit hit{7.0f, 0.3f, 0.3f, 0, 0};
  const auto surface = tracer.surface_at(hit, vec3(0.0f, 0.0f, -1.0f), false);
  EXPECT_NEAR(surface.geometric.z, 1.0f, 1e-6f);
  const auto triangle = tracer.triangle_of(scene.instances[0], tracer.corners_of(hit));
  EXPECT_NEAR(length(cross(triangle.ab, triangle.ac)), 4e-6f, 1e-11f);
}

// A closed room in a bright world, its walls as thin as kThinnestWall allows, further and further from the origin.
TEST(Path, WallsKeepLightOutFarFromTheOrigin) {
  const vec3 half(2.0f, 1.5f, 2.0f);
  for (const vec3 away : {vec3(300, 0, 0), vec3(1e3f, 0, 700), vec3(kFirmReach, 0, 0), vec3(4097, -4097, 4097),
                          vec3(-9e3f, 100, 5e3f), vec3(40, 33e3f, 0)}) {
    Scene scene;
    scene.materials = {default_material()};
    scene.environment.radiance = vec3(1.0f);
    const vec3 reach = abs(away) + half;
    const float wall = 1.1f * kThinnestWall * std::max({reach.x, reach.y, reach.z});
    const vec3 low = away - half, high = away + half, thick(wall);
    for (int axis = 0; axis < 3; axis++) {
      vec3 before = high + thick, behind = low - thick;
      before[axis] = low[axis];
      behind[axis] = high[axis];
      add_box(scene, low - thick, before, 0);
      add_box(scene, behind, high + thick, 0);
    }
    RenderOptions options = small_mono();
    options.width = 64;
    options.samples = 32;
    options.bounces = 3;
    StereoCamera camera;
    camera.position = away;
    const Picture picture = render_cpu(scene, camera, options);
    for (const float value : picture.eyes[0].radiance.pixels) {
      ASSERT_EQ(value, 0.0f) << away.x << ' ' << away.y << ' ' << away.z << ", walls of " << wall;
    }
  }
}

Material clear_water() {
  Material water = default_material();
  water.transmission = 1.0f;
  water.thickness = 1.0f;
  water.ior = 1.33f;
  return water;
}

// A panel that shines by itself, 2 m away through water that leaves a tenth of the light after each metre.
TEST(Path, CameraInsideAMediumSeesThroughIt) {
  Scene scene;
  Material water = clear_water();
  water.attenuation_color = vec3(0.1f);
  water.attenuation_distance = 1.0f;
  Material panel = default_material();
  panel.unlit = 1;
  scene.materials = {water, panel};
  add_box(scene, vec3(-10.0f), vec3(10.0f), 0);
  add_rectangle(scene, vec3(-5.0f, -5.0f, -2.0f), vec3(10, 0, 0), vec3(0, 10, 0), 1);
  RenderOptions options = small_mono();
  options.width = 256;
  options.filter = PixelFilter::kBox;
  const Picture picture = render_cpu(scene, {}, options);
  EXPECT_NEAR(*picture.eyes[0].radiance.at(128, 64), 0.01f, 1e-4f);
}

// A glowing box of thin air hangs in clear water: its walls bend nothing, but are seen.
TEST(Path, VolumesGlowInsideDenserOnes) {
  Scene scene;
  Material water = clear_water();
  Material lamp = water;
  lamp.ior = 1.0f;
  lamp.emission = vec3(2.0f);
  lamp.double_sided = 0;
  scene.materials = {water, lamp};
  add_box(scene, vec3(-10.0f), vec3(10.0f), 0);
  add_box(scene, vec3(-1.0f, -1.0f, -4.0f), vec3(1.0f, 1.0f, -2.0f), 1);
  for (LightSampling way : {LightSampling::kBoth, LightSampling::kBsdfOnly}) {
    RenderOptions options = small_mono();
    options.filter = PixelFilter::kBox;
    options.light_sampling = way;
    const Picture picture = render_cpu(scene, {}, options);
    EXPECT_NEAR(*picture.eyes[0].radiance.at(16, 8), 2.0f, 0.01f);  // its front; the rest is the water's far wall
    EXPECT_LT(*picture.eyes[0].radiance.at(0, 8), 0.1f);
  }
}

TEST(Path, DepthOfAVeilIsNotALottery) {
  for (float alpha : {0.4f, 0.6f}) {
    Scene scene;
    Material veil = default_material();
    veil.alpha_mode = kAlphaBlend;
    veil.base_color.w = alpha;
    scene.materials = {veil, default_material()};
    add_box(scene, vec3(-1.0f), vec3(1.0f), 0);
    add_box(scene, vec3(-5.0f), vec3(5.0f), 1);
    const Picture picture = render_cpu(scene, {}, small_mono());
    const auto& depths = picture.eyes[0].depth.pixels;
    for (float depth : depths) EXPECT_EQ(depth<1.8f, alpha> 0.5f) << depth;
  }
}

}  // namespace
}  // namespace ods
