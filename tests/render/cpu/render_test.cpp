// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The CPU renderer against closed forms.
#include "ods/render/cpu/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "ods/base/error.h"
#include "ods/kernel/camera/project.h"
#include "ods/kernel/path.h"
#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "ods/render/render_target.h"
#include "ods/render/tables.h"
#include "tests/support/lambert.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

TEST(Render, WhiteFurnaceBoxIsExactInEveryPixel) {
  Scene scene;
  Material wall = matte(vec3(1.0f));
  wall.emission = vec3(0.7f);
  add_box(scene, vec3(-1.0f, -2.0f, -1.5f), vec3(2.0f, 1.0f, 1.0f), add_material(scene, wall));
  RenderOptions options = small_render(32, 4);
  options.eyes = Eyes::kBothEyes;
  options.share_paths = false;
  options.bounces = 4;
  options.light_sampling = LightSampling::kBsdfOnly;
  for (const EyeImage& eye : render_cpu(scene, StereoCamera{}, options).eyes) {
    for (float value : eye.radiance.pixels) ASSERT_NEAR(value, 5 * 0.7f, 1e-4f);
  }
}

// e (1 + a + a^2 + ... + a^n), whichever way the light is found; a dim box plays Russian roulette at every bounce.
TEST(Render, RussianRouletteKeepsTheMeanOfAFurnace) {
  for (float albedo : {0.2f, 0.5f, 0.8f}) {
    Scene scene;
    Material wall = matte(vec3(albedo));
    wall.emission = vec3(1.0f);
    add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, wall));
    for (LightSampling sampling : {LightSampling::kBoth, LightSampling::kLightsOnly, LightSampling::kBsdfOnly}) {
      RenderOptions options = small_render(64, 32);
      options.bounces = 6;
      options.light_sampling = sampling;
      const Mean mean = mean_of(render_cpu(scene, StereoCamera{}, options).eyes[0].radiance);
      const double exact = (1.0 - std::pow(double{albedo}, 7)) / (1.0 - double{albedo});
      EXPECT_LT(std::abs(mean.value() - exact), 4.0 * std::sqrt(mean.variance()) + 1e-5) << albedo;
      // Lamps that touch the wall they light: without the other way their light varies without end.
      if (sampling != LightSampling::kLightsOnly) {
        EXPECT_NEAR(mean.value(), exact, 0.01 * exact);
      }
    }
  }
}

// 60 spheres all round: ahead, behind, across the seam, high, low, from 0.3 m to 50 m.
TEST(Stereo, SpheresAppearWhereTheFormulaSays) {
  const int width = 512, count = 60;
  const float size = 0.022f;  // radians
  Scene scene;
  Material glow = default_material();
  glow.emission = vec3(1.0f);
  const int material = add_material(scene, glow);
  StereoCamera stereo;
  stereo.position = vec3(0.5f, 1.0f, -0.25f);
  stereo.yaw = 30.0f;
  const Camera camera = make_camera(stereo);
  std::vector<vec3> centers;
  for (int i = 0; i < count; i++) {
    const float y = 0.95f * (1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / count);
    const float turn = static_cast<float>(i) * 2.399963f, r = std::sqrt(1.0f - y * y);
    const vec3 local(r * std::sin(turn), y, -r * std::cos(turn));
    const float distance = 0.3f * std::pow(50.0f / 0.3f, static_cast<float>(i * 7 % count) / (count - 1));
    centers.push_back(stereo.position +
                      distance * (local.x * camera.right + local.y * camera.up + local.z * camera.back));
    add_sphere(scene, centers.back(), size * distance, material, 16);
  }
  RenderOptions options = small_render(width, 64);
  options.eyes = Eyes::kBothEyes;
  options.bounces = 0;
  for (const EyeImage& image : render_cpu(scene, stereo, options).eyes) {
    for (const vec3& center : centers) {
      const ImagePosition place = project_point(camera, image.eye, center);
      ASSERT_TRUE(place.seen);
      // The centroid on the sphere of directions: there a small disc is round, near the poles too.
      const vec3 towards = camera_ray(camera, image.eye, place.uv).direction;
      glm::dvec3 sum(0.0);
      for (int y = 0; y < width / 2; y++) {
        const vec2 row(0.0f, (static_cast<float>(y) + 0.5f) / (width / 2));
        const float cosine = std::sin(kPi * row.y);
        for (int x = 0; x < width; x++) {
          const vec2 uv((static_cast<float>(x) + 0.5f) / width, row.y);
          const vec3 direction = camera_ray(camera, image.eye, uv).direction;
          if (dot(direction, towards) < std::cos(3.0f * size)) continue;
          sum += glm::dvec3(direction) * double{*image.radiance.at(x, y) * cosine};
        }
      }
      ASSERT_GT(length(sum), 1.0);
      const double pixels = length(normalize(sum) - glm::dvec3(towards)) * width / (2.0 * std::numbers::pi);
      EXPECT_LT(pixels, 0.05) << image.eye << ' ' << place.uv.x << ' ' << place.uv.y << ' ' << place.depth;
    }
  }
}

// --- a matte floor one metre below the camera under lamps ------------------------------------------------------------

constexpr float kAlbedo = 0.6f;

Scene floor_scene(float height = 0.0f) {
  Scene scene;
  add_rectangle(scene, vec3(-100, height - 1, 100), vec3(200, 0, 0), vec3(0, 0, -200),
                add_material(scene, matte(vec3(kAlbedo))));
  return scene;
}

// Compares the floor with albedo / pi times an irradiance of the place (x, z), pixel by pixel and in the mean.
void expect_floor(const Scene& scene, int samples, double tolerance,
                  const std::function<double(glm::dvec3)>& irradiance, float height = 0.0f) {
  RenderOptions options = small_render(32, samples);
  options.bounces = 1;
  StereoCamera stereo;
  stereo.position.y = height;
  const Picture picture = render_cpu(scene, stereo, options);
  for (int y = 9; y < 16; y++) {
    for (int x = 0; x < 32; x++) {
      const double expected = pixel_mean(
          32, x, y, [&](glm::dvec3 d) { return irradiance(d * (-1.0 / d.y)) * double{kAlbedo} / std::numbers::pi; });
      ASSERT_NEAR(double{*picture.eyes[0].radiance.at(x, y)}, expected, tolerance * expected + 1e-4) << x << ' ' << y;
    }
  }
}

TEST(Lamps, Point) {
  Scene scene = floor_scene();
  PunctualLight lamp;
  lamp.position = vec3(0.5f, 1.0f, 0.25f);
  lamp.intensity = vec3(7.0f);
  scene.lights.push_back(lamp);
  const auto irradiance = [&](glm::dvec3 p) {
    const glm::dvec3 to = glm::dvec3(lamp.position) - p;
    return 7.0 * to.y / std::pow(length(to), 3.0);
  };
  expect_floor(scene, 64, 0.01, irradiance);
  scene.lights[0].range = 3.0f;
  expect_floor(scene, 64, 0.01, [&](glm::dvec3 p) {
    return irradiance(p) * std::max(1.0 - std::pow(length(glm::dvec3(lamp.position) - p) / 3.0, 4.0), 0.0);
  });
}

TEST(Lamps, Spot) {
  Scene scene = floor_scene();
  PunctualLight lamp;
  lamp.kind = kLightSpot;
  lamp.position = vec3(0.0f, 1.0f, 0.0f);
  lamp.direction = vec3(0.0f, -1.0f, 0.0f);
  lamp.intensity = vec3(5.0f);
  lamp.inner_cone = 0.3f;
  lamp.outer_cone = 0.9f;
  scene.lights.push_back(lamp);
  expect_floor(scene, 256, 0.01, [&](glm::dvec3 p) {
    const double distance = length(glm::dvec3(p.x, 2.0, p.z)), cosine = 2.0 / distance;
    const double cone = std::clamp((cosine - std::cos(0.9)) / (std::cos(0.3) - std::cos(0.9)), 0.0, 1.0);
    return 5.0 * cosine * cone * cone / (distance * distance);
  });
}

TEST(Lamps, Directional) {
  Scene scene = floor_scene();
  PunctualLight sun;
  sun.kind = kLightDirectional;
  sun.direction = vec3(0.6f, -0.8f, 0.0f);
  sun.intensity = vec3(3.0f);
  scene.lights.push_back(sun);
  expect_floor(scene, 4, 1e-5, [](glm::dvec3) { return 3.0 * 0.8; });
}

// The shadow at a great height, where single precision is coarse and a shadow ray starts well off the floor.
TEST(Lamps, Rectangle) {
  for (float height : {0.0f, 40.0f}) {
    Scene scene = floor_scene(height);
    Material glow = matte(vec3(0.0f));
    glow.emission = vec3(4.0f);
    glow.double_sided = 0;
    const vec3 at(-0.5f, height + 0.5f, -1.0f);
    add_rectangle(scene, at, vec3(1.5f, 0, 0), vec3(0, 0, 1.0f), add_material(scene, glow));
    const std::vector<glm::dvec3> corners = {{-0.5, 0.5, -1}, {1, 0.5, -1}, {1, 0.5, 0}, {-0.5, 0.5, 0}};
    expect_floor(
        scene, 1024, 0.04, [&](glm::dvec3 p) { return polygon_irradiance(p, corners, 4.0); }, height);
  }
}

// --- a matte sphere of radius 1, 2.5 metres ahead, under a lamp ------------------------------------------------------

const glm::dvec3 kSphere(0.0, 0.0, -2.5), kLamp(1.5, 2.0, -0.5);

// Compares every pixel that sees nothing but the lit side of the sphere with albedo / pi times an irradiance of a point
// and its normal.
void expect_sphere(Scene scene, double albedo, double tolerance,
                   const std::function<double(glm::dvec3, glm::dvec3)>& irradiance) {
  add_sphere(scene, vec3(kSphere), 1.0f, add_material(scene, matte(vec3(static_cast<float>(albedo)))), 128);
  RenderOptions options = small_render(128, 256);
  options.bounces = 1;
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  int compared = 0;
  for (int y = 0; y < 64; y++) {
    for (int x = 0; x < 128; x++) {
      bool lit = true;
      const double expected = pixel_mean(128, x, y, [&](glm::dvec3 d) {
        const double middle = dot(d, kSphere), root = middle * middle - dot(kSphere, kSphere) + 1.0;
        const glm::dvec3 p = d * (middle - std::sqrt(std::max(root, 0.0))), normal = p - kSphere;
        lit = lit && middle > 0.0 && root > 0.01 && dot(normalize(kLamp - p), normal) > 0.15;
        return irradiance(p, normal) * albedo / std::numbers::pi;
      });
      if (!lit) continue;
      compared++;
      ASSERT_NEAR(double{*picture.eyes[0].radiance.at(x, y)}, expected, tolerance * expected) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Sphere, UnderAPoint) {
  Scene scene;
  PunctualLight lamp;
  lamp.position = vec3(kLamp);
  lamp.intensity = vec3(9.0f);
  scene.lights.push_back(lamp);
  for (const double albedo : {1.0, 0.5}) {
    expect_sphere(scene, albedo, 0.003, [&](glm::dvec3 p, glm::dvec3 normal) {
      return 9.0 * dot(kLamp - p, normal) / std::pow(length(kLamp - p), 3.0);
    });
  }
}

TEST(Sphere, UnderASmallRectangle) {
  const glm::dvec3 a(0.2, 0.0, 0.0), b(0.0, 0.1, 0.2), low = kLamp - 0.5 * (a + b);
  Scene scene;
  Material glow = matte(vec3(0.0f));
  glow.emission = vec3(200.0f);
  add_rectangle(scene, vec3(low), vec3(a), vec3(b), add_material(scene, glow));
  const std::vector<glm::dvec3> corners = {low, low + a, low + a + b, low + b};
  for (const double albedo : {1.0, 0.5}) {
    expect_sphere(scene, albedo, 0.01,
                  [&](glm::dvec3 p, glm::dvec3 normal) { return polygon_irradiance(p, corners, 200.0, normal); });
  }
}

// --- what the camera sees --------------------------------------------------------------------------------------------

TEST(Render, FirstHitLayers) {
  Scene scene = floor_scene();
  const Picture picture = render_cpu(scene, StereoCamera{}, small_render(32, 2));
  const EyeImage& eye = picture.eyes[0];
  for (int y = 0; y < 16; y++) {
    for (int x = 0; x < 32; x++) {
      const float fall = -std::sin(kPi * (0.5f - (static_cast<float>(y) + 0.5f) / 16.0f));
      const bool below = y >= 8;
      ASSERT_NEAR(*eye.depth.at(x, y), below ? 1.0f / fall : kFarDepth, below ? 1e-4f / fall : 0.0f);
      if (y == 8) continue;  // looks past the floor's end
      for (int c = 0; c < 3; c++) {
        ASSERT_NEAR(eye.normal.at(x, y)[c], below && c == 1 ? 1.0f : 0.0f, 1e-6f);
        ASSERT_NEAR(eye.albedo.at(x, y)[c], below ? kAlbedo : 0.0f, 1e-6f);
      }
    }
  }
}

TEST(Render, APictureLargerThanTheMemoryIsAnError) {
  RenderOptions options = small_render(1 << 24, 1);
  try {
    render_cpu(floor_scene(), StereoCamera{}, options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kMemory);
  }
}

// A wall ahead that fills the picture's middle; returns what the middle pixels average to.
double middle_of(const Scene& scene, int samples = 256) {
  RenderOptions options = small_render(32, samples);
  const Picture picture = render_cpu(scene, StereoCamera{}, options);
  double sum = 0.0;
  for (int y = 6; y < 10; y++) {
    for (int x = 14; x < 18; x++) sum += double{*picture.eyes[0].radiance.at(x, y)} / 16.0;
  }
  return sum;
}

// side: which side of the wall its front is on, +1 towards the camera.
Scene wall_scene(const Material& material, float side = 1.0f) {
  Scene scene;
  add_rectangle(scene, vec3(-3.0f * side, -3, -1), vec3(6.0f * side, 0, 0), vec3(0, 6, 0),
                add_material(scene, material));
  return scene;
}

// Before the sky that was left out, it is what it would have been with it.
TEST(Render, TransparentBeforeTheSkyIsThePicture) {
  Scene scene;
  add_box(scene, vec3(-1.0f, -1.0f, -4.0f), vec3(1.0f, 0.5f, -2.0f), add_material(scene, matte(vec3(0.6f))));
  scene.environment.radiance = vec3(0.5f);
  RenderOptions options = small_render(64, 8);
  const Picture whole = render_cpu(scene, StereoCamera{}, options);
  options.transparent = true;
  const EyeImage cut = render_cpu(scene, StereoCamera{}, options).eyes[0];
  int edges = 0;
  for (size_t i = 0; i < cut.radiance.pixels.size(); i++) {
    const float alpha = cut.alpha.pixels[i / 3];
    edges += alpha > 0.0f && alpha < 1.0f;
    ASSERT_NEAR(cut.radiance.pixels[i] + (1.0f - alpha) * 0.5f, whole.eyes[0].radiance.pixels[i], 1e-5f) << i;
  }
  EXPECT_GT(edges, 30);
}

TEST(Render, UnlitIsItsColor) {
  Material material = default_material();
  material.base_color = vec4(0.25f, 0.5f, 0.75f, 1.0f);
  material.unlit = 1;
  Scene scene = wall_scene(material);
  scene.environment.radiance = vec3(10.0f);
  EXPECT_NEAR(middle_of(scene, 4), 0.25, 1e-6);
}

TEST(Render, AlphaCoversItsShare) {
  Material material = default_material();
  material.unlit = 1;
  for (float alpha : {0.0f, 0.3f, 0.49f, 0.5f, 1.0f}) {
    material.base_color.w = alpha;
    material.alpha_mode = kAlphaBlend;
    const double a = double{alpha};
    EXPECT_NEAR(middle_of(wall_scene(material)), a, 4.0 * std::sqrt(a * (1.0 - a) / 4096.0) + 1e-6);
    material.alpha_mode = kAlphaMask;
    EXPECT_NEAR(middle_of(wall_scene(material), 4), alpha >= 0.5f ? 1.0 : 0.0, 1e-6);
    material.alpha_mode = kAlphaOpaque;
    EXPECT_NEAR(middle_of(wall_scene(material), 4), 1.0, 1e-6);
  }
}

// The camera looks through the back of a single-sided surface; light does not.
TEST(Render, BacksAreCulledForTheCameraOnly) {
  Material wall = default_material();
  wall.unlit = 1;
  wall.double_sided = 0;
  EXPECT_EQ(middle_of(wall_scene(wall), 4), 1.0);
  EXPECT_EQ(middle_of(wall_scene(wall, -1.0f), 4), 0.0);

  wall.unlit = 0;
  for (int double_sided : {0, 1}) {
    wall.double_sided = double_sided;
    Scene scene = floor_scene();
    add_rectangle(scene, vec3(-50, 2, -50), vec3(100, 0, 0), vec3(0, 0, 100), add_material(scene, wall));
    PunctualLight sun;
    sun.kind = kLightDirectional;
    sun.direction = vec3(0.0f, -1.0f, 0.0f);
    scene.lights.push_back(sun);
    RenderOptions options = small_render(32, 4);
    options.bounces = 1;
    const Picture picture = render_cpu(scene, StereoCamera{}, options);
    EXPECT_EQ(*picture.eyes[0].radiance.at(16, 14), 0.0f) << "the floor lies in shadow";
  }
}

// A negative scale turns the winding round; front stays front.
TEST(Render, MirroredInstancesKeepTheirFront) {
  for (float mirror : {1.0f, -1.0f}) {
    Scene scene;
    Material glow = default_material();
    glow.emission = vec3(1.0f);
    glow.double_sided = 0;
    add_rectangle(scene, vec3(-3, -3, -1), vec3(6, 0, 0), vec3(0, 6, 0), add_material(scene, glow));
    scene.instances.clear();
    glm::mat4 place(1.0f);
    place[0][0] = mirror;
    add_instance(scene, 0, place);
    const Picture picture = render_cpu(scene, StereoCamera{}, small_render(32, 4));
    EXPECT_GE(*picture.eyes[0].radiance.at(16, 8), 1.0f);
    EXPECT_NEAR(picture.eyes[0].normal.at(16, 8)[2], 1.0f, 1e-6f);
  }
}

TEST(Environment, LooksAsItWasGiven) {
  Scene scene;
  const int width = 32, height = 16;
  scene.environment.radiance = vec3(2.0f, 1.0f, 1.0f);
  scene.environment.width = width;
  scene.environment.height = height;
  for (int i = 0; i < width * height; i++) {
    const float u = (static_cast<float>(i % width) + 0.5f) / width, v = (static_cast<float>(i / width) + 0.5f) / height;
    scene.environment.texels.push_back(vec3(1.0f + std::sin(2.0f * kPi * u), v, 1.0f));
  }
  const Picture picture = render_cpu(scene, StereoCamera{}, small_render(width, 256));
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      const vec3 texel = scene.environment.texels[static_cast<size_t>(y * width + x)] * scene.environment.radiance;
      for (int c = 0; c < 3; c++) ASSERT_NEAR(picture.eyes[0].radiance.at(x, y)[c], texel[c], 0.02f) << x << ' ' << y;
    }
  }
}

// --- the same picture, another way -----------------------------------------------------------------------------------

TEST(SameBits, WhateverTheThreadsAndTheOrderOfTiles) {
  const Scene scene = feature_scene();
  RenderOptions options = small_render(48, 4);
  options.eyes = Eyes::kBothEyes;
  options.filter = PixelFilter::kBlackmanHarris;
  options.bounces = 6;
  std::vector<Picture> pictures;
  for (int threads : {1, 2, 3}) {
    options.threads = threads;
    pictures.push_back(render_cpu(scene, StereoCamera{}, options));
  }
  EXPECT_EQ(digest(pictures[0]), digest(pictures[1]));
  EXPECT_EQ(digest(pictures[0]), digest(pictures[2]));
  options.last_tile_first = true;
  EXPECT_EQ(digest(pictures[0]), digest(render_cpu(scene, StereoCamera{}, options)));
  options.seed = 1;
  EXPECT_NE(digest(pictures[0]), digest(render_cpu(scene, StereoCamera{}, options)));
}

TEST(SameBits, WhoeverElseRenders) {
  const Scene with_glass = feature_scene();
  Scene without;
  add_box(without, vec3(-1.0f), vec3(1.0f), add_material(without, matte(vec3(0.5f))));
  RenderOptions options = small_render(32, 2);
  options.threads = 2;
  std::vector<std::thread> callers;
  std::vector<uint64_t> seen(4);
  for (size_t i = 0; i < seen.size(); i++) {
    callers.emplace_back(
        [&, i] { seen[i] = digest(render_cpu(i % 2 == 0 ? without : with_glass, StereoCamera{}, options)); });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(seen[0], digest(render_cpu(without, StereoCamera{}, options)));
  EXPECT_EQ(seen[1], digest(render_cpu(with_glass, StereoCamera{}, options)));
  EXPECT_EQ(seen[0], seen[2]);
  EXPECT_EQ(seen[1], seen[3]);
}

TEST(Embree, InstancesAreMetLikeCopies) {
  Scene scene;
  const int mesh = add_sphere(scene, vec3(0.0f), 0.5f, add_material(scene, default_material()), 8);
  for (int i = 0; i < 5; i++) {
    glm::mat4 place(1.0f);
    place[0] = vec4(1.0f, 0.3f * static_cast<float>(i), 0.0f, 0.0f);
    place[1][1] = i % 2 == 0 ? 1.0f : -0.7f;
    place[3] = vec4(static_cast<float>(i) - 2.0f, 1.0f, -3.0f, 1.0f);
    add_instance(scene, mesh, place);
  }
  const EmbreeScene copied(scene), instanced(scene, 0);
  PathTracer tracer;
  Dice dice(1);
  int met = 0;
  for (int i = 0; i < 5000; i++) {
    const vec3 target(dice.between(-4, 4), dice.between(-1, 2), -3.0f);
    const Ray ray{vec3(0.0f), normalize(target)};
    const Hit a = copied.closest_hit(tracer, ray, kPathRay), b = instanced.closest_hit(tracer, ray, kPathRay);
    ASSERT_EQ(a.instance, b.instance);
    ASSERT_NEAR(a.t, b.t, 1e-5f);
    EXPECT_EQ(copied.occluded(tracer, ray, 100.0f), instanced.occluded(tracer, ray, 100.0f));
    met += a.t > 0.0f;
    if (a.triangle != b.triangle) continue;  // an edge's ray may go to either side
    ASSERT_NEAR(a.u, b.u, 1e-4f);
    ASSERT_NEAR(a.v, b.v, 1e-4f);
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace ods
