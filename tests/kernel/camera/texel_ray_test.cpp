// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/kernel/camera/texel_ray.h"

#include <gtest/gtest.h>

#include "tests/support/texels.h"

namespace ods::texel_ray_test {

// A table of 5 x 3 texels whose origins are their numbers.
StereoCamera numbered() {
  TexelRays texels = empty_texels(5, 3);
  for (size_t i = 0; i < texels.rays.size(); i++) {
    texels.rays[i] = {vec3(static_cast<float>(i), 0, 0), vec3(0, 0, -1), vec3(0, 2, 0), vec3(0, 0, 4)};
  }
  return camera_of(texels);
}

TEST(TexelRay, IsThatOfTheTexelOfHome) {
  const StereoCamera stereo = numbered();
  const Camera camera = make_camera(stereo);
  for (int i = 0; i < 15; i++) {
    const vec2 home((static_cast<float>(i % 5) + 0.5f) / 5.0f, (static_cast<float>(i / 5) + 0.5f) / 3.0f);
    for (const int eye : {kLeft, kRight, kMono}) {
      const Ray ray = sample_ray(camera, eye, home, home, vec2(0.3f));
      EXPECT_NEAR(ray.origin.x, static_cast<float>(i), 1e-5f);
      EXPECT_LT(length(vec2(ray.origin.y, ray.origin.z)), 1e-5f);
      EXPECT_EQ(ray.direction, vec3(0, 0, -1));
    }
  }
}

// A sample at the texel's edge belongs to the texel of `home`, whatever texel it rounds to.
TEST(TexelRay, CoversTheTexelToItsEdges) {
  const StereoCamera stereo = numbered();
  const Camera camera = make_camera(stereo);
  const vec2 home(1.5f / 5.0f, 0.5f);
  for (const float x : {-0.5f, 0.25f, 0.5f}) {
    for (const float y : {-0.5f, 0.0f, 0.5f}) {
      const Ray ray = sample_ray(camera, kMono, home, home + vec2(x / 5.0f, y / 3.0f), vec2(0.0f));
      EXPECT_LT(length(ray.origin - vec3(6.0f, 2.0f * x, 4.0f * y)), 1e-5f) << x << " " << y;
    }
  }
}

// For the light cache, whose paths have no pixel: home is the sample itself.
TEST(TexelRay, CoversTheTexelFromAnyHome) {
  const StereoCamera stereo = numbered();
  const Camera camera = make_camera(stereo);
  const vec2 at(4.9f / 5.0f, 2.75f / 3.0f);
  EXPECT_LT(length(sample_ray(camera, kMono, at, at, vec2(0.0f)).origin - vec3(14.0f, 0.8f, 1.0f)), 1e-5f);
  for (const float end : {0.0f, 1.0f}) {
    const Ray ray = sample_ray(camera, kMono, vec2(end), vec2(end), vec2(0.0f));
    EXPECT_EQ(ray.origin.x, end * 14.0f);
  }
}

TEST(TexelRay, CamerasWithoutATableAreThemselves) {
  StereoCamera stereo;
  stereo.lens_radius = 0.01f;
  const Camera camera = make_camera(stereo);
  const vec2 home(0.3f, 0.4f), uv(0.31f, 0.39f), lens(0.2f, 0.7f);
  const Ray a = sample_ray(camera, kLeft, home, uv, lens), b = camera_ray(camera, kLeft, home, uv, lens);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.direction, b.direction);
}

}  // namespace ods::texel_ray_test
