// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shadow catchers against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ods/kernel/camera/camera.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/catchers.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"

namespace ods {
namespace {

// A matte floor one metre below the camera, which catches shadows, and nothing else.
Scene catching_floor() {
  Scene scene;
  add_rectangle(scene, vec3(-100, -1, 100), vec3(200, 0, 0), vec3(0, 0, -200),
                add_material(scene, matte(vec3(0.6f)), "floor"));
  EXPECT_TRUE(make_catchers(scene, "floor"));
  return scene;
}

int grey(Scene& scene) {
  return add_material(scene, matte(vec3(0.5f)));
}

void add_sun(Scene& scene, vec3 direction, float irradiance) {
  PunctualLight sun;
  sun.kind = kLightDirectional;
  sun.direction = direction;
  sun.intensity = vec3(irradiance);
  scene.lights.push_back(sun);
}

RenderOptions catching_render(int width, int samples) {
  RenderOptions options = small_render(width, samples);
  options.transparent = true;
  options.filter = PixelFilter::kBox;
  return options;
}

// The point on the floor that the middle of a pixel shows.
glm::dvec3 floor_at(int width, int x, int y) {
  const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                (static_cast<float>(y) + 0.5f) / static_cast<float>(width / 2));
  const Ray ray = camera_ray(make_camera(StereoCamera{}), kLeft, uv);
  return glm::dvec3(ray.origin) + glm::dvec3(ray.direction) * (-1.0 / static_cast<double>(ray.direction.y));
}

// A board before the sun: its shadow is whole, everything beside it is not there, and the board itself is as ever.
TEST(Catcher, ASunsShadowIsBlackBesideNothing) {
  Scene scene = catching_floor();
  add_rectangle(scene, vec3(-1, -0.5f, -3), vec3(0, 0, 2), vec3(2, 0, 0), grey(scene));
  add_sun(scene, vec3(0.0f, -1.0f, 0.0f), 3.0f);
  const int width = 64;
  RenderOptions options = catching_render(width, 4);
  options.layers = true;
  const EyeImage eye = render_cpu(scene, StereoCamera{}, options).eyes[0];
  const float margin = 0.15f;
  int inside = 0, outside = 0;
  for (int y = width / 4 + 2; y < width / 2; y++) {
    for (int x = 0; x < width; x++) {
      const glm::dvec3 p = floor_at(width, x, y), board = p * 0.5;  // what the ray meets at the board's height
      const auto apart = [&](glm::dvec3 q) { return std::max(std::abs(q.x) - 1.0, std::abs(q.z + 2.0) - 1.0); };
      if (std::abs(apart(board)) < margin || std::abs(apart(p)) < margin || length(p) > 6.0) continue;
      const float alpha = *eye.alpha.at(x, y), depth = *eye.depth.at(x, y);
      if (apart(board) < 0.0) {
        EXPECT_EQ(alpha, 1.0f);
        EXPECT_NEAR(static_cast<double>(depth), length(p) * 0.5, 1e-2 * length(p));
        continue;
      }
      EXPECT_EQ(*eye.radiance.at(x, y), 0.0f);
      EXPECT_EQ(alpha, apart(p) < 0.0 ? 1.0f : 0.0f) << x << ' ' << y;
      if (apart(p) < 0.0) {
        EXPECT_NEAR(static_cast<double>(depth), length(p), 1e-2 * length(p));
      } else {
        EXPECT_EQ(depth, kFarDepth);
      }
      (apart(p) < 0.0 ? inside : outside)++;
    }
  }
  EXPECT_GT(inside, 10);
  EXPECT_GT(outside, 200);
}

// Half the irradiance of a polygon by Lambert's formula, of which only shares are needed.
double polygon(glm::dvec3 p, const std::vector<glm::dvec3>& corners) {
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); i++) {
    const glm::dvec3 a = normalize(corners[i] - p), b = normalize(corners[(i + 1) % corners.size()] - p);
    sum += std::acos(dot(a, b)) * normalize(cross(a, b)).y;
  }
  return std::abs(sum);
}

// A lamp of 2 x 2 m two metres above the floor, of which a board halfway up hides all to the right of its edge.
TEST(Catcher, AnAreaLightsShadowIsTheShareThatIsHidden) {
  Scene scene = catching_floor();
  Material lamp = matte(vec3(0.0f));
  lamp.emission = vec3(2.0f, 4.0f, 1.0f);
  add_rectangle(scene, vec3(-1, 1, -1), vec3(2, 0, 0), vec3(0, 0, 2), add_material(scene, lamp));
  add_rectangle(scene, vec3(0, 0.001f, -50), vec3(0, 0, 100), vec3(50, 0, 0), grey(scene));
  const int width = 32;
  StereoCamera camera;
  camera.ipd = 0.0f;
  const EyeImage eye = render_cpu(scene, camera, catching_render(width, 256)).eyes[0];
  int partly = 0;
  double error = 0.0;
  for (int y = 12; y < width / 2; y++) {
    for (int x = 0; x < width; x++) {
      double with = 0.0, without = 0.0;  // of 8 x 8 places in the pixel
      for (int k = 0; k < 64; k++) {
        const vec2 place(static_cast<float>(k % 8) + 0.5f, static_cast<float>(k / 8) + 0.5f);
        const vec2 uv = (vec2(x, y) + place / 8.0f) / vec2(width, width / 2);
        const glm::dvec3 d(camera_ray(make_camera(camera), kLeft, uv).direction), p = d * (-1.0 / d.y);
        const double edge = std::clamp(p.x - p.x * 2.0 / 1.001, -1.0, 1.0);  // its shadow on the lamp
        const auto part = [&](double to) { return polygon(p, {{-1, 1, -1}, {to, 1, -1}, {to, 1, 1}, {-1, 1, 1}}); };
        with += edge <= -1.0 ? 0.0 : part(edge), without += part(1.0);
      }
      const double alpha = static_cast<double>(*eye.alpha.at(x, y)), expected = 1.0 - with / without;
      const bool is_partly = expected > 0.1 && expected < 0.9;
      partly += is_partly, error += is_partly ? alpha - expected : 0.0;
      ASSERT_NEAR(alpha, expected, is_partly ? 0.12 : 0.06) << x << ' ' << y;
    }
  }
  ASSERT_GT(partly, 40);
  EXPECT_NEAR(error / partly, 0.0, 0.005);
}

// A wall that is as good as endless hides half of an even sky, wherever it is looked from; a picture of that sky too.
TEST(Catcher, AWallTakesHalfOfTheSky) {
  for (const bool picture : {false, true}) {
    Scene scene = catching_floor();
    const float far = 1e4f;
    add_rectangle(scene, vec3(-far, -1, -2), vec3(2 * far, 0, 0), vec3(0, far, 0), grey(scene));
    scene.environment.radiance = vec3(0.7f);
    if (picture) scene.environment = make_environment(16, [](vec3) { return vec3(0.7f); });
    StereoCamera camera;
    camera.yaw = 180.0f;
    const EyeImage eye = render_cpu(scene, camera, catching_render(32, 256)).eyes[0];
    double mean = 0.0;
    for (int x = 12; x < 20; x++) {
      for (int y = 11; y < 16; y++) mean += static_cast<double>(*eye.alpha.at(x, y)) / 40.0;
    }
    EXPECT_NEAR(mean, 0.5, 0.01) << picture;
  }
}

// A small board high up blocks the sun, but not the sky.
TEST(Catcher, SkyAndSunTogether) {
  Scene scene = catching_floor();
  add_sun(scene, vec3(0.0f, -1.0f, 0.0f), 2.0f);
  scene.environment.radiance = vec3(0.3f);
  add_rectangle(scene, vec3(-0.5f, 30, -0.5f), vec3(1, 0, 0), vec3(0, 0, 1), grey(scene));
  const EyeImage eye = render_cpu(scene, StereoCamera{}, catching_render(32, 512)).eyes[0];
  double mean = 0.0;
  for (int x = 0; x < 32; x++) mean += static_cast<double>(*eye.alpha.at(x, 15)) / 32.0;
  EXPECT_NEAR(mean, 2.0 / (2.0 + 0.3 * std::numbers::pi), 0.01);
}

// Shadows of catchers are in the footage already, and so is what a catcher hides.
TEST(Catcher, CatchersCastNoShadowAndHideWhatIsBehind) {
  Scene scene = catching_floor();
  add_sun(scene, vec3(0.0f, -0.6f, -0.8f), 3.0f);
  const int wall = add_material(scene, matte(vec3(0.5f)), "wall");
  add_rectangle(scene, vec3(-10, -1, -3), vec3(20, 0, 0), vec3(0, 5, 0), wall);  // between the sun and the floor ahead
  add_rectangle(scene, vec3(-1, 0, 3), vec3(0, 1, 0), vec3(2, 0, 0), grey(scene));  // behind the camera, casts on it
  add_box(scene, vec3(-1, -0.5f, -6), vec3(1, 0.5f, -4), grey(scene));              // behind the wall
  ASSERT_TRUE(make_catchers(scene, "wall"));
  const int width = 64;
  const EyeImage eye = render_cpu(scene, StereoCamera{}, catching_render(width, 4)).eyes[0];
  EXPECT_EQ(*eye.alpha.at(width / 2, width / 4), 0.0f);  // the wall before the box: lit from its front
  for (float value : eye.radiance.pixels) ASSERT_TRUE(value >= 0.0f);
  scene.lights[0].direction = vec3(0.0f, -0.6f, 0.8f);  // now from behind the wall: all before it is dark anyway
  const EyeImage dark = render_cpu(scene, StereoCamera{}, catching_render(width, 4)).eyes[0];
  for (int y = width / 4; y < width / 4 + 6; y++) EXPECT_EQ(*dark.alpha.at(width / 2, y), 0.0f) << y;
}

// A lamp's far side is behind its near side, whatever else is there.
TEST(Catcher, ALampCastsNoShadowOfItself) {
  Scene scene = catching_floor();
  Material lamp = matte(vec3(0.0f));
  lamp.emission = vec3(3.0f);
  add_sphere(scene, vec3(0.0f, 0.5f, -3.0f), 0.5f, add_material(scene, lamp));
  const EyeImage eye = render_cpu(scene, StereoCamera{}, catching_render(32, 16)).eyes[0];
  for (int y = 9; y < 16; y++) {
    for (int x = 0; x < 32; x++) ASSERT_EQ(*eye.alpha.at(x, y), 0.0f) << x << ' ' << y;
  }
}

// To the light that is thrown up at other things a catcher is the floor that it is.
TEST(Catcher, OthersAreAsBefore) {
  Scene scene;
  const int floor = add_material(scene, matte(vec3(0.6f, 0.3f, 0.1f)), "floor");
  add_rectangle(scene, vec3(-100, -1, 100), vec3(200, 0, 0), vec3(0, 0, -200), floor);
  add_box(scene, vec3(-1, -0.9f, -4), vec3(1, 1, -2), grey(scene));
  scene.environment.radiance = vec3(1.0f);
  RenderOptions options = catching_render(32, 16);
  const EyeImage seen = render_cpu(scene, StereoCamera{}, options).eyes[0];
  ASSERT_TRUE(make_catchers(scene, "floor"));
  const EyeImage caught = render_cpu(scene, StereoCamera{}, options).eyes[0];
  for (int c = 0; c < 3; c++) EXPECT_EQ(caught.radiance.at(16, 8)[c], seen.radiance.at(16, 8)[c]);
  EXPECT_GT(*caught.radiance.at(16, 8), 0.0f);
}

TEST(Catcher, IsFoundByTheNamesOfNodesAndMaterials) {
  GltfBuilder file = make_triangle();
  file.node(0)["name"] = "Ground";
  file.json["materials"] = GltfJson::array({{{"name", "Grass"}}, {{"name", "Unused"}}});
  file.primitive()["material"] = 0;
  EXPECT_EQ(object_names(file.load()), (std::vector<std::string>{"Ground", "Grass"}));
  for (const char* name : {"Ground", "Grass"}) {
    Scene scene = file.load();
    EXPECT_FALSE(has_catchers(scene));
    EXPECT_TRUE(make_catchers(scene, name));
    EXPECT_TRUE(has_catchers(scene));
  }
  for (const char* name : {"Unused", "ground", ""}) {
    Scene scene = file.load();
    EXPECT_FALSE(make_catchers(scene, name)) << name;
    EXPECT_FALSE(has_catchers(scene));
  }
}

}  // namespace
}  // namespace ods
