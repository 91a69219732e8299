// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/load/load.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"

namespace ods {
namespace {

std::string error_of(const std::string& name) {
  try {
    load_scene(name);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LoadScene, BuiltInByName) {
  EXPECT_EQ(load_scene("furnace").name, "furnace");
}

TEST(LoadScene, SuggestsWhatMayHaveBeenMeant) {
  EXPECT_EQ(error_of("furnce"), "furnce: no such file, and no built-in scene; did you mean 'furnace'?");
  EXPECT_EQ(error_of("kitchen.glb"), "kitchen.glb: no such file, and no built-in scene");
  EXPECT_NE(error_of("./furnace").find("no such file"), std::string::npos);
}

TEST(LoadScene, BuiltInScenesHoldOnlyOne) {
  EXPECT_EQ(load_scene("furnace", {.scene = 0}).name, "furnace");
  EXPECT_THROW(load_scene("furnace", {.scene = 1}), Error);
}

}  // namespace
}  // namespace ods
