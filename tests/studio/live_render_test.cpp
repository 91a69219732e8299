// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/studio/live_render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>

#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/stage/judge_scene.h"

using namespace std::chrono_literals;
using ods::LiveFrame, ods::LiveRender, ods::LiveSettings, ods::LiveView, ods::vec3;
using Frame = std::shared_ptr<const LiveFrame>;

namespace {

LiveSettings settings_for(const ods::Scene& scene) {
  LiveSettings settings;
  settings.camera.position = ods::default_view(scene).position;
  settings.camera.top = settings.camera.bottom = ods::kUsualMerge;
  return settings;
}

// Frames until one fits; null if none does.
Frame wait_for(const LiveRender& live, int number, const std::function<bool(const LiveFrame&)>& fits) {
  while (Frame frame = live.next_frame(number, 60s)) {
    if (fits(*frame)) return frame;
    number = std::max(number, frame->number);
  }
  return nullptr;
}

double mean_of(const LiveFrame& frame) {
  double sum = 0.0;
  for (const uint8_t value : frame.pixels) sum += value;
  return sum / static_cast<double>(frame.pixels.size());
}

class LiveRendering : public testing::Test {
 protected:
  ods::Scene scene = ods::find_builtin("axis")->make();
  LiveSettings settings = settings_for(scene);
};

}  // namespace

TEST_F(LiveRendering, ComesWholeAndCoarseFirstThenFinerWhereOneLooks) {
  LiveRender live(scene, 0);
  const int revision = live.set(settings, {});
  const Frame first = live.next_frame(0, 60s);
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->is_patch);
  EXPECT_EQ(first->revision, revision);
  EXPECT_EQ(first->pixels.size(), 2u * 3u * size_t(first->eye.width) * size_t(first->eye.height));
  const Frame finer = wait_for(live, first->number, [](const LiveFrame& frame) { return !frame.is_patch; });
  ASSERT_TRUE(finer);
  EXPECT_GT(finer->eye.width, first->eye.width);
  EXPECT_NEAR(mean_of(*finer), mean_of(*first), 4.0);
  const Frame patch = wait_for(live, finer->number, [](const LiveFrame& frame) { return frame.is_patch; });
  ASSERT_TRUE(patch);
  const float degrees = patch->camera.projection.longitude.y - patch->camera.projection.longitude.x;
  EXPECT_GT(static_cast<float>(patch->eye.width) / degrees, static_cast<float>(finer->eye.width) / 360.0f);
}

TEST_F(LiveRendering, SaysWhatComesNext) {
  LiveRender live(scene, 0);
  live.set(settings, {});
  Frame frame = live.next_frame(0, 60s);
  for (int i = 0; i < 3; i++) {  // the whole picture, the whole once more, a patch, a finer one: later ones are dear
    ASSERT_TRUE(frame && frame->next);
    const ods::LiveStep said = *frame->next;
    const Frame next = wait_for(live, frame->number, [](const LiveFrame&) { return true; });
    ASSERT_TRUE(next);
    if (next->number > frame->number + 1) break;  // it was too fast for us
    EXPECT_EQ(next->is_patch, said.is_patch);
    EXPECT_EQ(next->eye.width, said.width);
    EXPECT_EQ(next->samples, said.samples);
    frame = next;
  }
}

TEST_F(LiveRendering, ShowsWhatTheRendererRenders) {
  LiveRender live(scene, 0);
  live.set(settings, {});
  const Frame base = wait_for(live, 0, [](const LiveFrame& frame) { return !frame.is_patch && frame.eye.width > 192; });
  ASSERT_TRUE(base);
  ods::RenderOptions options;
  options.width = base->eye.width, options.height = base->eye.height, options.samples = 16, options.layers = false;
  const ods::Picture picture = ods::render_cpu(scene, settings.camera, options);
  double sum = 0.0;
  for (const ods::EyeImage& eye : picture.eyes) {
    const std::vector<float>& light = eye.radiance.pixels;
    for (size_t i = 0; i < light.size(); i += 3) {
      const vec3 color = ods::tone_map(vec3(light[i], light[i + 1], light[i + 2]), 0.0f, settings.tone);
      for (int c = 0; c < 3; c++) sum += 255.0 * static_cast<double>(ods::srgb_encode(color[c]));
    }
  }
  EXPECT_NEAR(mean_of(*base), sum / static_cast<double>(base->pixels.size()), 1.0);
}

TEST_F(LiveRendering, MergesByDepth) {
  LiveRender live(scene, 0);
  const ods::CpuRenderer renderer(scene);
  for (const float height : {1.0f, 2.0f}) {
    settings.camera.position.y = height;
    settings.merge_limit = 25.6f;
    live.set(settings, {});
    const ods::StereoCamera found = live.camera();
    const ods::Image map = ods::merge_map_of(ods::shares_seen(renderer, settings.camera, 25.6f));
    ASSERT_TRUE(found.merge_map);
    EXPECT_EQ(found.top.mode, ods::kMergeMap);
    EXPECT_EQ(found.bottom.mode, ods::kMergeMap);
    EXPECT_EQ(found.merge_map->pixels, map.pixels);
    const Frame frame =
        wait_for(live, 0, [&](const LiveFrame& each) { return each.camera.position.y == height && !each.is_patch; });
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->camera, found);
    settings.merge_limit.reset();
    live.set(settings, {});
    EXPECT_EQ(live.camera(), settings.camera);
  }
}

TEST_F(LiveRendering, AChangeDropsWhatWasRendered) {
  LiveRender live(scene, 0);
  int revision = live.set(settings, {});
  EXPECT_EQ(live.set(settings, {}), revision) << "nothing has changed";
  const Frame before = live.next_frame(0, 60s);
  ASSERT_TRUE(before);
  for (int i = 0; i < 30; i++) {
    settings.camera.yaw += 1.0f;
    revision = live.set(settings, {});
    std::this_thread::sleep_for(3ms);
  }
  const Frame after =
      wait_for(live, before->number, [&](const LiveFrame& frame) { return frame.revision == revision; });
  ASSERT_TRUE(after);
  EXPECT_FALSE(after->is_patch);
  EXPECT_EQ(after->camera, settings.camera);
}

TEST_F(LiveRendering, AnotherExposureShowsTheSameSamplesAtOnce) {
  LiveRender live(scene, 0);
  live.set(settings, {});
  const Frame before = wait_for(live, 0, [](const LiveFrame& frame) { return frame.is_patch; });
  ASSERT_TRUE(before);
  const Frame finer =
      wait_for(live, 0, [](const LiveFrame& frame) { return !frame.is_patch && frame.eye.width > 192; });
  ASSERT_TRUE(finer);
  settings.exposure = 1.0f;
  const int revision = live.set(settings, {});
  const Frame after = wait_for(live, finer->number, [&](const LiveFrame& frame) { return frame.revision == revision; });
  ASSERT_TRUE(after);
  EXPECT_GT(after->eye.width, 192) << "it began anew";
  const Frame patch = wait_for(live, before->number,
                               [&](const LiveFrame& frame) { return frame.revision == revision && frame.is_patch; });
  ASSERT_TRUE(patch);
  EXPECT_GT(mean_of(*patch), mean_of(*before) + 5.0);
}

TEST_F(LiveRendering, ThePatchFollowsTheLook) {
  LiveRender live(scene, 0);
  live.set(settings, {});
  const Frame before = wait_for(live, 0, [](const LiveFrame& frame) { return frame.is_patch; });
  ASSERT_TRUE(before);
  LiveView behind;
  behind.yaw = 170.0f;
  live.look(behind);
  const Frame after = wait_for(live, before->number, [&](const LiveFrame& frame) {
    return frame.is_patch && frame.camera.projection.longitude.y > 180.0f;
  });
  ASSERT_TRUE(after);
  EXPECT_EQ(after->revision, before->revision);
}

TEST(LivePatch, CoversTheCornersOfEveryView) {
  for (const float pitch : {-90.0f, -60.0f, -20.0f, 0.0f, 35.0f, 80.0f}) {
    for (const float fov : {30.0f, 90.0f, 120.0f}) {
      const LiveView view{25.0f, pitch, fov, 1.6f};
      const ods::StereoCamera patch = patch_camera({}, view);
      const ods::Camera camera = make_camera(patch);
      const float across = std::tan(glm::radians(0.5f * fov));
      const auto axes = ods::orientation(glm::radians(view.yaw), glm::radians(view.pitch), 0.0);
      for (const float x : {-1.0f, 0.0f, 1.0f}) {
        for (const float y : {-1.0f, 0.0f, 1.0f}) {
          const vec3 direction =
              vec3(axes[0]) * (x * across) + vec3(axes[1]) * (y * across / view.aspect) - vec3(axes[2]);
          EXPECT_TRUE(place_of(camera.projection, direction).seen) << pitch << " " << fov << " " << x << " " << y;
        }
      }
      const ods::Extent size = patch_extent(patch);
      EXPECT_LE(size.width * size.height, 800'000);
    }
  }
}

// One wall at z = -3: a level ray straight ahead starts at the eye, 32.5 mm beside the middle.
TEST(LivePick, SaysDistanceAndDisparity) {
  ods::Scene scene;
  scene.materials.push_back(ods::default_material());
  std::vector<ods::Vertex> corners(4);
  for (int i = 0; i < 4; i++) {
    corners[size_t(i)].position = vec3(i % 2 ? 50.0f : -50.0f, i / 2 ? 50.0f : -50.0f, -3.0f);
    corners[size_t(i)].normal = vec3(0.0f, 0.0f, 1.0f);
  }
  add_instance(scene, add_mesh(scene, corners, {{0, 1, 3}, {0, 3, 2}}, 0), glm::mat4(1.0f));
  scene.environment.radiance = vec3(1.0f);
  LiveRender live(scene, 0);
  EXPECT_FALSE(live.pick(ods::kLeft, vec3(0.0f, 0.0f, -1.0f))) << "there is no picture yet";
  LiveSettings settings;
  live.set(settings, {});
  ASSERT_TRUE(wait_for(live, 0, [](const LiveFrame& frame) { return frame.is_patch; }));
  const auto pick = live.pick(ods::kLeft, vec3(0.0f, 0.0f, -1.0f));
  ASSERT_TRUE(pick);
  EXPECT_NEAR(pick->distance, 3.0f, 0.01f);
  EXPECT_NEAR(pick->point.z, -3.0f, 0.001f);
  const float expected = glm::degrees(2.0f * std::asin(0.0325f / 3.0f)) * 60.0f;
  EXPECT_NEAR(pick->disparity, expected, 0.1f);
  ASSERT_TRUE(pick->places[ods::kLeft] && pick->places[ods::kRight]);
  EXPECT_NEAR(pick->places[ods::kLeft]->x, 0.5f, 0.002f);
  EXPECT_NEAR((*pick->places[ods::kLeft] - *pick->places[ods::kRight]).x * 360.0f * 60.0f, expected, 0.5f);
  EXPECT_FALSE(live.pick(ods::kLeft, vec3(0.0f, 0.0f, 1.0f))) << "there is nothing behind";
}

TEST_F(LiveRendering, RestsWhileNobodyLooks) {
  LiveRender live(scene, 0, 1ms);
  live.set(settings, {});
  const Frame first = live.next_frame(0, 60s);
  ASSERT_TRUE(first);
  std::this_thread::sleep_for(1500ms);  // at most one step more was under way
  const Frame second = live.next_frame(first->number, 60s);
  ASSERT_TRUE(second);
  EXPECT_LE(second->number, first->number + 1);
  const Frame third = live.next_frame(second->number, 60s);
  ASSERT_TRUE(third);
  EXPECT_GT(third->number, second->number);
}

TEST_F(LiveRendering, EndsInTheMiddle) {
  for (int i = 0; i < 5; i++) {
    LiveRender live(scene, 0);
    live.set(settings, {});
    std::this_thread::sleep_for(i * 20ms);
  }
}
