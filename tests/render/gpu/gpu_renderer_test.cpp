// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Built-in scenes on a card, and the order of its work.
#include "ods/render/gpu/gpu_renderer.h"

#include "ods/render/cpu/render.h"
#include "ods/render/gpu/shaders/shared.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/motion.h"
#include "tests/render/gpu/agreement.h"

namespace ods {
namespace {

class GpuRendererTest : public OnCard {};

StereoCamera camera_of(const Scene& scene) {
  StereoCamera camera;
  camera.position = default_view(scene).position;
  return camera;
}

TEST_F(GpuRendererTest, AgreesWithTheCpu) {
  for (const char* name : {"furnace", "wineglass", "mirrors", "lamp", "slab", "axis", "spheres"}) {
    const Scene scene = find_builtin(name)->make();
    const StereoCamera camera = camera_of(scene);
    expect_agreement(sampled(CpuRenderer(scene), camera, small_options()),
                     sampled(GpuRenderer(scene, card), camera, small_options()), name);
  }
}

// Windows to the sky, hundreds of lamps, glass, textures.
TEST_F(GpuRendererTest, AgreesWithTheCpuInARoom) {
  const Scene scene = find_builtin("room")->make();
  RenderOptions options = small_options();
  options.samples = 8;
  options.caustics = Caustics::kStraight;
  const StereoCamera camera = camera_of(scene);
  expect_agreement(sampled(CpuRenderer(scene), camera, options), sampled(GpuRenderer(scene, card), camera, options),
                   "room");
}

TEST_F(GpuRendererTest, SumsAreEqualForAnyOrderOfTheWork) {
  const Scene scene = find_builtin("wineglass")->make();
  RenderOptions options = small_options();
  const StereoCamera camera = camera_of(scene);
  const PictureSamples whole = sampled(GpuRenderer(scene, card), camera, options);
  options.last_tile_first = true;
  const PictureSamples sliced = sampled(GpuRenderer(scene, card, 3 * kGroupSize), camera, options);
  for (size_t eye = 0; eye < 2; eye++) {
    EXPECT_EQ(whole.eyes[eye].light, sliced.eyes[eye].light);
    EXPECT_EQ(whole.eyes[eye].squares, sliced.eyes[eye].squares);
    EXPECT_EQ(whole.eyes[eye].alone, sliced.eyes[eye].alone);
    EXPECT_EQ(whole.eyes[eye].weights, sliced.eyes[eye].weights);
    EXPECT_EQ(whole.eyes[eye].normal, sliced.eyes[eye].normal);
    EXPECT_EQ(whole.eyes[eye].albedo, sliced.eyes[eye].albedo);
    EXPECT_EQ(whole.eyes[eye].depth, sliced.eyes[eye].depth);
  }
}

// Things that turn, bend and change their shape.
TEST_F(GpuRendererTest, FollowsAnAnimation) {
  Scene scene = find_builtin("toys")->make();
  scene.lights.clear(), scene.animation.lights.clear();  // a spotlight stands in its own hood, where last bits decide
  play(scene.animation, "");
  set_time(scene, 0.0);
  GpuRenderer renderer(scene, card);
  const CpuRenderer cpu_before(scene);
  const StereoCamera camera = camera_of(scene);
  RenderOptions options = small_options();
  options.samples = 4;
  const PictureSamples before = sampled(renderer, camera, options);
  expect_agreement(sampled(cpu_before, camera, options), before, "at 0 seconds");
  renderer.update(set_time(scene, 2.5));
  const PictureSamples after = sampled(renderer, camera, options);
  expect_agreement(sampled(CpuRenderer(scene), camera, options), after, "at 2.5 seconds");
  EXPECT_NE(before.eyes[0].depth, after.eyes[0].depth) << "else this test shows nothing";
  EXPECT_EQ(after.eyes[0].light, sampled(GpuRenderer(scene, card), camera, options).eyes[0].light);
}

TEST_F(GpuRendererTest, FindsTheObjectsThatPixelsShow) {
  const Scene scene = find_builtin("mirrors")->make();
  const StereoCamera camera = camera_of(scene);
  const RenderOptions options = small_options();
  const auto cpu = CpuRenderer(scene).center_hits(camera, options);
  const auto gpu = GpuRenderer(scene, card).center_hits(camera, options);
  ASSERT_EQ(cpu.size(), gpu.size());
  for (size_t eye = 0; eye < cpu.size(); eye++) {
    size_t same = 0;
    for (size_t i = 0; i < cpu[eye].size(); i++) same += cpu[eye][i].instance == gpu[eye][i].instance;
    EXPECT_GE(same, cpu[eye].size() - cpu[eye].size() / 100);
  }
}

}  // namespace
}  // namespace ods
