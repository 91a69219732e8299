// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/channel_layers.h"

#include <gtest/gtest.h>

namespace ods::channel_layers_test {

TEST(ChannelLayers, TheRuleGoesByTheName) {
  struct Row {
    const char* layer;
    const char* channel;
    bool is_whole_number;
    LayerRule rule;
  };
  const Row rows[] = {
      {"", "Z", false, LayerRule::kNearest},
      {"", "ZBack", false, LayerRule::kNearest},
      {"depth", "Z", false, LayerRule::kNearest},
      {"ViewLayer.Depth", "Z", false, LayerRule::kNearest},
      {"N", "Z", false, LayerRule::kMean},
      {"Position", "Z", false, LayerRule::kMean},
      {"albedo", "R", false, LayerRule::kMean},
      {"albedo", "R", true, LayerRule::kNearest},
      {"IndexOB", "X", false, LayerRule::kNearest},
      {"CryptoObject00", "r", false, LayerRule::kNearest},
      {"ViewLayer.CryptoMaterial02", "g", false, LayerRule::kNearest},
      {"variance", "R", false, LayerRule::kNearest},
      {"", "id", false, LayerRule::kNearest},
      {"diffuse", "B", false, LayerRule::kMean},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(rule_of(row.layer, row.channel, row.is_whole_number), row.rule) << row.layer << "." << row.channel;
  }
}

FileInfo with_channels(const std::vector<std::string>& names) {
  FileInfo info;
  info.channels = names;
  return info;
}

TEST(ChannelLayers, ViewsStandBeforeOrWithinTheName) {
  const FileInfo info = with_channels({"B", "G", "R", "N.right.X", "right.B", "right.G", "right.R"});
  EXPECT_EQ(channels_of_view(info, "right", false), (ViewChannels{{"N.X", 3}, {"B", 4}, {"G", 5}, {"R", 6}}));
  EXPECT_EQ(channels_of_view(info, "left", true), (ViewChannels{{"B", 0}, {"G", 1}, {"R", 2}}));
  EXPECT_EQ(channels_of_view(info, "", true).size(), 7u);
}

TEST(ChannelLayers, TheColourIsTakenOut) {
  const auto color_of = [](ViewChannels channels) { return take_color(channels)->from; };
  EXPECT_EQ(color_of({{"A", 3}, {"B", 2}, {"G", 1}, {"R", 0}, {"Z", 4}}), (std::vector<size_t>{0, 1, 2, 3}));
  EXPECT_EQ(color_of({{"Y", 0}}), (std::vector<size_t>{0, 0, 0}));
  EXPECT_EQ(color_of({{"V.Combined.B", 0}, {"V.Combined.G", 1}, {"V.Combined.R", 2}, {"V.Depth.Z", 3}}),
            (std::vector<size_t>{2, 1, 0}));
  ViewChannels none{{"Z", 0}};
  EXPECT_FALSE(take_color(none));
}

}  // namespace ods::channel_layers_test
