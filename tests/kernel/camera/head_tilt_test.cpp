// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The head-tilt map: rays against the camera in double precision, known answers, and the way back from points.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ods/camera/stereo_camera.h"
#include "ods/kernel/camera/project.h"
#include "ods/kernel/counterpart.h"
#include "ods/render/cpu/render.h"
#include "tests/support/exact_projection.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

using Map = std::shared_ptr<const Image>;

Map constant(float value) {
  auto map = std::make_shared<Image>(2, 1, 1);
  map->pixels = {value, value};
  return map;
}

// Its steepest slope is half a turn of the head in 22 degrees.
Map varying(Dice& dice) {
  auto map = std::make_shared<Image>(16, 8, 1);
  for (float& texel : map->pixels) texel = dice.next();
  return map;
}

std::vector<Map> many_maps(Dice& dice) {
  return {constant(0.0f), constant(0.25f), constant(0.5f), constant(1.0f), varying(dice)};
}

TEST(HeadTilt, AgreesWithItsTwinThroughEveryProjectionAndConvergence) {
  Dice dice(1);
  for (const Map& map : many_maps(dice)) {
    for (const int convergence : kConvergences) {
      for (const ProjectionSetting& setting : many_settings(dice)) {
        StereoCamera stereo = odd_rig(dice, setting, convergence);
        stereo.head_tilt_map = map;
        ASSERT_NO_FATAL_FAILURE(expect_exact_rays(stereo, 200, 7e-7, dice));
      }
    }
  }
}

TEST(HeadTilt, HalfIsLevelToTheLastBit) {
  Dice dice(2);
  for (const int convergence : kConvergences) {
    for (const ProjectionSetting& setting : many_settings(dice)) {
      StereoCamera stereo = odd_rig(dice, setting, convergence);
      const Camera level = make_camera(stereo);
      stereo.head_tilt_map = constant(0.5f);
      const Camera mapped = make_camera(stereo);
      for (int i = 0; i < 200; i++) {
        const vec2 uv = dice.pair();
        const Ray a = camera_ray(level, i % 3, uv), b = camera_ray(mapped, i % 3, uv);
        ASSERT_EQ(a.origin, b.origin);
        ASSERT_EQ(a.direction, b.direction);
      }
    }
  }
}

// Tilted to the right the right eye is below, whatever the heading; looking up it is in front, as the chin is then.
TEST(HeadTilt, TurnsTheEyesClockwise) {
  struct Known {
    float map;
    vec2 uv;
    vec3 right_eye;
  };
  StereoCamera stereo;
  const float r = 0.0325f, s = r * std::sqrt(0.5f);
  for (const Known& known : {Known{1.0f, {0.5f, 0.5f}, {0, -r, 0}}, Known{0.0f, {0.5f, 0.5f}, {0, r, 0}},
                             Known{0.75f, {0.5f, 0.5f}, {s, -s, 0}}, Known{0.25f, {0.5f, 0.5f}, {s, s, 0}},
                             Known{1.0f, {0.75f, 0.5f}, {0, -r, 0}}, Known{0.75f, {0.75f, 0.5f}, {0, -s, s}},
                             Known{1.0f, {0.5f, 0.25f}, {0, -s, -s}}}) {
    stereo.head_tilt_map = constant(known.map);
    const Camera camera = make_camera(stereo);
    const Ray right = camera_ray(camera, kRight, known.uv), left = camera_ray(camera, kLeft, known.uv);
    EXPECT_LT(length(right.origin - known.right_eye), 1e-8f) << known.map << ' ' << known.uv.x << ' ' << known.uv.y;
    EXPECT_LT(length(left.origin + known.right_eye), 1e-8f);
    EXPECT_EQ(right.direction, left.direction);
    EXPECT_EQ(camera_ray(camera, kMono, known.uv).origin, vec3(0.0f));
  }
}

TEST(HeadTilt, ToedInRaysMeetAndTheNeckStaysLevel) {
  StereoCamera stereo;
  stereo.convergence = kToeIn, stereo.convergence_distance = 1.5f;
  stereo.head_tilt_map = constant(0.8f);
  const Camera toed_in = make_camera(stereo);
  const vec2 uv(0.3f, 0.4f);
  for (const int eye : {kLeft, kRight}) {
    const Ray ray = camera_ray(toed_in, eye, uv);
    EXPECT_LT(length(ray.origin + ray.direction * std::hypot(1.5f, 0.0325f) -
                     1.5f * look_of(toed_in.projection, uv, uv).direction),
              1e-6f);
  }
  stereo = {};
  stereo.neck = 0.1f, stereo.ipd = 0.0f;
  const Ray level = camera_ray(make_camera(stereo), kRight, uv);
  stereo.head_tilt_map = constant(1.0f);
  EXPECT_LT(length(camera_ray(make_camera(stereo), kRight, uv).origin - level.origin), 1e-9f);
}

// Across a pole the picture continues in the other eye's, as without a map.
TEST(HeadTilt, GoesOnOverThePolesIntoTheOtherEye) {
  Dice dice(3);
  StereoCamera stereo;
  stereo.head_tilt_map = varying(dice);
  const Camera camera = make_camera(stereo);
  for (int i = 0; i < 1000; i++) {
    const vec2 uv(dice.between(0.0f, 0.5f), dice.between(0.0f, 0.2f));
    const Ray left = camera_ray(camera, kLeft, vec2(uv.x + 0.5f, -uv.y)), right = camera_ray(camera, kRight, uv);
    ASSERT_LT(length(left.origin - right.origin), 1e-6f);
    ASSERT_LT(length(left.direction - right.direction), 1e-6f);
  }
}

// The angle between the ray at a place of the picture and the point, in pixels of a panorama 8192 pixels wide.
double pixels_off(const Camera& camera, int eye, vec2 uv, vec3 point) {
  const Ray ray = camera_ray(camera, eye, uv);
  return angle_between(ray.direction, dvec3(point) - dvec3(ray.origin)) * 8192.0 / (2.0 * kExactPi);
}

// Back to the same place, origin and depth: within a fiftieth of such a pixel, more where headings meet at the axis.
// On the rough map several rays can meet at a point; then any of them will do.
TEST(HeadTilt, FindsTheRayThatMeetsAPoint) {
  Dice dice(4);
  int missed = 0, all = 0;
  for (const Map& map : many_maps(dice)) {
    const bool is_rough = map->width > 2;
    for (const int convergence : kConvergences) {
      for (const ProjectionSetting& setting : many_settings(dice)) {
        StereoCamera stereo = odd_rig(dice, setting, convergence);
        stereo.head_tilt_map = map;
        const Camera camera = make_camera(stereo);
        for (int i = 0; i < 300; i++) {
          const vec2 uv = dice.pair();
          if (has_image_circle(setting.kind) && !in_circle(setting, uv)) continue;
          const int eye = i % 3;
          const Ray ray = camera_ray(camera, eye, uv);
          const float level = length(cross(ray.direction, stereo.axis ? vec3(0, 1, 0) : camera.up));
          if (level < 0.1f) continue;
          const float t = std::exp(dice.between(std::log(0.5f), std::log(100.0f)));
          const vec3 point = ray.origin + t * ray.direction;
          const ImagePosition found = project_point(camera, eye, point);
          const std::string where = fmt::format("{} {} t {} map {} level {}", projection_name(setting), convergence, t,
                                                *map->at(0, 0), level);
          all++, missed += !found.seen;
          if (!found.seen && is_rough) continue;
          ASSERT_TRUE(found.seen) << where;
          ASSERT_LT(pixels_off(camera, eye, found.uv, point), 0.02 / double{level}) << where;
          if (is_rough) continue;
          const double error = angle_between(exact_direction(setting, found.uv), exact_direction(setting, uv));
          ASSERT_LT(error * 8192.0 / (2.0 * kExactPi), 0.02 / double{level}) << where;
          ASSERT_NEAR(found.depth, t, t * 2e-5f) << where;
          ASSERT_LT(length(found.origin - ray.origin), 2e-6f / level) << where;
        }
      }
    }
  }
  EXPECT_LT(missed, all / 5000) << all;
}

// Points that no ray hits are not seen, and nothing is a NaN.
TEST(HeadTilt, PointsThatNoRayMeetsAreNotSeen) {
  StereoCamera stereo;
  for (const float tilt : {0.0f, 0.5f, 0.8f}) {
    stereo.head_tilt_map = constant(tilt);
    const Camera camera = make_camera(stereo);
    for (const float rho : {0.0f, 0.01f, 0.02f}) {
      const ImagePosition found = project_point(camera, kRight, vec3(rho, 0.0f, 0.0f));
      EXPECT_FALSE(found.seen) << tilt << ' ' << rho;
      EXPECT_TRUE(std::isfinite(found.uv.x) && std::isfinite(found.uv.y) && std::isfinite(found.depth));
    }
    EXPECT_TRUE(project_point(camera, kMono, vec3(0.01f, 0.0f, 0.0f)).seen);
    EXPECT_TRUE(project_point(camera, kRight, vec3(0.04f, 0.0f, 0.0f)).seen);
  }
}

// A head on its side: a point ahead at the distance D is asin(r / D) below the middle for the upper, left eye.
TEST(HeadTilt, OnItsSideDisparityIsVertical) {
  StereoCamera stereo;
  stereo.head_tilt_map = constant(1.0f);
  const Camera camera = make_camera(stereo);
  const double turn = std::asin(0.0325 / 0.65) / kExactPi;
  for (const float heading : {0.0f, 1.0f, -2.5f}) {
    const vec3 point = 0.65f * vec3(std::sin(heading), 0.0f, -std::cos(heading));
    const ImagePosition left = project_point(camera, kLeft, point), right = project_point(camera, kRight, point);
    EXPECT_NEAR(left.uv.x, right.uv.x, 1e-7f);
    EXPECT_NEAR(left.uv.y, 0.5 + turn, 1e-6);
    EXPECT_NEAR(right.uv.y, 0.5 - turn, 1e-6);
  }
}

// A white ball in the dark, rendered: its middle is in the same column of both pictures, and as many rows apart as the
// closed form says.
TEST(HeadTilt, OnItsSideARenderedPairHasVerticalParallaxOnly) {
  StereoCamera stereo;
  stereo.head_tilt_map = constant(1.0f);
  RenderOptions options;
  options.width = 512, options.height = 256, options.samples = 16, options.bounces = 0;
  options.layers = false;
  const float ball = 0.1f;  // 1 m away: its edges are where a line of sight, r beside the centre, touches it
  const double apart_as_tangents = std::asin(0.0325 + double{ball}) + std::asin(0.0325 - double{ball});
  for (const float heading : {0.0f, 1.0f}) {
    Scene scene;
    Material white = default_material();
    white.emission = vec3(1.0f);
    add_sphere(scene, vec3(std::sin(heading), 0.0f, -std::cos(heading)), ball, add_material(scene, white), 32);
    std::vector<dvec2> middles;
    for (const EyeImage& eye : render_cpu(scene, stereo, options).eyes) {
      dvec2 sum(0.0);
      double light = 0.0;
      for (int i = 0; i < options.width * options.height; i++) {
        const double value = double{eye.radiance.at(i % options.width, i / options.width)[0]};
        light += value, sum += value * dvec2(i % options.width, i / options.width);
      }
      middles.push_back(sum / light);
    }
    const dvec2 apart = middles[0] - middles[1];
    EXPECT_NEAR(apart.x, 0.0, 0.05) << heading;
    EXPECT_NEAR(apart.y, apart_as_tangents * 256.0 / kExactPi, 0.05) << heading;
  }
}

// Sharing a path between the eyes needs the closed forms.
TEST(HeadTilt, DoesNotProjectQuickly) {
  StereoCamera stereo;
  EXPECT_TRUE(projects_quickly(make_camera(stereo), vec3(0, 0, -1)));
  stereo.head_tilt_map = constant(0.7f);
  EXPECT_FALSE(projects_quickly(make_camera(stereo), vec3(0, 0, -1)));
}

}  // namespace
}  // namespace ods
