// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "ods/camera/stereo_camera.h"
#include "ods/kernel/camera/project.h"
#include "tests/support/exact_camera.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

using glm::dvec2, glm::dvec3;
const std::vector<int> kModes = closed_merges();
const int kEyes[] = {kLeft, kRight, kMono};

// The camera once more, in double precision and from the definitions alone.
ExactRay exact_ray(const StereoCamera& stereo, const Camera& camera, int eye, dvec2 uv) {
  const double theta = 2.0 * kExactPi * (uv.x - 0.5), phi = kExactPi * (0.5 - uv.y);
  const double elevation = kExactPi / 2.0 - std::abs(kExactPi / 2.0 - std::abs(phi));  // falls again beyond a pole
  const double side = eye == kLeft ? -0.5 : eye == kRight ? 0.5 : 0.0;
  const double r = side * double{stereo.ipd} * exact_factor(phi < 0.0 ? stereo.bottom : stereo.top, elevation);
  const dvec3 right(camera.right), up(camera.up), ahead = -dvec3(camera.back);
  return {dvec3(stereo.position) + r * (std::cos(theta) * right - std::sin(theta) * ahead),
          std::cos(phi) * (std::sin(theta) * right + std::cos(theta) * ahead) + std::sin(phi) * up};
}

PoleMergeSetting random_merge(Dice& dice, int mode) {
  PoleMergeSetting merge;
  merge.mode = mode;
  merge.start = dice.between(0.0f, 70.0f);
  merge.end = merge.start + dice.between(10.0f, 90.0f - merge.start);
  merge.exponent = dice.next() < 0.5f ? 1.0f : dice.between(0.5f, 3.0f);
  return merge;
}

StereoCamera random_rig(Dice& dice, int top, int bottom) {
  StereoCamera stereo;
  stereo.position = vec3(dice.between(-2, 2), dice.between(-2, 2), dice.between(-2, 2));
  stereo.yaw = dice.between(-180, 180);
  stereo.pitch = dice.between(-90, 90);
  stereo.roll = dice.between(-180, 180);
  stereo.ipd = dice.between(0.05f, 0.08f);
  stereo.top = random_merge(dice, top);
  stereo.bottom = random_merge(dice, bottom);
  return stereo;
}

TEST(Camera, AgreesWithItsTwinInDoublePrecision) {
  Dice dice(1);
  for (int top : kModes) {
    for (int bottom : kModes) {
      const StereoCamera stereo = random_rig(dice, top, bottom);
      const Camera camera = make_camera(stereo);
      for (int i = 0; i < 3000; i++) {
        const int eye = kEyes[i % 3];
        const vec2 uv(dice.between(-0.25f, 1.25f), dice.between(-0.25f, 1.25f));
        const Ray ray = camera_ray(camera, eye, uv);
        const ExactRay exact = exact_ray(stereo, camera, eye, uv);
        ASSERT_LT(angle_between(dvec3(ray.direction), exact.direction), 1e-6) << uv.x << ' ' << uv.y;
        ASSERT_LT(length(dvec3(ray.origin) - exact.origin), 1e-6) << top << bottom << ' ' << uv.x << ' ' << uv.y;
        ASSERT_NEAR(length(ray.direction), 1.0f, 5e-7f);
      }
    }
  }
}

TEST(Camera, FrameIsOrthonormalAndRightHanded) {
  Dice dice(2);
  for (int i = 0; i < 1000; i++) {
    const Camera c = make_camera(random_rig(dice, kMergeNone, kMergeNone));
    EXPECT_LT(length(cross(c.right, c.up) - c.back), 3e-7f);
    EXPECT_NEAR(length(c.right), 1.0f, 2e-7f);
    EXPECT_NEAR(length(c.up), 1.0f, 2e-7f);
  }
}

// "Rendering Omni-directional Stereo Content", Ray tracing the ODS projection: its theta and phi run from the left and
// top edge, its origin is IPD/2 times (cos, 0, sin) in its own frame, of which ours is the quarter turn.
TEST(Camera, IsGooglesModel) {
  StereoCamera stereo;
  const Camera camera = make_camera(stereo);
  struct Known {
    vec2 uv;
    vec3 left_origin, direction;
  };
  const float r = 0.0325f, s = std::sqrt(0.5f);
  for (const Known& known : {Known{{0.5f, 0.5f}, {-r, 0, 0}, {0, 0, -1}}, Known{{0.75f, 0.5f}, {0, 0, -r}, {1, 0, 0}},
                             Known{{0.25f, 0.5f}, {0, 0, r}, {-1, 0, 0}}, Known{{1.0f, 0.5f}, {r, 0, 0}, {0, 0, 1}},
                             Known{{0.5f, 0.25f}, {-r, 0, 0}, {0, s, -s}}, Known{{0.5f, 0.0f}, {-r, 0, 0}, {0, 1, 0}},
                             Known{{0.75f, 1.0f}, {0, 0, -r}, {0, -1, 0}}}) {
    const Ray left = camera_ray(camera, kLeft, known.uv), right = camera_ray(camera, kRight, known.uv);
    EXPECT_LT(length(left.origin - known.left_origin), 1e-8f) << known.uv.x << ' ' << known.uv.y;
    EXPECT_LT(length(right.origin + known.left_origin), 1e-8f);
    EXPECT_LT(length(left.direction - known.direction), 3e-7f);
    EXPECT_EQ(left.direction, right.direction);
    EXPECT_EQ(camera_ray(camera, kMono, known.uv).origin, vec3(0.0f));
  }
}

TEST(Camera, GoesOnOverThePolesIntoTheOtherEye) {
  Dice dice(3);
  for (int mode : kModes) {
    const Camera camera = make_camera(random_rig(dice, mode, mode));
    for (int i = 0; i < 1000; i++) {
      const vec2 uv(dice.between(0.0f, 0.5f), dice.between(0.0f, 0.25f));
      for (vec2 place : {uv, vec2(uv.x, 1.0f - uv.y)}) {
        const vec2 beyond(place.x + 0.5f, (place.y < 0.5f ? 0.0f : 2.0f) - place.y);
        const Ray left = camera_ray(camera, kLeft, beyond), right = camera_ray(camera, kRight, place);
        ASSERT_LT(length(left.origin - right.origin), 1e-6f);
        ASSERT_LT(length(left.direction - right.direction), 1e-6f);
      }
    }
  }
}

TEST(Camera, UWraps) {
  Dice dice(4);
  const Camera camera = make_camera(random_rig(dice, kMergeCosine, kMergeLinear));
  for (int i = 0; i < 1000; i++) {
    const vec2 uv = dice.pair();
    const Ray a = camera_ray(camera, kLeft, uv), b = camera_ray(camera, kLeft, uv + vec2(1.0f, 0.0f));
    ASSERT_LT(length(a.direction - b.direction), 2e-6f);
    ASSERT_LT(length(a.origin - b.origin), 1e-6f);
  }
}

// Values from the documentation and source of other cameras, at 15 30 45 60 67.5 75 80 85 and 88 degrees.
TEST(Camera, PoleMergesAreThoseOfOtherRenderers) {
  const float at[] = {15, 30, 45, 60, 67.5f, 75, 80, 85, 88};
  struct Known {
    const char* name;
    PoleMergeSetting merge;
    float factor[9];
  };
  const Known table[] = {
      {"POV-Ray, modulation 0.2",
       {kMergeCosine, 0, 90, 0.2f},
       {.9931f, .9716f, .9330f, .8706f, .8252f, .7631f, .7046f, .6138f, .5112f}},
      {"POV-Ray, OSPRay",
       {kMergeCosine, 0, 90, 1},
       {.9659f, .8660f, .7071f, .5f, .3827f, .2588f, .1736f, .0872f, .0349f}},
      {"smoothstep, exact fractions",
       {kMergeSmoothstep, 0, 90, 1},
       {.9259f, .7407f, .5f, .2593f, .1563f, .0741f, .0343f, .0089f, .0015f}},
      {"smootherstep, exact fractions",
       {kMergeSmootherstep, 0, 90, 1},
       {.9645f, .7901f, .5f, .2099f, .1035f, .0355f, .0115f, .0016f, .0001f}},
      {"Cycles", {kMergeCosine, 60, 75, 1}, {1, 1, 1, 1, .7071f, 0, 0, 0, 0}},
      {"Arnold cosine", {kMergeCosine, 60, 90, 1}, {1, 1, 1, 1, .9239f, .7071f, .5f, .2588f, .1045f}},
      {"Arnold linear", {kMergeLinear, 60, 90, 1}, {1, 1, 1, 1, .75f, .5f, .3333f, .1667f, .0667f}},
      {"Marrinan", {kMergeLinear, 75, 90, 1}, {1, 1, 1, 1, 1, 1, .6667f, .3333f, .1333f}},
  };
  for (const Known& known : table) {
    StereoCamera stereo;
    stereo.top = known.merge;
    const Camera camera = make_camera(stereo);
    EXPECT_FLOAT_EQ(merge_factor(camera.top, 0.0f), 1.0f) << known.name;
    for (int i = 0; i < 9; i++) {
      EXPECT_NEAR(merge_factor(camera.top, glm::radians(at[i])), known.factor[i], 1e-4f) << known.name << ' ' << at[i];
      // Only the upper half merges.
      EXPECT_FLOAT_EQ(0.5f * camera.ipd * merge_at(camera, vec3(0.0f), -glm::radians(at[i])), 0.0325f);
      EXPECT_NEAR(0.5f * camera.ipd * merge_at(camera, vec3(0.0f), glm::radians(at[i])), 0.0325f * known.factor[i],
                  1e-5f);
    }
  }
}

TEST(Camera, AnglesTurnTheRightWay) {
  const auto looks = [](float yaw, float pitch, float roll) {
    StereoCamera stereo;
    stereo.yaw = yaw, stereo.pitch = pitch, stereo.roll = roll;
    return make_camera(stereo);
  };
  EXPECT_LT(length(-looks(90, 0, 0).back - vec3(1, 0, 0)), 1e-6f);   // to the right
  EXPECT_LT(length(-looks(0, 90, 0).back - vec3(0, 1, 0)), 1e-6f);   // up
  EXPECT_LT(length(looks(0, 90, 0).up - vec3(0, 0, 1)), 1e-6f);      // and the top of the head backwards
  EXPECT_LT(length(looks(0, 0, 90).up - vec3(1, 0, 0)), 1e-6f);      // clockwise: the head leans to the right
  EXPECT_LT(length(looks(0, 0, 90).right - vec3(0, -1, 0)), 1e-6f);  //
  EXPECT_LT(length(-looks(90, 45, 0).back - vec3(std::sqrt(0.5f), std::sqrt(0.5f), 0)), 1e-6f);  // pitch, then yaw
  EXPECT_LT(length(looks(90, 0, 90).up - vec3(0, 0, 1)), 1e-6f);                                 // roll, then yaw
}

// Positions in metres round to about 1e-7 of the point's largest coordinate; seen from the distance t that is an angle.
// The kernel's own functions add about 1e-6. Near a pole the point lies close above the viewing circle, and a small
// step off that circle turns the ray that touches it by r / (t cos phi) times as much.
TEST(Projection, FindsTheRayThatMeetsAPoint) {
  Dice dice(5);
  for (int top : kModes) {
    for (int bottom : kModes) {
      StereoCamera stereo = random_rig(dice, top, bottom);
      if (dice.next() < 0.5f) stereo.top.start = 0.0f, stereo.top.end = 90.0f, stereo.top.exponent = 1.0f;
      const Camera camera = make_camera(stereo);
      for (int i = 0; i < 10000; i++) {
        const int eye = kEyes[i % 3];
        const vec2 uv = dice.pair();
        const Ray ray = camera_ray(camera, eye, uv);
        const float t = std::exp(dice.between(std::log(0.2f), std::log(200.0f)));
        const vec3 point = ray.origin + t * ray.direction;
        const ImagePosition found = project_point(camera, eye, point);
        const double cosine = std::sin(kExactPi * double{uv.y});
        const double steepness = 1.0 + 0.04 / (double{t} * cosine);
        const double rounding = (1e-6 + 3e-7 * double{length(point) + 4.0f} / double{t}) * steepness;
        const double du = std::abs(std::remainder(double{found.uv.x} - double{uv.x}, 1.0));
        if (cosine * double{t} < 1e-3) continue;  // on the axis there is no azimuth
        ASSERT_TRUE(found.seen) << uv.x << ' ' << uv.y << ' ' << t;
        ASSERT_LT(du * 2.0 * kExactPi * cosine, rounding) << top << bottom << ' ' << uv.x << ' ' << uv.y << ' ' << t;
        ASSERT_LT(std::abs(double{found.uv.y} - double{uv.y}) * kExactPi, rounding) << uv.x << ' ' << uv.y << ' ' << t;
        ASSERT_NEAR(found.depth, t, t * rounding);
      }
    }
  }
}

TEST(Projection, NothingIsSeenInsideTheViewingCircle) {
  const Camera camera = make_camera(StereoCamera{});
  for (float rho : {0.0f, 0.01f, 0.032f}) {
    for (float height : {-1.0f, 0.0f, 0.3f}) {
      const vec3 point(rho, height, 0.0f);
      EXPECT_FALSE(project_point(camera, kLeft, point).seen);
      EXPECT_FALSE(project_point(camera, kRight, point).seen);
      EXPECT_EQ(project_point(camera, kMono, point).seen, rho > 0.0f || height != 0.0f);
    }
  }
  EXPECT_TRUE(project_point(camera, kLeft, vec3(0.033f, 0.0f, 0.0f)).seen);
}

// theta = alpha - side asin(r / rho): a point 0.65 m ahead lies asin(1/20) to the right in the left eye's picture.
TEST(Projection, DisparityIsTheClosedForm) {
  const Camera camera = make_camera(StereoCamera{});
  const double turn = std::asin(0.0325 / 0.65) / (2.0 * kExactPi);
  const vec3 point(0.0f, 0.0f, -0.65f);
  EXPECT_NEAR(project_point(camera, kLeft, point).uv.x, 0.5 + turn, 1e-7);
  EXPECT_NEAR(project_point(camera, kRight, point).uv.x, 0.5 - turn, 1e-7);
  EXPECT_NEAR(project_point(camera, kMono, point).uv.x, 0.5, 1e-7);
  EXPECT_NEAR(project_point(camera, kLeft, point).depth, std::sqrt(0.65 * 0.65 - 0.0325 * 0.0325), 1e-7);
}

TEST(StereoCamera, AnglesComeBack) {
  for (float yaw : {-170.0f, -90.0f, 0.0f, 33.0f, 179.0f}) {
    for (float pitch : {-89.0f, -20.0f, 0.0f, 45.0f}) {
      for (float roll : {-120.0f, 0.0f, 75.0f}) {
        StereoCamera stereo;
        stereo.yaw = yaw, stereo.pitch = pitch, stereo.roll = roll;
        const Camera camera = make_camera(stereo);
        const ViewAngles angles = view_angles(-dvec3(camera.back), dvec3(camera.up));
        EXPECT_NEAR(angles.yaw, yaw, 1e-3f);
        EXPECT_NEAR(angles.pitch, pitch, 1e-3f);
        EXPECT_NEAR(angles.roll, roll, 1e-3f);
      }
    }
  }
  for (float pitch : {-90.0f, 90.0f}) {
    StereoCamera stereo;
    stereo.yaw = 40.0f, stereo.pitch = pitch;
    const Camera camera = make_camera(stereo);
    const ViewAngles angles = view_angles(-dvec3(camera.back), dvec3(camera.up));
    EXPECT_NEAR(angles.yaw, 40.0f, 1e-3f);
    EXPECT_NEAR(angles.pitch, pitch, 0.03f);
    EXPECT_EQ(angles.roll, 0.0f);
  }
}

}  // namespace
}  // namespace ods
