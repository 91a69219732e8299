// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Lights of glTF files, and nodes that the camera does not see.
#include <gtest/gtest.h>

#include "tests/support/gltf_builder.h"

namespace ods {
namespace {

void expect_near(vec3 a, vec3 b) {
  for (int c = 0; c < 3; c++) EXPECT_NEAR(a[c], b[c], 1e-5f);
}

TEST(GltfLights, PunctualLights) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::parse(R"([
      {"type": "spot", "color": [1, 0.5, 0], "intensity": 10, "range": 7, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}},
      {"type": "point"}, {"type": "directional", "intensity": 3}])");
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["nodes"] = GltfJson::parse(R"([{"translation": [1,2,3]}, {}, {"rotation": [-0.70710678,0,0,0.70710678]}])");
  for (size_t i = 0; i < 3; i++) file.node(i)["extensions"]["KHR_lights_punctual"]["light"] = i;
  const Scene scene = file.load();
  ASSERT_EQ(scene.lights.size(), 3u);
  const PunctualLight& spot = scene.lights[0];
  EXPECT_EQ(spot.kind, kLightSpot);
  expect_near(spot.position, vec3(1, 2, 3));
  expect_near(spot.direction, vec3(0, 0, -1));
  expect_near(spot.intensity, vec3(10, 5, 0));
  EXPECT_EQ(spot.range, 7.0f);
  EXPECT_FLOAT_EQ(spot.inner_cone, 0.1f);
  EXPECT_FLOAT_EQ(spot.outer_cone, 0.2f);
  EXPECT_EQ(scene.lights[1].kind, kLightPoint);
  expect_near(scene.lights[1].intensity, vec3(1));
  EXPECT_EQ(scene.lights[2].kind, kLightDirectional);
  expect_near(scene.lights[2].direction, vec3(0, -1, 0));
}

TEST(GltfLights, LightShapes) {
  GltfBuilder file = make_triangle();
  file.json["extensionsUsed"] = {"KHR_lights_punctual", "ODS_light_shape"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = GltfJson::parse(R"([
      {"type": "spot", "spot": {}, "extensions": {"ODS_light_shape": {"radius": 0.2, "cone": "smooth"}}},
      {"type": "point", "extensions": {"ODS_light_shape": {"radius": -1, "cone": "smooth cosine"}}},
      {"type": "directional", "extensions": {"ODS_light_shape": {"angle": 0.01, "radius": 3, "cone": 7}}}])");
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  file.json["nodes"] = GltfJson::parse(R"([{}, {}, {}])");
  for (size_t i = 0; i < 3; i++) file.node(i)["extensions"]["KHR_lights_punctual"]["light"] = i;
  const Scene scene = file.load();
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_FLOAT_EQ(scene.lights[0].size, 0.2f);
  EXPECT_EQ(scene.lights[0].cone, kConeSmooth);
  EXPECT_EQ(scene.lights[1].size, 0.0f);
  EXPECT_EQ(scene.lights[1].cone, kConeSmoothCosine);
  EXPECT_FLOAT_EQ(scene.lights[2].size, 0.005f);
  EXPECT_EQ(scene.lights[2].cone, kConeSquare);
}

TEST(GltfLights, UnseenNodes) {
  for (const auto& [unseen, role] : {std::pair{R"({})", kUnseen}, std::pair{R"({"onlyLight": true})", kPureLight},
                                     std::pair{R"({"onlyLight": "yes"})", kUnseen}}) {
    GltfBuilder file = make_triangle();
    file.json["extensionsUsed"] = {"ODS_unseen"};
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.node(1)["extensions"]["ODS_unseen"] = GltfJson::parse(unseen);
    const Scene scene = file.load();
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].role, kOrdinary);
    EXPECT_EQ(scene.instances[1].role, role) << unseen;
    EXPECT_TRUE(scene.warnings.empty());
  }
}

}  // namespace
}  // namespace ods
