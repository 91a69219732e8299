// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Each thing that cards cannot render yet is named, with its remedy.
#include "ods/render/gpu/gpu_lacks.h"

#include <gtest/gtest.h>

#include "ods/scene/builtin/builtin.h"
#include "tests/support/scenes.h"

namespace ods {
namespace {

Scene plain_scene() {
  Scene scene;
  add_box(scene, vec3(-1.0f), vec3(1.0f), add_material(scene, matte(vec3(0.5f)), "wall"));
  return scene;
}

void expect_lack(const Scene& scene, const RenderOptions& options, bool is_blurred, const std::string& word) {
  const std::string lacks = gpu_lacks(scene, options, is_blurred);
  EXPECT_NE(lacks.find(word), std::string::npos) << lacks;
  EXPECT_NE(lacks.find("`device` cpu"), std::string::npos) << lacks;
}

TEST(GpuLacks, NothingOfAPlainScene) {
  EXPECT_EQ(gpu_lacks(plain_scene(), {}, false), "");
}

TEST(GpuLacks, TheLightCache) {
  RenderOptions options;
  options.indirect = Indirect::kCache;
  expect_lack(plain_scene(), options, false, "`indirect` path");
}

TEST(GpuLacks, MotionBlur) {
  expect_lack(plain_scene(), {}, true, "`shutter` 0");
}

TEST(GpuLacks, TheSameBitsEverywhere) {
  Scene scene = plain_scene();
  scene.portable = true;
  expect_lack(scene, {}, false, "last bits");
}

TEST(GpuLacks, ScenesWithTooManyCopies) {
  Scene scene = plain_scene();
  const int mesh = add_mesh(scene, std::vector<Vertex>(1), std::vector<uvec3>(1000, uvec3(0)), 0);
  for (size_t i = 0; i < kMaxCardTriangles / 1000; i++) add_instance(scene, mesh, glm::mat4(1.0f));
  expect_lack(scene, {}, false, "20 million");
}

}  // namespace
}  // namespace ods
