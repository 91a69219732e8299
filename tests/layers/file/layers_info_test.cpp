// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/file/layers_info.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/layers/file/write_layers.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/layered_box.h"
#include "tests/support/temporary_folder.h"

namespace ods::layers_info_test {

class LayersInfoTest : public testing::Test {
 protected:
  std::optional<LayersInfo> info_of(const std::string& bytes) {
    folder.write("a.glb", bytes);
    return read_layers_info(folder.path("a.glb"));
  }
  // The bytes of a GLB with this JSON.
  static std::string glb(const std::string& json) {
    const Binary bytes = make_glb(json, {});
    return {bytes.begin(), bytes.end()};
  }
  static std::string marked(const std::string& value) {
    return glb(R"({"asset": {"version": "2.0", "extras": {"omnistereo": )" + value + "}}}");
  }
  std::string error_of(const std::string& value) {
    try {
      info_of(marked(value));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find("a.glb"), std::string::npos) << error.what();
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
};

constexpr const char* kValid =
    R"({"layers": 1, "center": [0, 1, 2], "box": [0.3, 0.4, 0.5], "yaw": -20, "width": 4096)";

TEST_F(LayersInfoTest, IsWhatWasWritten) {
  const LayeredScene scene = layered_box();
  for (const bool is_plain : {false, true}) {
    const std::string path = folder.path("box.layers.glb");
    write_layers(scene, path, {.plain = is_plain});
    const std::optional<LayersInfo> info = read_layers_info(path);
    ASSERT_TRUE(info.has_value());
    EXPECT_EQ(info->box.center, scene.box.center);
    EXPECT_EQ(info->box.size, scene.box.size);
    EXPECT_EQ(info->yaw, scene.yaw);
    EXPECT_EQ(info->width, scene.width);
    EXPECT_EQ(info->fallback, scene.fallback);
    EXPECT_EQ(info->scene, "a room.glb");
    EXPECT_EQ(info->light.exposure, 0.5f);
    EXPECT_EQ(info->light.tone, ToneCurve::kLinear);
    EXPECT_EQ(info->light.probes.origin, scene.light.probes.origin);
    EXPECT_EQ(info->light.probes.step, scene.light.probes.step);
    EXPECT_EQ(info->light.probes.count, scene.light.probes.count);
  }
}

// 28 floats for each probe, in a buffer view that is not compressed.
TEST_F(LayersInfoTest, HasTheLightOfTheProbes) {
  const LayeredScene scene = layered_box();
  for (const bool is_plain : {false, true}) {
    write_layers(scene, folder.path("a.glb"), {.plain = is_plain});
    const std::string bytes = folder.read("a.glb");
    uint32_t size = 0;
    std::memcpy(&size, &bytes[12], sizeof size);
    const Json json = Json::parse(bytes.substr(20, size));
    const Json& probes = json["asset"]["extras"]["omnistereo"]["light"]["probes"];
    const Json& view = json["bufferViews"][probes["bufferView"].get<size_t>()];
    EXPECT_FALSE(view.contains("extensions"));
    ASSERT_EQ(view["byteLength"], 24 * 28 * 4);
    std::vector<float> values(24 * 28);
    std::memcpy(values.data(), &bytes[28 + size + view["byteOffset"].get<size_t>()], values.size() * sizeof(float));
    for (size_t i = 0; i < 24; i++) {
      const LightProbe& probe = scene.light.probes.probes[i];
      EXPECT_EQ(values[28 * i], probe.weight);
      EXPECT_EQ(values[28 * i + 1], probe.radiance[0].x);
      EXPECT_EQ(values[28 * i + 27], probe.radiance[8].z);
    }
  }
}

TEST_F(LayersInfoTest, IsReadAsDocumented) {
  const std::optional<LayersInfo> info = info_of(marked(std::string(kValid) + R"(, "future": {"key": []}})"));
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(info->box.center, vec3(0.0f, 1.0f, 2.0f));
  EXPECT_EQ(info->box.size, vec3(0.3f, 0.4f, 0.5f));
  EXPECT_EQ(info->yaw, -20.0f);
  EXPECT_EQ(info->width, 4096);
  EXPECT_EQ(info->fallback, "");
}

TEST_F(LayersInfoTest, IsMissingInOtherFiles) {
  EXPECT_FALSE(info_of("").has_value());
  EXPECT_FALSE(info_of("a text with \"omnistereo\" in it").has_value());
  EXPECT_FALSE(info_of(glb(R"({"asset": {"version": "2.0"}})")).has_value());
  EXPECT_FALSE(info_of(glb(R"({"asset": {"version": "2.0"}, "nodes": [{"name": "omnistereo"}]})")).has_value());
  EXPECT_FALSE(marked("7").empty());
  for (const char* other : {"7", "null", "[1]", "{}", "{\"sky\": true}"}) {
    EXPECT_FALSE(info_of(marked(other)).has_value()) << other;
  }
  // Damaged or strange files are for the reader of scenes.
  EXPECT_FALSE(info_of(glb("{\"omnistereo\": ")).has_value());
  EXPECT_FALSE(info_of(glb("[\"omnistereo\"]")).has_value());
  EXPECT_FALSE(info_of(glb("{\"omnistereo\": " + std::string(1000, '[') + std::string(1000, ']') + "}")).has_value());
  const std::string whole = marked(std::string(kValid) + "}");
  ASSERT_TRUE(info_of(whole).has_value());
  const size_t end = whole.find_last_of('}');
  for (size_t size = 0; size <= end; size++) EXPECT_FALSE(info_of(whole.substr(0, size)).has_value()) << size;
  std::string other_version = whole;
  other_version[4] = 1;
  EXPECT_FALSE(info_of(other_version).has_value());
  EXPECT_THROW(read_layers_info(folder.path("missing.glb")), Error);
}

TEST_F(LayersInfoTest, OfANewerVersionIsAnError) {
  const std::string error = error_of(R"({"layers": 2, "everything": "else"})");
  EXPECT_NE(error.find("newer ods"), std::string::npos) << error;
  EXPECT_NE(error.find("update ods"), std::string::npos) << error;
}

TEST_F(LayersInfoTest, IsChecked) {
  const auto with = [](std::string key, const std::string& value) {
    Json json = Json::parse(std::string(kValid) + "}");
    json[key] = Json::parse(value);
    return json.dump();
  };
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{{"layers", "0"},
                                                                                   {"layers", "1.5"},
                                                                                   {"layers", "\"1\""},
                                                                                   {"center", "[0, 1]"},
                                                                                   {"center", "[0, 1, []]"},
                                                                                   {"center", "7"},
                                                                                   {"center", "[0, 1, 1e30]"},
                                                                                   {"box", "[0.3, 0.3, 0]"},
                                                                                   {"box", "[0.3, -1, 1]"},
                                                                                   {"box", "[1, 1, 1e9]"},
                                                                                   {"box", "null"},
                                                                                   {"yaw", "\"left\""},
                                                                                   {"yaw", "1e9"},
                                                                                   {"width", "0"},
                                                                                   {"width", "-1"},
                                                                                   {"width", "3000000000"},
                                                                                   {"fallback", "7"},
                                                                                   {"fallback", "\"\""},
                                                                                   {"fallback", "\"..\""},
                                                                                   {"fallback", "\"../a.png\""},
                                                                                   {"fallback", "\"/a\""},
                                                                                   {"fallback", R"("a\\b")"},
                                                                                   {"scene", "\"../a.glb\""},
                                                                                   {"light", "7"},
                                                                                   {"light", R"({"exposure": 1e9})"},
                                                                                   {"light", R"({"tone": "loud"})"},
                                                                                   {"light", R"({"probes": {}})"},
                                                                                   {"fallback", R"("a\nb")"}}) {
    EXPECT_NE(error_of(with(key, value)), "") << key << " " << value;
  }
  for (const char* key : {"center", "box", "width"}) {
    Json json = Json::parse(std::string(kValid) + "}");
    json.erase(key);
    EXPECT_NE(error_of(json.dump()), "") << key;
  }
  EXPECT_NE(info_of(marked(with("fallback", "\"a b.png\""))).value().fallback, "");
}

}  // namespace ods::layers_info_test
