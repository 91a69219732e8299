// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/gltf/extensions.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"

namespace ods {
namespace {

std::string row_of(const Extension& each) {
  return fmt::format("| {} | {} | {} |", each.name, name_in(kExtensionStateTable, each.state), each.how);
}

// The rows of the table in docs/scenes.md.
std::vector<std::string> rows_of_page() {
  std::ifstream page(source_folder() + "/docs/scenes.md");
  std::vector<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| extension |")) inside = true;
    if (inside && line.starts_with("| ")) rows.push_back(line);
  }
  EXPECT_GT(rows.size(), 1u);
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

TEST(Extensions, ThePageHasTheSameTable) {
  std::vector<std::string> rows;
  for (const Extension& each : gltf_extensions()) rows.push_back(row_of(each));
  EXPECT_EQ(rows_of_page(), rows);
}

TEST(Extensions, EachHasANameOfItsOwnAndAnExplanation) {
  const auto all = gltf_extensions();
  for (size_t i = 0; i < all.size(); i++) {
    EXPECT_FALSE(all[i].how.empty()) << all[i].name;
    EXPECT_TRUE(i == 0 || all[i - 1].name < all[i].name) << all[i].name;
  }
}

// The message about a file that uses, or requires, an extension follows the extension's state.
TEST(Extensions, EveryStateIsHeeded) {
  for (const Extension& each : gltf_extensions()) {
    GltfBuilder file = make_triangle();
    file.json["extensionsUsed"] = {each.name};
    const Scene scene = file.load();
    ASSERT_EQ(scene.extensions.size(), 1u) << each.name;
    EXPECT_EQ(scene.extensions[0].name, each.name);
    EXPECT_EQ(scene.extensions[0].state, name_in(kExtensionStateTable, each.state)) << each.name;
    EXPECT_EQ(scene.extensions[0].how, each.how);
    EXPECT_FALSE(scene.extensions[0].required);
    EXPECT_EQ(scene.warnings.empty(), each.state != ExtensionState::kNotRendered) << each.name;

    file.json["extensionsRequired"] = {each.name};
    const std::string error = error_of(file.glb());
    EXPECT_EQ(error.empty(), is_supported(each.state)) << error;
    EXPECT_TRUE(error.empty() || error.find(each.name) != std::string::npos) << error;
    EXPECT_TRUE(!error.empty() || file.load().extensions.at(0).required) << each.name;
  }
}

TEST(Extensions, AnUnknownOneIsNotRendered) {
  const Extension unknown = find_extension("VENDOR_thing");
  EXPECT_EQ(unknown.state, ExtensionState::kNotRendered);
  EXPECT_EQ(unknown.name, "VENDOR_thing");
  EXPECT_FALSE(is_read("VENDOR_thing"));
  EXPECT_FALSE(is_read("KHR_xmp_json_ld"));
  EXPECT_TRUE(is_read("KHR_lights_punctual"));
}

// Some exporters do not list an extension that they use.
TEST(Extensions, ObjectsOfAnExtensionAreAUse) {
  GltfBuilder file = make_triangle();
  file.primitive()["extensions"] = {{"VENDOR_thing", GltfJson::object()}, {"KHR_xmp_json_ld", GltfJson::object()}};
  const Scene scene = file.load();
  ASSERT_EQ(scene.extensions.size(), 2u);
  EXPECT_EQ(scene.extensions[0].name, "KHR_xmp_json_ld");
  EXPECT_EQ(scene.extensions[1].name, "VENDOR_thing");
  EXPECT_EQ(scene.warnings.size(), 1u);
}

// A required extension need not be listed as used, though the specification asks for it.
TEST(Extensions, RequiredOnesAreUsed) {
  GltfBuilder file = make_triangle();
  file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  file.json["extensionsUsed"] = {"KHR_xmp_json_ld", "KHR_xmp_json_ld"};
  const Scene scene = file.load();
  ASSERT_EQ(scene.extensions.size(), 2u);
  EXPECT_EQ(scene.extensions[0].name, "KHR_mesh_quantization");
  EXPECT_EQ(scene.extensions[1].name, "KHR_xmp_json_ld");
}

}  // namespace
}  // namespace ods
