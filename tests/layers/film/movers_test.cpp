// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/movers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/surface.h"
#include "ods/scene/motion.h"
#include "tests/support/moving_files.h"

namespace ods::movers_test {

constexpr float kTurn = 0.70710678f;

// Triangles on nodes 0 to 5: still; turning a quarter about z while it moves; another one attached to it; in motion on
// a parent that is scaled along x and turns, which shears; hidden from second 1 on; and one with keys that are equal.
Scene moving_scene() {
  GltfBuilder file = make_triangle();
  file.json["nodes"] = GltfJson::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [0, 0, -2], "children": [2]},
      {"mesh": 0, "translation": [2, 0, 0]},
      {"children": [4], "scale": [3, 1, 1]}, {"mesh": 0},
      {"mesh": 0, "translation": [0, 3, 0]}, {"mesh": 0, "translation": [0, 5, 0]}])");
  file.json["scenes"][0]["nodes"] = {0, 1, 3, 5, 6};
  file.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_node_visibility"};
  file.node(5)["extensions"]["KHR_node_visibility"]["visible"] = true;
  animate(file, node_target(1, "rotation"), {0, 2}, {0, 0, 0, 1, 0, 0, kTurn, kTurn}, "VEC4");
  animate(file, node_target(1, "translation"), {0, 2}, {0, 0, -2, 4, 0, -2}, "VEC3");
  animate(file, node_target(4, "rotation"), {0, 2}, {0, 0, 0, 1, 0, 0, kTurn, kTurn}, "VEC4");
  animate(file, node_target(6, "translation"), {0, 2}, {0, 5, 0, 0, 5, 0}, "VEC3");
  animate(file, node_target(5, "scale"), {0, 1, 2}, {1, 1, 1, 0, 0, 0, 0, 0, 0}, "VEC3", "STEP");
  Scene scene = file.load();
  play(scene.animation, "");
  return scene;
}

vec3 at_pose(const Mover& mover, size_t frame, vec3 p) {
  const LayerPose& pose = mover.poses[frame];
  const vec3 q(pose.rotation), v = pose.scale * (p - mover.origin);
  return pose.place + v + 2.0f * cross(q, cross(q, v) + pose.rotation.w * v);
}

vec3 corner(const Scene& scene, int instance, uint vertex) {
  const Instance& placed = scene.instances[static_cast<size_t>(instance)];
  return to_world(placed,
                  scene.vertices[scene.meshes[static_cast<size_t>(placed.mesh)].first_vertex + vertex].position);
}

TEST(Movers, AreWhatDiffersBetweenFrames) {
  Scene scene = moving_scene();
  ASSERT_EQ(scene.instances.size(), 6u);
  const std::vector<double> times = {0.0, 0.5, 1.0, 1.5, 2.0};
  const std::vector<Mover> movers = find_movers(scene, times);
  ASSERT_EQ(movers.size(), 3u);
  int rigid = 0, sheared = 0, appearing = 0;
  for (const Mover& mover : movers) {
    ASSERT_EQ(mover.poses.size(), times.size());
    rigid += mover.instances.size() == 2 && !mover.deforms ? 1 : 0;
    sheared += mover.deforms ? 1 : 0;
    appearing += mover.poses[1].shown && !mover.poses[2].shown ? 1 : 0;
  }
  EXPECT_EQ(rigid, 1);
  EXPECT_EQ(sheared, 1);
  EXPECT_EQ(appearing, 1);
}

// A pose takes every corner to where the scene has it.
TEST(Movers, HavePosesThatGiveTheScenesPlaces) {
  Scene scene = moving_scene();
  const std::vector<double> times = {0.0, 0.5, 1.0, 1.5, 2.0};
  const std::vector<Mover> movers = find_movers(scene, times);
  int compared = 0;
  for (const Mover& mover : movers) {
    if (mover.deforms) continue;
    for (const int instance : mover.instances) {
      for (uint v = 0; v < 3; v++) {
        set_time(scene, times[mover.reference]);
        const vec3 before = corner(scene, instance, v);
        for (size_t frame = 0; frame < times.size(); frame++) {
          if (!mover.poses[frame].shown) continue;
          set_time(scene, times[frame]);
          EXPECT_LT(length(at_pose(mover, frame, before) - corner(scene, instance, v)), 1e-5f);
          compared++;
        }
      }
    }
  }
  EXPECT_EQ(compared, 2 * 3 * 5 + 3 * 2);
}

TEST(Movers, DeformIfASkinOrMorphTargetsMoveThem) {
  for (Scene scene : {make_skinned(false).load(), make_morphed().load()}) {
    play(scene.animation, "");
    const std::vector<Mover> movers = find_movers(scene, std::vector<double>{0.0, 0.25, 0.5});
    ASSERT_EQ(movers.size(), 1u);
    EXPECT_TRUE(movers[0].deforms);
    EXPECT_EQ(find_movers(scene, std::vector<double>{0.5, 0.5}).size(), 0u);
  }
}

TEST(Movers, AreTimesThatAreStill) {
  Scene scene = moving_scene();
  EXPECT_TRUE(find_movers(scene, std::vector<double>{0.0}).empty());
  EXPECT_TRUE(find_movers(scene, std::vector<double>{2.0, 3.0, 4.0}).empty());
}

TEST(Movers, StayHiddenUntilTheyAreShown) {
  Scene scene = moving_scene();
  const std::vector<double> times = {0.0, 1.0, 2.0};
  const std::vector<Mover> movers = find_movers(scene, times);
  HiddenMovers hidden = hide_movers(scene, movers, false);
  const auto visible = [&] {
    size_t count = 0;
    for (size_t i = 0; i < scene.instances.size(); i++) count += is_hidden(scene, i) ? 0 : 1;
    return count;
  };
  set_time(scene, 0.0);
  EXPECT_EQ(visible(), 2u);
  show_movers(scene, std::move(hidden));
  set_time(scene, 0.0);
  EXPECT_EQ(visible(), 6u);
}

}  // namespace ods::movers_test
