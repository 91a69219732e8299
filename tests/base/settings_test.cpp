// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/settings.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

TEST(Settings, ComeBackFromTheirText) {
  const Settings settings = {{"samples", "64", ""}, {"scene", "d41d8cd9", "a b.glb"}, {"light", "", ""}};
  const Settings again = parse_settings(settings_text(settings)).value();
  ASSERT_EQ(again.size(), settings.size());
  for (size_t i = 0; i < settings.size(); i++) {
    EXPECT_EQ(again[i].name, settings[i].name);
    EXPECT_EQ(again[i].value, settings[i].value);
    EXPECT_EQ(again[i].path, settings[i].path);
  }
  EXPECT_EQ(settings_difference(settings, again), "");
}

TEST(Settings, AreKnownToBeWhole) {
  const std::string text = settings_text({{"samples", "64", ""}, {"scene", "d41d8cd9", "a b.glb"}});
  for (size_t size = 0; size < text.size(); size++) EXPECT_FALSE(parse_settings(text.substr(0, size))) << size;
  for (size_t i = 0; i < text.size(); i++) {
    std::string changed = text;
    changed[i] ^= 1;
    EXPECT_FALSE(parse_settings(changed)) << i;
  }
  EXPECT_TRUE(parse_settings(settings_text({})).value().empty());
}

TEST(Settings, DifferencesAreSaidWhicheverSideHasThem) {
  const Settings then = {{"samples", "64", ""}, {"scene", "1", "a.glb"}, {"map", "2", "m.exr"}, {"old", "x", ""}};
  const Settings now = {{"samples", "128", ""}, {"scene", "3", "a.glb"}, {"map", "missing", "m.exr"}};
  EXPECT_EQ(settings_difference(then, now),
            "samples was 64, now 128; scene 'a.glb' has changed; map 'm.exr' is missing; and 1 more");
  EXPECT_EQ(settings_difference({}, {{"new", "y", ""}}), "new is new");
  EXPECT_EQ(settings_difference({{"old", "x", ""}}, {}), "old is no longer given");
  EXPECT_EQ(settings_difference({{"scene", "1", "a.glb"}}, {{"scene", "2", "b.glb"}}), "scene was a.glb, now b.glb");
}

}  // namespace
}  // namespace ods
