// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/depth/hidden_panorama.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/camera/project.h"
#include "tests/support/ball_in_box.h"

namespace ods::hidden_panorama_test {

constexpr float kReach = 0.26f;

struct Hidden {
  DepthPanorama front, hidden;
};

Hidden hidden_in(const MadePicture& made) {
  const Source source = make_source(made.picture);
  const Reprojection picture = make_reprojection(source);
  const PageGrid grid(264, 1);
  const DepthPanorama front = look_from_middle(picture, grid, kReach);
  return {front, hidden_panorama(picture, front, grid, kReach)};
}

// The angle by which a direction is inside of the ball's outline; negative outside.
float inside_ball(vec3 ray) {
  return std::asin(kRadius / length(kBall)) - std::acos(std::min(dot(ray, normalize(kBall)), 1.0f));
}

// The distance of the walls, behind the ball.
float wall_distance(vec3 ray) {
  float box = 1e9f;
  for (int i = 0; i < 3; i++) box = std::min(box, kBox[i] / std::abs(ray[i]));
  return box;
}

TEST(HiddenPanorama, ContinuesTheWallBehindTheBall) {
  const auto [front, hidden] = hidden_in(picture_of_world(StereoCamera(), {1024, 512}, {kMono}));
  // An eye that is as far beside the middle as it may be sees so much of the wall behind the ball's outline.
  const float ball = std::sqrt(dot(kBall, kBall) - kRadius * kRadius);
  const float seen = kReach * (1.0f / ball - 1.0f / 3.2f);
  size_t inside = 0, off = 0, beyond = 0, elsewhere = 0;
  for (size_t texel = 0; texel < hidden.nearness.size(); texel++) {
    const vec3 ray = ray_of(hidden.grid, texel_at(hidden.grid, texel));
    const bool is_there = hidden.nearness[texel] > 0.0f;
    const float depth = inside_ball(ray), pixel = hidden.grid.pixel();
    if (depth < -4.0f * pixel) elsewhere += is_there ? 1 : 0;
    if (depth > seen + 8.0f * pixel) beyond += is_there ? 1 : 0;
    if (depth < 2.0f * pixel || depth > 0.8f * seen) continue;
    inside += is_there ? 1 : 0;
    off += is_there && std::abs(hidden.nearness[texel] * wall_distance(ray) - 1.0f) < 0.15f ? 0 : 1;
  }
  EXPECT_GT(inside, 200u);
  EXPECT_LT(off, inside / 50);
  EXPECT_EQ(beyond, 0u);
  EXPECT_EQ(elsewhere, 0u);
}

// Returns whether an eye of a stereo camera sees a point of the wall.
bool sees(const StereoCamera& stereo, int eye, vec3 point) {
  const Camera camera = make_camera(stereo);
  const ImagePosition at = project_point(camera, eye, point);
  return at.seen && !look_at_world(camera_ray(camera, eye, at.uv)).ball;
}

// The share of hidden texels with the wall's own colour, of those where the left eye or the right one sees the wall.
double share_right(const DepthPanorama& hidden, const StereoCamera& camera) {
  double right = 0.0, count = 0.0;
  for (size_t texel = 0; texel < hidden.nearness.size(); texel++) {
    const vec3 ray = ray_of(hidden.grid, texel_at(hidden.grid, texel));
    if (!(hidden.nearness[texel] > 0.0f) || inside_ball(ray) < 2.0f * hidden.grid.pixel()) continue;
    const vec3 point = wall_distance(ray) * ray;
    if (!sees(camera, kLeft, point) && !sees(camera, kRight, point)) continue;
    // From beyond the ball.
    const vec3 wall = look_at_world({(wall_distance(ray) - 0.01f) * ray, ray}).color;
    right += length(hidden.colors[texel] - wall) < 0.01f ? 1.0 : 0.0;
    count++;
  }
  return right / count;
}

TEST(HiddenPanorama, TakesTheColoursThatAnEyeSees) {
  StereoCamera camera;
  camera.ipd = 0.3f;
  const double of_one = share_right(hidden_in(picture_of_world(camera, {1024, 512}, {kMono})).hidden, camera);
  const double of_two = share_right(hidden_in(picture_of_world(camera, {1024, 512}, {kLeft, kRight})).hidden, camera);
  EXPECT_GT(of_two, 0.5);
  EXPECT_LT(of_one, 0.25);
}

}  // namespace ods::hidden_panorama_test
