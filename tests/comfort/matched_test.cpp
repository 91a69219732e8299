// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The eyes of a hall whose walls are known, matched.
#include "ods/comfort/matched.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/camera/eye_correction.h"
#include "ods/comfort/motion.h"
#include "ods/disparity/alignment.h"
#include "ods/picture/picture.h"
#include "tests/support/hall.h"

namespace ods {
namespace {

constexpr Extent kEye{1024, 512};

std::vector<Image> eyes_of(const StereoCamera& camera) {
  return {grey_of(seen_in(World::kHall, camera, kLeft, kEye)), grey_of(seen_in(World::kHall, camera, kRight, kEye))};
}

// Depth from what eyes show is the depth that they were shown by.
TEST(Matched, DepthIsTheInverseOfParallax) {
  StereoCamera plain, converged, merged;
  converged.convergence = kToeIn, converged.convergence_distance = 3.0f;
  merged.top = merged.bottom = {kMergeCosine, 0.0f, 90.0f, 1.0f};
  for (const StereoCamera& stereo : {plain, converged, merged}) {
    const Camera camera = make_camera(stereo);
    for (const int eye : {kLeft, kRight}) {
      for (float v = 0.15f; v < 0.9f; v += 0.1f) {
        for (const float depth : {0.3f, 1.0f, 8.0f}) {
          const vec2 uv(0.1f + v, v);
          const Ray ray = camera_ray(camera, eye, uv);
          const vec3 point = ray.origin + depth * ray.direction;
          const vec3 look = look_of(camera.projection, uv, uv).direction;
          const float around = 2.0f * eye_side(eye) *
                               std::remainder(std::atan2(point.x, -point.z) - std::atan2(look.x, -look.z), 6.2831853f);
          EXPECT_NEAR(depth_of_parallax(camera, eye, uv, around), depth, 0.01f * depth) << eye << " " << v;
        }
      }
      EXPECT_EQ(depth_of_parallax(make_camera(plain), eye, vec2(0.4f), -0.01f), kFarDepth);
    }
  }
}

TEST(Matched, AHallIsMeasuredToMinutesOfArc) {
  const StereoCamera camera;
  const MatchedEyes matched = match_eyes_for_depth(eyes_of(camera), camera, false);
  EXPECT_GT(matched.share, 0.6);
  EXPECT_LT(matched.precision, 8.0);
  EXPECT_LT(matched.apart, 6.0);
  for (const SeenDepth& seen : matched.seen) {
    const Image truth = hall_depth(camera, seen.eye, kEye);
    std::vector<double> off;
    for (size_t i = 0; i < truth.pixels.size(); i++) {
      const double found = double{seen.depth.pixels[i]};
      if (found > 0.0) off.push_back(0.065 * std::abs(1.0 / found - 1.0 / double{truth.pixels[i]}) * 3437.7);
    }
    std::ranges::sort(off);
    EXPECT_LT(off[off.size() / 2], matched.precision);
    EXPECT_LT(off[off.size() * 9 / 10], 12.0);
    EXPECT_LT(off[off.size() * 99 / 100], 60.0);
  }
  const ComfortVerdict exact = judge_comfort({camera, kLeft, hall_depth(camera, kLeft, kEye), {}, {}});
  const ComfortVerdict found = judge_comfort(matched.seen[0]);
  EXPECT_EQ(found.level, exact.level);
  EXPECT_NEAR(found.nearest, exact.nearest, 0.15 * exact.nearest);
}

// An eye that is too high is measured, and does not spoil the depth.
TEST(Matched, AHigherEyeIsMeasured) {
  const StereoCamera camera;
  std::vector<Image> eyes = eyes_of(camera);
  EyeCorrection raised;
  raised.raise = 0.8f;
  eyes[1] = corrected_view(eyes[1], raised);
  for (float& value : eyes[1].pixels) value = std::isnan(value) ? 0.0f : value;
  const MatchedEyes matched = match_eyes_for_depth(eyes, camera, false);
  EXPECT_NEAR(matched.apart, 48.0, 6.0);
  EXPECT_GT(matched.share, 0.5);
}

TEST(Matched, DifferentPicturesDoNotMatch) {
  const StereoCamera camera;
  const std::vector<Image> eyes = {grey_of(seen_in(World::kHall, camera, kLeft, kEye)),
                                   grey_of(seen_in(World::kCave, camera, kRight, kEye))};
  EXPECT_EQ(match_eyes_for_depth(eyes, camera, false).share, 0.0);
}

// --- how the viewer is carried ---------------------------------------------------------------------------------------

GrayView left_view(const StereoCamera& camera) {
  return make_gray_views({grey_of(seen_in(World::kHall, camera, kLeft, {512, 256}))}, {}, false, 512)[0];
}

TEST(Motion, TurnAndVelocityOfACameraInAHall) {
  StereoCamera before, after;
  after.position = vec3(0.02f, 0.01f, -0.05f);
  after.yaw = -1.5f, after.pitch = 0.5f;
  const Image depth = hall_depth(before, kLeft, {512, 256});
  const ViewerMotion motion = motion_between(left_view(before), left_view(after), depth, 0.1);
  EXPECT_GT(motion.places, 50);
  EXPECT_NEAR(motion.turn.y * 57.2958, 15.0, 1.0);
  EXPECT_NEAR(motion.turn.x * 57.2958, 5.0, 1.0);
  EXPECT_NEAR(motion.turn.z * 57.2958, 0.0, 1.0);
  EXPECT_NEAR(motion.velocity.x, 0.2, 0.05);
  EXPECT_NEAR(motion.velocity.y, 0.1, 0.05);
  EXPECT_NEAR(motion.velocity.z, -0.5, 0.05);
}

TEST(Motion, WithoutDepthNothingIsKnown) {
  const StereoCamera camera;
  Image unknown(512, 256, 1);
  std::ranges::fill(unknown.pixels, NAN);
  EXPECT_EQ(motion_between(left_view(camera), left_view(camera), unknown, 0.1).places, 0);
}

}  // namespace
}  // namespace ods
