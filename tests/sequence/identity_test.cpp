// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/identity.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/gltf_builder.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

std::string change_of_frame(void (*change)(SequenceOptions& options), float noise = 0.1f) {
  SequenceOptions options;
  options.render.noise = noise;
  const Settings before = frame_identity(options);
  change(options);
  return settings_difference(before, frame_identity(options));
}

std::string change_of_samples(void (*change)(SequenceOptions& options)) {
  SequenceOptions options;
  options.render.noise = 0.1f;
  const Settings before = sample_identity(options, 0.0);
  change(options);
  return settings_difference(before, sample_identity(options, 0.0));
}

TEST(Identity, NamesAreUnique) {
  std::set<std::string> names;
  for (const Setting& setting : frame_identity({})) EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
}

TEST(Identity, WhatChangesAFrame) {
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.camera.stereo.ipd = 0.05f; }), "`ipd` was 0.065, now 0.05");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.camera.yaw = 3.0f; }), "`yaw` was of the scene, now 3");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.camera.move.turns = 2.0; }),
            "`turntable` was 0, now 2; `duration` was any, now 10");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.render.cache_paths = 7; }),
            "paths of the light cache was 0, now 7");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.finish.save.layout = Layout::kSideBySide; }),
            "`layout` was top-bottom, now side-by-side");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.render.time_limit = 7.0; }), "`time-limit` was 0, now 7");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.merge_limit = 8.0f; }),
            "merge by depth is new; `merge` was given, now 8");
}

TEST(Identity, WhatChangesNothing) {
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.render.threads = 3; }), "");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.finish.save.exposure = 3.0f; }), "");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.finish.save.tone = ToneCurve::kLinear; }), "");
}

// Noise is judged at the exposure; where none is, the exposure is the video's alone.
TEST(Identity, TheExposureIsThatOfFramesWhoseNoiseIsJudged) {
  const auto change = [](SequenceOptions& o) { o.exposure = 2.0f; };
  EXPECT_EQ(change_of_frame(change), "`exposure` was by a first look, now 2");
  EXPECT_EQ(change_of_frame([](SequenceOptions& o) { o.brighter = 1.0f; }), "`brighter` was 0, now 1");
  EXPECT_EQ(change_of_frame(change, 0.0f), "");
}

// A still picture resumes with another time limit, and its noise is judged again at another exposure.
TEST(Identity, SamplesAreNotOfAFile) {
  EXPECT_EQ(change_of_samples([](SequenceOptions& o) { o.exposure = 2.0f; }), "");
  EXPECT_EQ(change_of_samples([](SequenceOptions& o) { o.render.time_limit = 7.0; }), "");
  EXPECT_EQ(change_of_samples([](SequenceOptions& o) { o.finish.save.layout = Layout::kSideBySide; }), "");
  EXPECT_EQ(change_of_samples([](SequenceOptions& o) { o.render.part = {2, 3}; }), "`part` was 1/1, now 2/3");
  EXPECT_EQ(settings_difference(sample_identity({}, 0.0), sample_identity({}, 1.5)), "`time` was 0, now 1.5");
}

TEST(Identity, ASceneIsItsContents) {
  const TemporaryFolder folder;
  const auto settings = [&](const std::string& name) { return scene_settings(folder.path(name)); };
  folder.write("a.gltf", make_triangle().json.dump());
  folder.write("b.gltf", make_triangle().json.dump());
  EXPECT_EQ(settings_difference(settings("a.gltf"), settings("b.gltf")), "");
  const Settings before = settings("a.gltf");
  folder.write("a.gltf", make_triangle().json.dump() + "\n");
  EXPECT_EQ(settings_difference(before, settings("a.gltf")), "SCENE '" + folder.path("a.gltf") + "' has changed");
  EXPECT_EQ(scene_settings("toys").at(0).value, "toys");
  EXPECT_EQ(file_setting("`env`", folder.path("none.hdr")).value, "missing");
}

}  // namespace
}  // namespace ods
