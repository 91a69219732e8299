// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/channel_layers.h"

#include <gtest/gtest.h>

#include "tests/support/exr_files.h"
#include "tests/support/picture_rows.h"
#include "tests/support/temporary_folder.h"

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

// Two views in layers that have names, as Blender writes stereo.
TEST(OpenPicture, ReadsBothViewsOfBlender) {
  const TemporaryFolder folder;
  ExrForm form;
  form.width = 64, form.height = 32, form.channels.clear();
  for (const std::string view : {"left", "right"}) {
    for (const std::string channel : {"A", "B", "G", "R"})
      form.channels.push_back("Scene.Combined." + view + "." + channel);
    form.channels.push_back("Scene.CryptoObject00." + view + ".r");
    form.channels.push_back("Scene.Depth." + view + ".Z");
  }
  form.types.assign(form.channels.size(), Imf::FLOAT);
  std::vector<float> values;
  for (int i = 0; i < 64 * 32; i++) {
    for (size_t c = 0; c < form.channels.size(); c++) values.push_back(static_cast<float>(c) + 1.0f);
  }
  write_exr_of(folder.path("a.exr"), form, values);
  const StoredPicture picture = open_picture(folder.path("a.exr"));
  EXPECT_EQ(picture.layout, Layout::kMultiview);
  ASSERT_EQ(picture.eyes.size(), 2u);
  for (size_t eye = 0; eye < 2; eye++) {
    const std::vector<LayerPixels>& layers = picture.eyes[eye].layers;
    ASSERT_EQ(layers.size(), 3u);
    const float first = 6.0f * static_cast<float>(eye);
    EXPECT_EQ(value_at(layers[0], 5, 7, 0), first + 4.0f) << "R";
    EXPECT_EQ(layers[1].channels, std::vector<std::string>{"Scene.CryptoObject00.r"});
    EXPECT_EQ(layers[2].channels, std::vector<std::string>{"Scene.Depth.Z"});
    EXPECT_EQ(value_at(layers[2], 5, 7, 0), first + 6.0f);
    EXPECT_EQ(layers[2].rule, LayerRule::kNearest);
  }
}

}  // namespace ods::channel_layers_test
