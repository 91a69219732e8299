// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/light/lamp_unit.h"

#include <gtest/gtest.h>

#include "tests/support/stage_scenes.h"

namespace ods {
namespace {

// A lamp of 25 W and a sun of 4 W/m2 beside a glowing material, as Blender 3.4 exports them.
Scene make_export() {
  Scene scene = make_simple_room();
  scene.generator = "Khronos glTF Blender I/O v3.4.50";
  scene.materials[1].emission = vec3(1.5f);
  PunctualLight bulb, sun;
  bulb.intensity = vec3(1358.785f);
  sun.kind = kLightDirectional, sun.intensity = vec3(2732.0f);
  scene.lights = {bulb, sun};
  return scene;
}

TEST(LampUnit, BlendersWattsAreRecognised) {
  EXPECT_TRUE(lamps_are_in_watts(make_export()));
  Scene other = make_export();
  other.generator = "glTF-Transform v4";
  EXPECT_TRUE(lamps_are_in_watts(other)) << "compressed by another program, its lamps have 25 and 4 watts";
  other.lights[0].intensity = vec3(1300.0f);
  EXPECT_FALSE(lamps_are_in_watts(other)) << "another program";
  Scene dark = make_export();
  dark.materials[1].emission = vec3(0.0f);
  EXPECT_FALSE(lamps_are_in_watts(dark)) << "nothing to compare the lamps with";
  Scene plain = make_export();
  for (PunctualLight& light : plain.lights) light.intensity /= static_cast<float>(kLumensPerWatt);
  EXPECT_FALSE(lamps_are_in_watts(plain)) << "exported without the factor";
}

TEST(LampUnit, AllLampsAreScaledMovingOnesToo) {
  Scene scene = make_export();
  Lamp lamp;
  lamp.intensity = 683.0;
  scene.animation.lamps.push_back(lamp);
  scene.animation.clips.push_back({"flicker", 1.0, {}});
  Track track;
  track.property = Property::kLampIntensity;
  track.keys.values = {683.0f, 1366.0f};
  scene.animation.clips[0].tracks.push_back(track);
  scale_lamps(scene, 1.0 / kLumensPerWatt);
  EXPECT_NEAR(scene.lights[0].intensity.x, 25.0f / (4.0f * 3.14159265f), 1e-3f) << "watts over the sphere";
  EXPECT_NEAR(scene.lights[1].intensity.x, 4.0f, 1e-5f);
  EXPECT_NEAR(scene.animation.lamps[0].intensity, 1.0, 1e-12);
  EXPECT_NEAR(scene.animation.clips[0].tracks[0].keys.values[1], 2.0f, 1e-6f);
}

}  // namespace
}  // namespace ods
