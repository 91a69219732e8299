// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Lamps that the camera does not see, and lights that have a size, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ods/render/cpu/embree_scene.h"
#include "ods/render/cpu/render.h"
#include "ods/render/lights.h"
#include "ods/render/render_target.h"
#include "tests/support/lambert.h"
#include "tests/support/pictures.h"

namespace ods::unseen_test {

constexpr double kPiD = std::numbers::pi;
constexpr LightSampling kWays[] = {LightSampling::kBoth, LightSampling::kLightsOnly, LightSampling::kBsdfOnly};
constexpr int kRoles[] = {kUnseen, kPureLight};

// A matte floor a metre below the camera.
Scene floor_scene() {
  Scene scene;
  add_rectangle(scene, vec3(-100, -1, 100), vec3(200, 0, 0), vec3(0, 0, -200), add_material(scene, matte(vec3(1.0f))));
  return scene;
}

// A square metre that shines down, of a material that reflects nothing.
void add_lamp(Scene& scene, float height, float watts, int role) {
  Material glow = matte(vec3(0.0f));
  glow.emission = vec3(static_cast<float>(double{watts} / kPiD));
  glow.double_sided = 0;
  add_rectangle(scene, vec3(-0.5f, height, -0.5f), vec3(1, 0, 0), vec3(0, 0, 1), add_material(scene, glow));
  scene.instances.back().role = role;
}

RenderOptions once(int width, int samples) {
  RenderOptions options = small_render(width, samples);
  options.bounces = 1;
  return options;
}

void expect_floor(const Picture& picture, const std::function<double(glm::dvec3)>& irradiance, double tolerance) {
  for (const EyeImage& eye : picture.eyes) {
    const int width = eye.radiance.width;
    for (int y = width * 3 / 8; y < width / 2; y++) {
      double row = 0.0, expected = 0.0;
      for (int x = 0; x < width; x++) {
        row += double{*eye.radiance.at(x, y)};
        expected += pixel_mean(width, x, y, [&](glm::dvec3 d) { return irradiance(d * (-1.0 / d.y)) / kPiD; });
      }
      EXPECT_NEAR(row, expected, tolerance * expected) << "row " << y;
    }
  }
}

// Between the camera and the floor, so that the camera looks at the floor through it.
TEST(Unseen, ASquareLampLightsTheFloorByItsWatts) {
  const std::vector<glm::dvec3> corners = {{-0.5, -0.4, -0.5}, {0.5, -0.4, -0.5}, {0.5, -0.4, 0.5}, {-0.5, -0.4, 0.5}};
  for (const int role : kRoles) {
    for (const LightSampling way : kWays) {
      Scene scene = floor_scene();
      add_lamp(scene, -0.4f, 60.0f, role);
      RenderOptions options = once(32, 512);
      options.light_sampling = way;
      options.eyes = way == LightSampling::kBoth ? Eyes::kBothEyes : Eyes::kMonoEye;
      SCOPED_TRACE(std::to_string(role) + " " + std::to_string(static_cast<int>(way)));
      expect_floor(
          render_cpu(scene, {}, options), [&](glm::dvec3 p) { return polygon_irradiance(p, corners, 60.0 / kPiD); },
          0.03);
    }
  }
}

// One that the camera sees lights the same.
TEST(Unseen, HasTheEnergyOfAVisibleOne) {
  Picture pictures[2];
  for (int i = 0; i < 2; i++) {
    Scene scene = floor_scene();
    add_lamp(scene, 2.0f, 60.0f, i == 0 ? kOrdinary : kPureLight);
    pictures[i] = render_cpu(scene, {}, once(32, 64));
  }
  for (int y = 9; y < 16; y++) {
    for (int x = 0; x < 32; x++) {
      EXPECT_NEAR(*pictures[0].eyes[0].radiance.at(x, y), *pictures[1].eyes[0].radiance.at(x, y), 1e-4f);
    }
  }
}

// Overhead, from its shining front, in both eyes and through a clear pane: there is nothing but the sky.
TEST(Unseen, TheCameraSeesTheSkyThroughIt) {
  for (const int role : kRoles) {
    for (const bool pane : {false, true}) {
      Scene scene;
      add_lamp(scene, 1.0f, 60.0f, role);
      scene.environment.radiance = vec3(0.5f);
      Material glass = default_material();
      glass.transmission = 1.0f;
      glass.roughness = 0.0f;
      glass.ior = 1.0f;
      const int clear = add_material(scene, glass);
      if (pane) add_rectangle(scene, vec3(-9, 0.5f, -9), vec3(18, 0, 0), vec3(0, 0, 18), clear);
      RenderOptions options = once(32, 16);
      options.eyes = Eyes::kBothEyes;
      for (const EyeImage& eye : render_cpu(scene, {}, options).eyes) {
        for (int x = 0; x < 32; x++) {
          EXPECT_NEAR(*eye.radiance.at(x, 0), 0.5f, 1e-5f) << role << pane;
          EXPECT_EQ(*eye.normal.at(x, 0), 0.0f);
          if (!pane) {
            EXPECT_EQ(*eye.depth.at(x, 0), kFarDepth);
          }
        }
      }
    }
  }
}

TEST(Unseen, AMirrorShowsIt) {
  for (const int role : kRoles) {
    Scene scene;
    Material mirror = default_material();
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    add_rectangle(scene, vec3(-9, -1, 9), vec3(18, 0, 0), vec3(0, 0, -18), add_material(scene, mirror));
    add_lamp(scene, 2.0f, 60.0f, role);
    const Picture picture = render_cpu(scene, {}, once(64, 16));
    EXPECT_NEAR(double{*picture.eyes[0].radiance.at(5, 31)}, 60.0 / kPiD, 1e-2) << role;
    EXPECT_LT(picture.eyes[0].normal.at(5, 31)[1], -0.9f) << "a denoiser's normal is the lamp's";
  }
}

TEST(Unseen, AnAreaLightShadesNothingAndAnObjectDoes) {
  for (const int role : kRoles) {
    Scene scene = floor_scene();
    add_lamp(scene, -0.4f, 0.0f, role);
    PunctualLight sun;
    sun.kind = kLightDirectional;
    sun.direction = vec3(0.0f, -1.0f, 0.0f);
    sun.intensity = vec3(2.0f);
    scene.lights.push_back(sun);
    const Picture picture = render_cpu(scene, {}, once(32, 16));
    const double expected = role == kPureLight ? 2.0 / kPiD : 0.0;
    for (int x = 0; x < 32; x++) EXPECT_NEAR(double{*picture.eyes[0].radiance.at(x, 15)}, expected, 1e-5) << role;
  }
}

// Light that walls scatter passes an area light, too: a furnace with one in it stays a furnace.
TEST(Unseen, AnAreaLightKeepsAFurnaceWhite) {
  for (const LightSampling way : kWays) {
    Scene scene;
    Material wall = matte(vec3(0.5f));
    wall.emission = vec3(1.0f);
    add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, wall));
    add_lamp(scene, 0.4f, 0.0f, kPureLight);
    RenderOptions options = small_render(64, 64);
    options.bounces = 6;
    options.light_sampling = way;
    const Mean mean = mean_of(render_cpu(scene, {}, options).eyes[0].radiance);
    const double exact = (1.0 - std::pow(0.5, 7)) / 0.5;
    EXPECT_LT(std::abs(mean.value() - exact), 4.0 * std::sqrt(mean.variance()) + 1e-5) << static_cast<int>(way);
    EXPECT_NEAR(mean.value(), exact, 0.01 * exact) << static_cast<int>(way);
  }
}

TEST(Unseen, TheLightCacheAgrees) {
  double means[2];
  for (int i = 0; i < 2; i++) {
    Scene scene;
    add_box(scene, vec3(-2, -1, -2), vec3(2, 1.5f, 2), add_material(scene, matte(vec3(0.7f))));
    add_lamp(scene, 1.4f, 60.0f, kPureLight);
    RenderOptions options = small_render(32, 128);
    options.indirect = i == 0 ? Indirect::kPath : Indirect::kCache;
    options.cache_paths = 1 << 18;
    means[i] = mean_of(render_cpu(scene, {}, options).eyes[0].radiance).value();
  }
  EXPECT_NEAR(means[1] / means[0], 1.0, 0.015);
}

// Only one of two instances of a mesh is a lamp that rays do not hit.
TEST(Unseen, InstancesHaveRolesOfTheirOwn) {
  Scene scene;
  add_lamp(scene, 1.0f, 60.0f, kPureLight);
  glm::mat4 above(1.0f);
  above[3] = vec4(0.0f, 1.0f, 0.0f, 1.0f);
  add_instance(scene, 0, above);
  const LightTable lights = make_lights(scene);
  PathTracer tracer;
  set_scene(tracer, scene, lights);
  for (const size_t most_copies : {size_t{0}, EmbreeScene::kMaxCopiedTriangles}) {
    const EmbreeScene embree(scene, most_copies);
    const Ray up{vec3(0.1f, 0.0f, 0.1f), vec3(0, 1, 0)};
    tracer.start_path(up, no_media(), 0u, 0u);
    EXPECT_EQ(embree.closest_hit(tracer, up, kPathRay).instance, 1);
    EXPECT_EQ(embree.closest_hit(tracer, up, kHalfAlphaRay).instance, 1);
    EXPECT_FALSE(embree.occluded(tracer, up, 1.5f));
    EXPECT_TRUE(embree.occluded(tracer, up, 2.5f));
    tracer.path.bounce = 1;
    EXPECT_EQ(embree.closest_hit(tracer, up, kPathRay).instance, 0);
  }
}

// --- lights that have a size

PunctualLight sphere_lamp(float radius) {
  PunctualLight lamp;
  lamp.position = vec3(0.0f, 0.2f, 0.0f);
  lamp.intensity = vec3(7.0f);
  lamp.size = radius;
  return lamp;
}

// A whole sphere above the horizon lights a surface as a point does, however near and large.
TEST(LightSize, ASphereIsAsBrightAsAPoint) {
  for (const float radius : {0.01f, 0.3f, 1.1f}) {
    Scene scene = floor_scene();
    scene.lights.push_back(sphere_lamp(radius));
    RenderOptions options = once(32, 256);
    options.eyes = Eyes::kBothEyes;
    SCOPED_TRACE(radius);
    expect_floor(
        render_cpu(scene, {}, options),
        [](glm::dvec3 p) { return 7.0 * 1.2 / std::pow(length(p - glm::dvec3(0, 0.2, 0)), 3.0); }, 0.02);
  }
}

// Half of a disc in the sky stands above the edge of a wall whose shadow ends here: half of its light arrives.
TEST(LightSize, ASunsShadowIsHalfLightAtItsEdge) {
  Scene scene = floor_scene();
  const int wall = add_material(scene, matte(vec3(0.0f)));
  add_rectangle(scene, vec3(0.0f, 9.0f, -200), vec3(300, 0, 0), vec3(0, 0, 400), wall);
  PunctualLight sun;
  sun.kind = kLightDirectional;
  sun.direction = vec3(0.0f, -1.0f, 0.0f);
  sun.intensity = vec3(2.0f);
  sun.size = 0.05f;
  scene.lights.push_back(sun);
  const Picture picture = render_cpu(scene, {}, once(128, 256));
  // At 0.5 m = 10 m tan 0.05 from the edge all is lit or all is dark. A column of the picture is a line of one x / z.
  const double full = 2.0 / kPiD;
  EXPECT_NEAR(double{*picture.eyes[0].radiance.at(32, 48)}, full, 0.01 * full);
  EXPECT_NEAR(double{*picture.eyes[0].radiance.at(96, 48)}, 0.0, 1e-6);
  const double left = double{*picture.eyes[0].radiance.at(63, 40)},
               right = double{*picture.eyes[0].radiance.at(64, 40)};
  EXPECT_NEAR(left + right, full, 0.05 * full);
  EXPECT_GT(left, right);
  EXPECT_GT(right, 0.2 * full);
}

TEST(LightSize, ConesFadeAsCyclesHasThem) {
  for (const int cone : {kConeSmooth, kConeSmoothCosine}) {
    Scene scene = floor_scene();
    PunctualLight lamp;
    lamp.kind = kLightSpot;
    lamp.position = vec3(0.0f, 1.0f, 0.0f);
    lamp.direction = vec3(0.0f, -1.0f, 0.0f);
    lamp.intensity = vec3(5.0f);
    lamp.inner_cone = 0.3f;
    lamp.outer_cone = 1.2f;
    lamp.cone = cone;
    scene.lights.push_back(lamp);
    SCOPED_TRACE(cone);
    expect_floor(
        render_cpu(scene, {}, once(32, 256)),
        [&](glm::dvec3 p) {
          const double distance = length(p - glm::dvec3(0, 1, 0)), cosine = 2.0 / distance;
          const double t = std::clamp((cosine - std::cos(1.2)) / (std::cos(0.3) - std::cos(1.2)), 0.0, 1.0);
          const double share = t * t * (3.0 - 2.0 * t) * (cone == kConeSmooth ? 1.0 : cosine);
          return 5.0 * cosine * share / (distance * distance);
        },
        0.01);
  }
}

}  // namespace ods::unseen_test
