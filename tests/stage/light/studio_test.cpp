// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/studio.h"

#include <gtest/gtest.h>

#include "ods/denoise/denoise.h"
#include "ods/render/cpu/render.h"
#include "tests/support/pictures.h"

namespace ods {
namespace {

// The radiance that a camera sees in a direction; degrees.
double seen(const Scene& scene, vec3 eye, float yaw, float pitch, int samples = 1024, float fov = 2.0f) {
  StereoCamera camera;
  camera.position = eye;
  camera.yaw = yaw;
  camera.pitch = pitch;
  camera.projection.kind = kPerspective;
  camera.projection.fov = fov;
  return mean_of(render_cpu(scene, camera, small_render(4, samples)).eyes[0].radiance).value();
}

// A small white square around the origin that faces `normal`.
Scene target(vec3 normal) {
  Scene scene;
  const vec3 right = normalize(cross(vec3(0.01f, 1.0f, 0.0f), normal)), up = cross(normal, right);
  add_rectangle(scene, -0.5f * (right + up), right, up, add_material(scene, matte(vec3(1.0f))));
  scene.environment = make_studio();
  return scene;
}

TEST(Studio, LightsWhatFacesTheViewerAsWhite) {
  EXPECT_NEAR(seen(target(vec3(0, 0, 1)), vec3(0, 0, 2), 0, 0), 1.0, 0.1);
}

// Key on the left, fill on the right, both weaker than together; behind there is rim light enough for edges.
TEST(Studio, HasKeyFillAndRim) {
  const double left = seen(target(normalize(vec3(-1, 0.2f, 1))), 2.0f * normalize(vec3(-1, 0.2f, 1)), 45, -8);
  const double right = seen(target(normalize(vec3(1, 0.2f, 1))), 2.0f * normalize(vec3(1, 0.2f, 1)), -45, -8);
  EXPECT_GT(left, 1.4 * right);
  EXPECT_GT(right, 0.35);
  const Scene scene = target(vec3(0, 0, 1));
  double brightest = 0.0;
  for (float yaw = -60.0f; yaw <= 60.0f; yaw += 4.0f) {
    brightest = std::max(brightest, seen(scene, vec3(0, 0, -5), yaw, 45, 1));
  }
  EXPECT_GT(brightest, 3.0);
}

TEST(Studio, TurnsWithTheViewer) {
  const Environment straight = make_studio(), turned = make_studio(90.0f);
  const size_t quarter = 128, width = 512;
  for (size_t i = 0; i < straight.texels.size(); i += 97) {
    const size_t row = i / width * width, column = i % width;
    EXPECT_NEAR(straight.texels[i].g, turned.texels[row + (column + quarter) % width].g, 2e-2f) << i;
  }
}

// The floor is told from the wall behind it, but no line divides them, and the wall darkens upwards.
TEST(Studio, TheWallIsBrighterThanTheFloor) {
  Scene scene;
  scene.environment = make_studio_walls();
  const auto at = [&](float pitch) { return seen(scene, vec3(0.0f), 0, pitch, 1, 0.5f); };
  EXPECT_GT(at(10.0f), 1.5 * at(-10.0f));
  EXPECT_LT(std::abs(at(0.7f) - at(-0.7f)), 0.1 * at(-0.7f));
  EXPECT_LT(at(50.0f), 0.2 * at(10.0f));
}

// The shadow of a ball on the ground: its darkest place against the open ground.
TEST(Studio, TheKeyLightCastsAShadow) {
  Scene scene;
  scene.environment = make_studio();
  add_ground(scene, vec3(0.0f), 8.0f, studio_floor());
  const double open = seen(scene, vec3(0, 3, 0.01f), 0, -89.9f, 512);
  add(scene, make_sphere(0.5f, 48), add_material(scene, matte(vec3(0.5f))), placed(vec3(0, 0.6f, 0)));
  double darkest = open;
  for (float off = 0.5f; off < 1.2f; off += 0.1f) {  // away from the key light: behind the ball, to its right
    const vec3 place(off * 0.7071f, 0.0f, -off * 0.7071f), eye = place + vec3(0.9f, 1.0f, -0.9f);
    const vec3 way = place - eye;
    const float yaw = glm::degrees(std::atan2(way.x, -way.z));
    const float pitch = glm::degrees(std::atan2(way.y, std::hypot(way.x, way.z)));
    darkest = std::min(darkest, seen(scene, eye, yaw, pitch, 512));
  }
  EXPECT_LT(darkest, 0.45 * open);
}

// Far from any shadow the ground looks as the studio's own floor does, so its edge cannot be seen.
TEST(Studio, GroundLooksLikeTheFloor) {
  Scene scene = target(vec3(0, 1, 0));
  scene.instances.clear();
  const double floor = seen(scene, vec3(0.0f), 0, -60, 1);
  add_ground(scene, vec3(0, -1, 0), 8.0f, studio_floor());
  for (const float pitch : {-85.0f, -40.0f, -14.0f, -10.0f, -8.0f}) {
    EXPECT_NEAR(seen(scene, vec3(0.0f), 30, pitch), floor, 0.03 * floor) << pitch;
  }
  EXPECT_GT(floor, 0.2);
  EXPECT_LT(floor, 0.5);
}

// The denoiser takes ground and background for one thing, so no line of noise is left where the ground ends.
TEST(Studio, DenoisingLeavesNoLineWhereTheGroundEnds) {
  Scene scene;
  scene.environment = make_studio();
  scene.background = make_studio_walls();
  add_ground(scene, vec3(0, -0.7f, 0), 8.0f, studio_floor());
  RenderOptions options;
  options.width = 512;
  options.samples = 8;
  options.statistics = true;
  StereoCamera camera;
  Picture picture = render_cpu(scene, camera, options);
  const EyeImage& eye = picture.eyes[0];
  EXPECT_LT(*eye.depth.at(9, 200), kFarDepth);
  EXPECT_EQ(eye.albedo.at(9, 200)[0], 0.0f);
  EXPECT_NEAR(eye.normal.at(9, 200)[1], 0.01f, 0.001f) << "bare sky has none";
  denoise(picture, camera);
  const int edge = 128 + static_cast<int>(std::atan2(0.7f, 8.0f) / 3.14159265f * 256.0f);  // its row
  const float floor = eye.radiance.at(0, 130)[1];
  const auto noise = [&](int first, int last) {
    double sum = 0.0;
    for (int y = first; y <= last; y++) {
      for (int x = 0; x < 512; x++) sum += std::pow(double{eye.radiance.at(x, y)[1] - floor}, 2.0);
    }
    return std::sqrt(sum / (512.0 * (last - first + 1)));
  };
  EXPECT_LT(noise(edge - 1, edge + 1), 0.012 * double{floor});
  EXPECT_LT(noise(edge + 8, edge + 30), 0.03 * double{floor});
}

TEST(Studio, GroundCatchesTheShadowAndIsInvisibleFromBelow) {
  Scene scene = target(vec3(0, 1, 0));
  scene.instances.clear();
  add_ground(scene, vec3(0, -1, 0), 8.0f, studio_floor());
  const double open = seen(scene, vec3(0, 0, 4), 0, -45);
  add(scene, make_sphere(0.8f, 24), add_material(scene, matte(vec3(0.5f))), placed(vec3(-0.8f, -0.2f, 3.3f)));
  EXPECT_LT(seen(scene, vec3(0, 0, 4), 0, -45), 0.75 * open);
  EXPECT_GT(seen(scene, vec3(0, -3, 0), 0, 40, 1, 1.0f), 0.0) << "the studio, through the ground";
}

TEST(Studio, HiddenListFollowsTheInstances) {
  Scene scene = target(vec3(0, 1, 0));
  scene.hidden = {1};
  add_ground(scene, vec3(0, -1, 0), 8.0f, studio_floor());
  EXPECT_EQ(scene.hidden, (std::vector<char>{1, 0}));
}

}  // namespace
}  // namespace ods
